"""Plant of the lowest fidelity: joints with a given response, and a hand that opens and closes.

It gives the duration of a task and the motion of the tool. Forces, the object and contacts are not modelled.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rgss.evidence import Failure, Metric
from rgss.scenes import Gripper, Joint, unpowered_shortfall
from rgss.tasks import CheckStep, GripStep, MoveStep, NeutralStep, ReleaseStep, WaitStep
from rgss.trials.hands import hand_of
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants.arm_observations import tool_metrics_by_differences
from rgss.trials.plants.control import ControlSettings
from rgss.trials.plants.grip_sequence import GripSequence
from rgss.trials.plants.joint_motion import speed_metrics
from rgss.trials.reference import Array, Reference, ToolPositions


@dataclass(frozen=True, slots=True, kw_only=True)
class JointResponse:
    """Response of a controlled joint to its target: a damped oscillator.

    The deviation e from the target obeys ë + 2 ζ ω ė + ω² e = -q̈_target, the closed loop of a
    joint under position control without feed-forward of the acceleration.

    Attributes:
        natural_frequency_rad_s: ω.
        damping_ratio: ζ; 1 is critical.
        reached_rad: Greatest joint deviation at which the end of a move counts as reached.
    """

    natural_frequency_rad_s: float = 100.0
    damping_ratio: float = 1.0
    reached_rad: float = 1.0e-3


class KinematicPlant:
    """Kinematic model of the arm with a Boolean hand."""

    def __init__(
        self,
        tool: ToolPositions,
        joints: Sequence[Joint],
        gripper: Gripper,
        grips: GripSequence,
        control: ControlSettings,
        *,
        step_s: float,
        response: JointResponse | None = None,
    ) -> None:
        """Prepare the model.

        Args:
            tool: Kinematics of the tool.
            joints: The arm's joints with their limits.
            gripper: The hand; its fingers move at their velocity.
            grips: Object and hand opening of each step.
            control: Thresholds of the task program.
            step_s: Time between two targets.
            response: Response of the joints.
        """
        self._tool = tool
        self._joints = joints
        self._gripper = gripper
        self._hand = hand_of(gripper)
        self._grips = grips
        self._control = control
        self._step_s = step_s
        self._response = response or JointResponse()

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at a configuration; the model has no state between moves, since each ends at rest."""

    def move(self, step: MoveStep, reference: Reference) -> PhaseResult:
        """Follow the targets with the joints' response and wait until the end is reached."""
        deviation = self._deviation(reference.positions_rad, step.reached_rad)
        held = np.vstack([reference.positions_rad, np.repeat(reference.positions_rad[-1:], len(deviation), axis=0)])
        actual = held[: len(deviation)] + deviation
        tool_m = np.asarray(self._tool.tool_position(actual))
        wanted_m = np.vstack(
            [reference.tool_m, np.repeat(reference.tool_m[-1:], max(0, len(deviation) - len(reference.tool_m)), axis=0)]
        )
        peaks_rad_s = np.abs(np.diff(actual, axis=0)).max(axis=0, initial=0.0) / self._step_s
        return self._result(
            step.name,
            (len(deviation) - 1) * self._step_s,
            {
                **tool_metrics_by_differences(tool_m, wanted_m, step_s=self._step_s),
                **speed_metrics(peaks_rad_s, self._joints),
            },
        )

    def grip(self, step: GripStep) -> PhaseResult:
        """Close: the travel at the finger velocity, then the duration of a firm grasp."""
        view = self._grips.view_of(step)
        misfit = self._hand.misfit(view)
        if misfit:
            waited_s = self._hand.longest_travel_s + self._control.grasp_timeout_s
            return replace(self._result(step.name, waited_s, {}), failure=Failure.NO_FIRM_GRASP, detail=misfit)
        firm_s = self._control.firm_grasp_s if step.firm_s is None else step.firm_s
        return self._result(step.name, self._hand.closing_s(view, firm_s), {})

    def release(self, step: ReleaseStep) -> PhaseResult:
        """Open: the same travel back."""
        opening_s = self._hand.opening_s(self._grips.view_of(step))
        return self._result(step.name, opening_s, {"opening_s": opening_s})

    def neutral(self, step: NeutralStep) -> PhaseResult:
        """Rest for the duration of a command; what the unpowered fingers do not hold is dropped."""
        result = self._result(step.name, self._hand.least_opening_s or self._hand.longest_travel_s, {})
        why = unpowered_shortfall(self._gripper, self._grips.view_of(step)) if self._grips.is_lifted(step) else ""
        return replace(result, failure=Failure.OBJECT_DROPPED, detail=why) if why else result

    def wait(self, step: WaitStep) -> PhaseResult:
        """Hold the configuration."""
        return self._result(step.name, step.duration_s, {})

    def check(self, step: CheckStep) -> PhaseResult:
        """Rest as contact physics does, and assume that the conditions hold: objects are not modelled."""
        return self._result(step.name, self._control.settled_s, {})

    def _deviation(self, positions_rad: Array, reached_rad: float | None) -> Array:
        """Deviation (m, n) of the joints from their targets at each step, until the end is reached.

        Exact for an acceleration that is constant over each step.

        Args:
            positions_rad: The targets, shape (k, n).
            reached_rad: Greatest deviation at which the end counts as reached; None for that of the response.
        """
        step, response = self._step_s, self._response
        omega, zeta = response.natural_frequency_rad_s, response.damping_ratio
        transition, drive = _oscillator(omega, zeta, step)
        velocity = np.vstack([np.zeros((1, positions_rad.shape[1])), np.diff(positions_rad, axis=0) / step])
        velocity = np.vstack([velocity, np.zeros((1, positions_rad.shape[1]))])
        acceleration = np.diff(velocity, axis=0) / step
        settling = math.ceil(20.0 / (omega * zeta * step))
        last = len(positions_rad) - 1
        wanted = np.zeros((last + 1 + settling, positions_rad.shape[1]))
        wanted[: len(acceleration)] = acceleration
        rows = _response(transition, drive, wanted)
        reached = np.max(np.abs(rows[last:]), axis=1) <= (response.reached_rad if reached_rad is None else reached_rad)
        end = int(np.argmax(reached)) if reached.any() else len(reached) - 1
        return rows[: last + end + 1]

    def _result(self, phase: str, duration_s: float, metrics: Mapping[str, Metric]) -> PhaseResult:
        return PhaseResult(phase=phase, failure=None, detail="", duration_s=duration_s, metrics=metrics)


