"""Planning problem of a move, and the result of its planning."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rgss.errors import MotionError
from rgss.evidence.records import PlanOutcome
from rgss.motion.paths import JointPath


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningProblem:
    """Planning problem of one move.

    Attributes:
        lower_rad: Lower end of each joint's planning range.
        upper_rad: Upper end of each joint's planning range.
        start: Joint angles in rad at the start.
        goal: Joint angles in rad at the end.
        resolution_rad: Greatest Euclidean distance in joint space between two states of a motion that a search
            checks.
        verification_resolution_rad: The same for the path found, which will be executed; `resolution_rad` if None.

    Raises:
        MotionError: The numbers of joints differ, a range is empty, or a resolution is not positive.
    """

    lower_rad: tuple[float, ...]
    upper_rad: tuple[float, ...]
    start: tuple[float, ...]
    goal: tuple[float, ...]
    resolution_rad: float
    verification_resolution_rad: float | None = None

    def __post_init__(self) -> None:
        for name in ("lower_rad", "upper_rad", "start", "goal"):
            object.__setattr__(self, name, tuple(float(value) for value in getattr(self, name)))
        sizes = (len(self.lower_rad), len(self.upper_rad), len(self.start), len(self.goal))
        if len(set(sizes)) != 1 or 0 in sizes:
            raise MotionError(
                "ranges, start and goal must have the same number of joints",
                hint=f"found {', '.join(str(size) for size in sizes)}",
            )
        if not all(low < high for low, high in zip(self.lower_rad, self.upper_rad, strict=True)):
            raise MotionError(
                "a joint's planning range is empty",
                hint="let its lower limit be below its upper limit",
            )
        for resolution_rad in (self.resolution_rad, self.verified_every_rad):
            if not 0.0 < resolution_rad < math.inf:
                raise MotionError(
                    f"the resolution must be above 0 rad, got {resolution_rad:g} rad", hint="give a distance above zero"
                )

    @property
    def verified_every_rad(self) -> float:
        """Verification resolution in effect, in rad."""
        given = self.verification_resolution_rad
        return self.resolution_rad if given is None else given

    def in_range(self, state: tuple[float, ...]) -> bool:
        """True if a state is within the planning ranges."""
        return all(low <= value <= high for low, value, high in zip(self.lower_rad, state, self.upper_rad, strict=True))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlanResult:
    """Result of the planning of one move.

    A search is *solved within* a budget if the number of checks at its solution, including verification and repair, is
    at most the budget; otherwise the whole budget counts as spent. A search with a budget is a prefix of the same
    search with a larger one, so that one search gives the result under every smaller limit.

    Attributes:
        outcome: The outcome.
        path: The simplified path; None unless solved.
        checks: Validity checks of the search, of the verification and of repairs: those up to the solution, or
            the whole budget.
        simplification_checks: Validity checks of the simplification and of its result.
        search_time_s: Time of the search by the planning clock.
        simplification_time_s: Time of the simplification by the planning clock.
        verification_checks: Share of `checks` spent on verifying the path.
        repairs: Number of invalid motions of the path that were replanned.
        simplification_unlimited_from: Least limit of the simplification in checks that does not change its result; None
        if its own limit did.
    """

    outcome: PlanOutcome
    path: JointPath | None
    checks: int
    simplification_checks: int
    search_time_s: float
    simplification_time_s: float = 0.0
    verification_checks: int = 0
    repairs: int = 0
    simplification_unlimited_from: int | None = 0


def spent(checks: int, time_s: float) -> PlanResult:
    """Result of a search that ended without a path."""
    return PlanResult(
        outcome=PlanOutcome.BUDGET_SPENT, path=None, checks=checks, simplification_checks=0, search_time_s=time_s
    )
