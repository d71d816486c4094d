"""The YAML form of a study's trade-off; ``docs/trade_off.md`` shows each construct."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, StringConstraints, Tag, WithJsonSchema

from rgss.documents import Dimensionless, DocumentModel, Identifier, Text

RankRuleName = Literal["rank_order_centroid", "rank_sum", "rank_reciprocal"]


def _as_text(value: Any) -> Any:
    # A pure number may be written bare.
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def _kind_of_anchor(value: Any) -> str:
    return "anchor" if isinstance(value, (dict, AnchorEntry)) else "quantity"


class AnchorEntry(DocumentModel):
    """A quantity that is a requirement's threshold, or a multiple of it."""

    requirement: Identifier
    times: Dimensionless = 1.0


QuantityField = Annotated[
    str,
    BeforeValidator(_as_text),
    StringConstraints(min_length=1, max_length=60),
    WithJsonSchema(
        {
            "type": ["string", "number"],
            "minLength": 1,
            "maxLength": 60,
            "description": "A quantity in a unit of the measure's dimension.",
        }
    ),
]
"""A quantity whose unit the measure decides."""

AnchorField = Annotated[
    Annotated[AnchorEntry, Tag("anchor")] | Annotated[QuantityField, Tag("quantity")],
    Discriminator(_kind_of_anchor),
]
"""A quantity, or ``{requirement: SYS-005}`` for the threshold of a requirement."""


class PointEntry(DocumentModel):
    """A point of a piecewise linear value."""

    at: AnchorField
    worth: Dimensionless


class ValueEntry(DocumentModel):
    """What a measure is worth and how much it weighs, or a group of such entries.

    Either ``measure`` with its value function or ``criterion`` with the members that it is made
    ``of``. The weight is a ``weight``, ``points`` or a ``rank``, alike for all members of a group.
    """

    measure: Identifier | None = None
    criterion: Identifier | None = None
    of: Annotated[tuple[ValueEntry, ...], Field(min_length=1)] | None = None
    rank_rule: RankRuleName | None = None

    weight: Dimensionless | None = None
    points: Dimensionless | None = None
    rank: int | None = None
    weight_between: tuple[Dimensionless, Dimensionless] | None = None

    worst: AnchorField | None = None
    best: AnchorField | None = None
    between: Annotated[tuple[PointEntry, ...], Field(min_length=1)] | None = None
    halfway: AnchorField | None = None
    target: AnchorField | None = None
    too_low: AnchorField | None = None
    too_high: AnchorField | None = None


class OrderEntry(DocumentModel):
    """One criterion weighs at least as much as another, or a multiple of it."""

    heavier: Identifier
    lighter: Identifier
    times: Dimensionless = 1.0


class AimEntry(DocumentModel):
    """A measure of which the best is wanted, and what of it may be given up."""

    measure: Identifier
    absolute: QuantityField | None = None
    relative: Dimensionless | None = None


class BoundEntry(DocumentModel):
    """A bound on a measure: at most, or at least."""

    measure: Identifier
    at_most: AnchorField | None = None
    at_least: AnchorField | None = None


class AdditiveEntry(DocumentModel):
    """The highest weighted value."""

    program: Literal["additive"]


class LexicographicEntry(DocumentModel):
    """The best of one measure after another."""

    program: Literal["lexicographic"]
    order: Annotated[tuple[AimEntry, ...], Field(min_length=1)]


class EpsilonConstraintEntry(DocumentModel):
    """The best of one measure under limits on others."""

    program: Literal["epsilon_constraint"]
    optimise: AimEntry
    limits: Annotated[tuple[BoundEntry, ...], Field(min_length=1)]


class TchebycheffEntry(DocumentModel):
    """As near as possible to a reference point."""

    program: Literal["tchebycheff"]
    reference: dict[Identifier, AnchorField] = Field(default_factory=dict)
    augmentation: Dimensionless = 1e-3


class MinimaxRegretEntry(DocumentModel):
    """The smallest largest regret."""

    program: Literal["minimax_regret"]
    over: Literal["weights", "replicates"]


ProgramField = Annotated[
    AdditiveEntry | LexicographicEntry | EpsilonConstraintEntry | TchebycheffEntry | MinimaxRegretEntry,
    Field(discriminator="program"),
]


class ChanceEntry(DocumentModel):
    """How often a requirement, or a bound on a measure, must be met."""

    requirement: Identifier | None = None
    measure: Identifier | None = None
    at_most: AnchorField | None = None
    at_least: AnchorField | None = None
    probability: Dimensionless


class TailEntry(DocumentModel):
    """What the mean of the worst replicates must be: a requirement's threshold, or a bound on a measure."""

    requirement: Identifier | None = None
    measure: Identifier | None = None
    at_most: AnchorField | None = None
    at_least: AnchorField | None = None
    worst_share: Dimensionless


class FleetStudyEntry(DocumentModel):
    """A study that is one of the tasks of a fleet."""

    study: Text
    weight: Dimensionless


class PortfolioEntry(DocumentModel):
    """A portfolio of designs that serves several studies."""

    at_most: Annotated[int, Field(ge=1)]
    aim: Literal["mean", "worst"] = "mean"
    member: Identifier | None = None
    studies: Annotated[tuple[FleetStudyEntry, ...], Field(min_length=1)]


class TradeOffEntry(DocumentModel):
    """How designs are compared."""

    values: Annotated[tuple[ValueEntry, ...], Field(min_length=1)]
    rank_rule: RankRuleName | None = None
    weight_order: tuple[OrderEntry, ...] = ()
    decide_by: ProgramField = AdditiveEntry(program="additive")
    chance: tuple[ChanceEntry, ...] = ()
    tail: tuple[TailEntry, ...] = ()
    practical_margin: Dimensionless = 0.0
    choose: Literal["variants", "levels"] = "variants"
    fleet: PortfolioEntry | None = None
