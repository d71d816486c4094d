"""Planner settings: OMPL planner, parameters, objective, and handling of an unverified path.

Plain data, independent of OMPL.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum


class Objective(str, Enum):
    """Optimisation objective of a planner.

    The cost of a state is charged like a validity check; a path length is not, since it needs no query of the scene.
    """

    PATH_LENGTH = "path_length"
    CLEARANCE = "clearance"
    MECHANICAL_WORK = "mechanical_work"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerSettings:
    """A planner with its parameters.

    Attributes:
        algorithm: Its class in ``ompl.geometric``.
        parameters: Name in OMPL's parameter set and value in SI of each parameter that is set, by name; OMPL's own
            default for every other.
        objective: Its optimisation objective; OMPL's default if None.
    """

    algorithm: str
    parameters: tuple[tuple[str, float], ...] = ()
    objective: Objective | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "parameters", tuple(sorted(self.parameters)))

    def with_parameter(self, name: str, value: float) -> PlannerSettings:
        """Copy of the settings with another value of a parameter.

        Args:
            name: Its name in OMPL's parameter set.
            value: The value in SI.
        """
        return replace(self, parameters=tuple({**dict(self.parameters), name: value}.items()))

    @property
    def has_no_cost(self) -> bool:
        """True for a TRRT that accepts every transition and so is equivalent to an RRT."""
        return self.algorithm == "TRRT" and self.objective is None


class OnUnverified(str, Enum):
    """Handling of a path that is not valid at its verification resolution."""

    FAIL = "fail"
    REPAIR = "repair"
