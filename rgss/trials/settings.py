"""Settings of planning and simulation: everything that is neither the scene nor the design."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from rgss.motion import ClockKind, OnUnverified, PlanningClock
from rgss.physics import PhysicsSettings
from rgss.tasks import MoveKind
from rgss.trials.plants import ControlSettings, JointController
from rgss.trials.timing_settings import TimingSettings

_NO_BUDGET = 2**31 - 1


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningSettings:
    """Settings of the planning of moves.

    Attributes:
        clock: What a planner's time is counted by.
        search_limit_s: Duration of a shared search: at least the greatest planning limit
            of any design, which are all read off it.
        resolution_rad: Greatest joint step between two states of a motion that a search checks.
        verification_resolution_rad: Greatest joint step between two checked states of the path that will run; as
            the search if None.
        on_unverified: What is done with a path of the search that is not valid at that resolution.
        simplification_checks: Validity checks that may be spent on looking for shortcuts.
        simplification_limit_s: Longest time of simplifying a path by the planning clock, the final check of
            its result included. A move's planning time is at most the planning limit and this one together.
        clearance_m: Distance that planned paths keep from everything; what runs keeps a quarter of it.
        moves: Kind of each of the planned moves of the task, in their order; all are planned if it is empty.
    """

    clock: PlanningClock
    search_limit_s: float
    resolution_rad: float = 0.01
    verification_resolution_rad: float | None = None
    on_unverified: OnUnverified = OnUnverified.FAIL
    simplification_checks: int = 1500
    simplification_limit_s: float = 2.0
    clearance_m: float = 0.008
    moves: tuple[MoveKind, ...] = ()

    def kinds(self, planned: Sequence[str]) -> dict[str, MoveKind]:
        """Kind of each move that the task leaves to the planner.

        Args:
            planned: Names of those moves.
        """
        return dict(zip(planned, self.moves or (MoveKind.PLANNED,) * len(planned), strict=True))

    @property
    def search_checks(self) -> int:
        """Validity checks of a search; a search by the wall clock is bounded by its time alone."""
        if self.clock.kind is ClockKind.COUNTED:
            return self.clock.checks_within(self.search_limit_s)
        return _NO_BUDGET

    @property
    def verified_every_rad(self) -> float:
        """Greatest joint step between two checked states of the path that will run."""
        given = self.verification_resolution_rad
        return self.resolution_rad if given is None else given


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialSettings:
    """Planning, timing, physics and control of a trial.

    Attributes:
        planning: How moves are planned.
        physics: How physics is stepped.
        control: Thresholds of the task program.
        timing: How moves are timed.
        controller: Control of the joints, which the dynamic fidelity simulates.
    """

    planning: PlanningSettings
    physics: PhysicsSettings = field(default_factory=PhysicsSettings)
    control: ControlSettings = field(default_factory=ControlSettings)
    timing: TimingSettings = field(default_factory=TimingSettings)
    controller: JointController = field(default_factory=JointController)
