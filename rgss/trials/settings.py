"""Settings of planning and simulation: all inputs other than scene and design."""

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
        clock: The planning clock.
        search_limit_s: Limit of a shared search: at least the greatest planning limit of any design, since one search
        gives the results under all smaller limits.
        resolution_rad: Greatest joint step between two checked states of a search.
        verification_resolution_rad: Greatest joint step between two checked states of the path found; as the search if
        None.
        on_unverified: Handling of a path that is not valid at that resolution.
        simplification_checks: Budget of validity checks of the search for shortcuts.
        simplification_limit_s: Time limit of the simplification by the planning clock, including the final check. A
        move's planning time is at most the sum of the planning limit and this limit.
        clearance_m: Clearance of planned paths; executed motions keep a quarter of it.
        moves: Kind of each planned move of the task, in order; empty if all are planned.
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
        """Kind of each planned move."""
        return dict(zip(planned, self.moves or (MoveKind.PLANNED,) * len(planned), strict=True))

    @property
    def search_checks(self) -> int:
        """Budget of validity checks of a search; a search by the wall clock is bounded only by its time."""
        if self.clock.kind is ClockKind.COUNTED:
            return self.clock.checks_within(self.search_limit_s)
        return _NO_BUDGET

    @property
    def verified_every_rad(self) -> float:
        """Verification resolution in effect, in rad."""
        given = self.verification_resolution_rad
        return self.resolution_rad if given is None else given


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialSettings:
    """Planning, timing, physics and control of a trial.

    Attributes:
        planning: Settings of planning.
        physics: Time step and solver.
        control: Thresholds of the task program.
        timing: Settings of timing.
        controller: Joint controller, simulated in the dynamic fidelity.
    """

    planning: PlanningSettings
    physics: PhysicsSettings = field(default_factory=PhysicsSettings)
    control: ControlSettings = field(default_factory=ControlSettings)
    timing: TimingSettings = field(default_factory=TimingSettings)
    controller: JointController = field(default_factory=JointController)
