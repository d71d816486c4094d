"""The YAML form of a study's trade-off; ``docs/trade_off.md`` shows each construct."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import Dimensionless, DocumentModel, Identifier, Text
from rgss.studies.trade_off.sensitivity import SensitivityChoice
from rgss.tradeoff import AnchorField, PortfolioAim, QuantityField, RankRule, Scenarios, ShapeKeys


class CriterionKeys(DocumentModel):
    """Keys of an entry beside those of its value function."""

    measure: Identifier | None = None
    criterion: Identifier | None = None
    of: Annotated[tuple[ValueEntry, ...], Field(min_length=1)] | None = None
    rank_rule: RankRule | None = None

    weight: Dimensionless | None = None
    points: Dimensionless | None = None
    rank: int | None = None
    weight_between: tuple[Dimensionless, Dimensionless] | None = None


class ValueEntry(ShapeKeys, CriterionKeys):
    """Value function and weight of a measure, or a group of such entries.

    Either ``measure`` with its value function or ``criterion`` with the members that it is made
    ``of``. The weight is a ``weight``, ``points`` or a ``rank``, alike for all members of a group.
    """


class OrderEntry(DocumentModel):
    """One criterion weighs at least as much as another, or a multiple of it."""

    heavier: Identifier
    lighter: Identifier
    times: Dimensionless = 1.0


class AnswerEntry(DocumentModel):
    """Pairwise answer: what the swing of one criterion is worth relative to that of another.

    A ``ratio``, a range of ratios in ``between``, or neither: then the first is worth at least as much.
    """

    swing_of: Identifier
    over: Identifier
    ratio: Dimensionless | None = None
    between: tuple[Dimensionless, Dimensionless] | None = None
    rationale: Text | None = None


class StakeholderEntry(DocumentModel):
    """Weights of one stakeholder: weights, points or pairwise answers."""

    weights: dict[Identifier, Dimensionless] | None = None
    points: dict[Identifier, Dimensionless] | None = None
    answers: Annotated[tuple[AnswerEntry, ...], Field(min_length=1)] | None = None
    rationale: Text | None = None


class AimEntry(DocumentModel):
    """Measure that is optimised, and how much of it may be given up."""

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
    """Program that minimises the distance to a reference point."""

    program: Literal["tchebycheff"]
    reference: dict[Identifier, AnchorField] = Field(default_factory=dict)
    augmentation: Dimensionless = 1e-3


class MinimaxRegretEntry(DocumentModel):
    """The smallest largest regret."""

    program: Literal["minimax_regret"]
    over: Scenarios


ProgramField = Annotated[
    AdditiveEntry | LexicographicEntry | EpsilonConstraintEntry | TchebycheffEntry | MinimaxRegretEntry,
    Field(discriminator="program"),
]


class RiskEntry(DocumentModel):
    """Keys that chances and tails share: a requirement, or a bound on a measure."""

    requirement: Identifier | None = None
    measure: Identifier | None = None
    at_most: AnchorField | None = None
    at_least: AnchorField | None = None


class ChanceEntry(RiskEntry):
    """Chance constraint: how often a requirement, or a bound on a measure, must be met."""

    probability: Dimensionless


class TailEntry(RiskEntry):
    """Bound on the mean of the worst replicates: a requirement's threshold, or a bound on a measure."""

    worst_share: Dimensionless


class PortfolioStudyEntry(DocumentModel):
    """A study that is one of the tasks of a portfolio."""

    study: Text
    weight: Dimensionless


class PortfolioEntry(DocumentModel):
    """Portfolio of designs that serves several studies."""

    at_most: Annotated[int, Field(ge=1)]
    aim: PortfolioAim = PortfolioAim.MEAN
    member: Identifier | None = None
    studies: Annotated[tuple[PortfolioStudyEntry, ...], Field(min_length=1)]


class TradeOffEntry(DocumentModel):
    """Comparison of designs."""

    values: Annotated[tuple[ValueEntry, ...], Field(min_length=1)]
    rank_rule: RankRule | None = None
    weight_order: tuple[OrderEntry, ...] = ()
    elicitation: tuple[AnswerEntry, ...] = ()
    stakeholders: dict[Identifier, StakeholderEntry] = Field(default_factory=dict)
    accept_within: Dimensionless = 0.05
    sensitivity: SensitivityChoice | None = None
    decide_by: ProgramField = AdditiveEntry(program="additive")
    chance: tuple[ChanceEntry, ...] = ()
    tail: tuple[TailEntry, ...] = ()
    practical_margin: Dimensionless = 0.0
    tolerance: Dimensionless = 0.0
    of_equals: Literal["first", "last"] = "first"
    choose: Literal["variants", "levels"] = "variants"
    feasible_by: Literal["estimates", "verdicts"] = "estimates"
    portfolio: PortfolioEntry | None = None
