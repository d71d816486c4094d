"""Data of the plots of a study: measures with limits, designs with their roles in the decision."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from rgss.figures import exact_figure
from rgss.measures import Direction, Estimate, Range
from rgss.requirements import Comparison, Criterion


class Role(str, Enum):
    """Role of a design in the decision; a later one is drawn over an earlier one.

    Attributes:
        UNJUDGED: There is no decision yet.
        INFEASIBLE: Its estimates miss a requirement by more than the tolerance.
        FEASIBLE: Its estimates meet every requirement within the tolerance, and another design dominates it.
        FRONT: No feasible design dominates it.
        RUNNER_UP: The best that is not tied.
        TIED: As good as the chosen one, or within the practical margin of it.
        CHOSEN: The chosen one.
    """

    UNJUDGED = "not judged"
    INFEASIBLE = "infeasible"
    FEASIBLE = "feasible"
    FRONT = "nondominated"
    RUNNER_UP = "runner-up"
    TIED = "tied within the practical margin"
    CHOSEN = "chosen"


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """Limit that a requirement sets to a measure.

    Attributes:
        requirement: Id of the requirement.
        criterion: Its criterion.
        value: The limit in the measure's unit.
    """

    requirement: str
    criterion: Criterion
    value: float

    def __str__(self) -> str:
        return f"{self.requirement}: {_SYMBOLS[self.criterion.comparison]} {exact_figure(self.value)}"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlottedMeasure:
    """A measure of every design.

    Attributes:
        id: Its id.
        name: Its name.
        unit: Its unit.
        better: Its preferred direction.
        estimates: Estimate for each variant.
        limits: Limits that requirements set to it.
        within: Range that no estimate can leave, such as that of a share.
    """

    id: str
    name: str
    unit: str
    better: Direction
    estimates: Mapping[int, Estimate]
    limits: tuple[Limit, ...] = ()
    within: Range = field(default_factory=Range)

    @property
    def title(self) -> str:
        """Name, id and unit, such as ``Total cost estimate C_total [USD]``."""
        return f"{self.name} {self.symbol}"

    @property
    def symbol(self) -> str:
        """Id and unit; the unit alone if the id is the name, written in another way."""
        is_name = self.id.replace("_", " ").casefold() == self.name.casefold()
        return f"[{self.unit}]" if is_name else f"{self.id} [{self.unit}]"

    @property
    def sign(self) -> float:
        """1 where more is better or no direction is preferred, -1 where less is."""
        return -1.0 if self.better is Direction.LOWER else 1.0

    @property
    def better_end(self) -> str:
        """Words for the preferred direction, with an arrow along an axis that rises to the right or upwards."""
        words = {
            Direction.LOWER: "← lower is better",
            Direction.HIGHER: "higher is better →",
            Direction.NONE: "no preferred direction",
        }
        return words[self.better]

    def value(self, variant: int) -> float:
        """Estimated value of a variant; NaN if there is none."""
        estimate = self.estimates.get(variant)
        return math.nan if estimate is None or estimate.value is None else estimate.value

    def interval(self, variant: int) -> tuple[float, float] | None:
        """Interval of a variant's estimate; None where an end is unknown or the value is exact."""
        estimate = self.estimates.get(variant)
        if estimate is None or estimate.low is None or estimate.high is None or estimate.low == estimate.high:
            return None
        return estimate.low, estimate.high

    def known(self, variants: Iterable[int]) -> list[int]:
        """The given variants that have a value."""
        return [variant for variant in variants if math.isfinite(self.value(variant))]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlottedDesigns:
    """Designs of a plot.

    Attributes:
        study: Label of the study, such as ``pick_place, contact fidelity``.
        roles: Role of each variant, in ascending order of ids.
        note: Reason why there is no decision; empty if there is one.
    """

    study: str
    roles: Mapping[int, Role]
    note: str = ""

    def with_role(self, role: Role) -> list[int]:
        """Variants with a role."""
        return [variant for variant, one in self.roles.items() if one is role]

    @property
    def feasible(self) -> list[int]:
        """Variants that are feasible by their estimates; none before a decision."""
        return [variant for variant, one in self.roles.items() if one not in (Role.INFEASIBLE, Role.UNJUDGED)]

    def summary(self) -> str:
        """Roles in one sentence, for readers who do not see the picture."""
        counted = [(role, self.with_role(role)) for role in reversed(Role)]
        parts = [
            f"{role.value} {', '.join(map(str, those))}" if len(those) <= _NAMED else f"{len(those)} {role.value}"
            for role, those in counted
            if those
        ]
        return "; ".join(parts)


_NAMED = 3
_SYMBOLS = {Comparison.AT_LEAST: "≥", Comparison.AT_MOST: "≤"}