@lru_cache(maxsize=16)
def _oscillator(omega: float, zeta: float, step_s: float) -> tuple[Array, Array]:
    """State transition (2, 2) and drive (2,) of ë + 2 ζ ω ė + ω² e = u over one step of constant u."""
    from scipy.linalg import expm

    system = np.array([[0.0, 1.0, 0.0], [-(omega**2), -2.0 * zeta * omega, 1.0], [0.0, 0.0, 0.0]])
    exact = expm(system * step_s)
    return exact[:2, :2], exact[:2, 2]


def _response(transition: Array, drive: Array, acceleration: Array) -> Array:
    """Deviations (n + 1, joints) of an oscillator from rest under accelerations (n, joints) of its target.

    By the Cayley-Hamilton theorem the state's recurrence x' = A x - b u is a second-order recurrence in the deviation:
    e'' = tr A e' - det A e - b₀ u' - (A₀₁ b₁ - A₁₁ b₀) u, a triangular system of three bands.
    """
    from scipy.linalg.lapack import dtbtrs

    count = len(acceleration) + 1
    trace, determinant = transition[0, 0] + transition[1, 1], np.linalg.det(transition)
    driven = np.zeros((count, acceleration.shape[1]))
    driven[1:] = -drive[0] * acceleration
    driven[2:] -= (transition[0, 1] * drive[1] - transition[1, 1] * drive[0]) * acceleration[:-1]
    bands = np.ones((3, count))
    bands[1], bands[2] = -trace, determinant
    deviations, _ = dtbtrs(bands, driven, uplo="L", diag="U")
    rows: Array = deviations
    return rows
