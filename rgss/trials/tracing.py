"""Recording of a trial's trace."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from rgss.evidence import TrialRecord
from rgss.evidence.records import PhaseSpan, TrialTrace
from rgss.kinematics import Arm
from rgss.physics import Contacts, ContactWorld
from rgss.trials.conditions import conditions_of
from rgss.trials.pieces import TrialSpec, run_trial

TRACE_RATE_HZ = 240.0


def run_traced_trial(spec: TrialSpec, *, rate_hz: float = TRACE_RATE_HZ) -> tuple[TrialRecord, TrialTrace | None]:
    """Run one trial and record its trace; the trial's record equals that of `run_trial`.

    Args:
        spec: The trial.
        rate_hz: Samples a second, at most one for each physics step.

    Returns:
        The record, and the trace; None if nothing moved.

    Raises:
        DefinitionError: The fidelity is not available.
        SimulationError: The physics engine cannot build the world.
    """
    recorder = TraceRecorder(spec, rate_hz=rate_hz)
    record = run_trial(spec, observer=recorder)
    # The execution, shared with other trials, may contain moves beyond this design's planning limit.
    return record, recorder.trace({phase.phase for phase in record.phases if phase.duration_s is not None})


class TraceRecorder:
    """Observer of one execution that samples the world at a fixed rate."""

    def __init__(self, spec: TrialSpec, *, rate_hz: float = TRACE_RATE_HZ) -> None:
        """Start without samples.

        Args:
            spec: The observed trial.
            rate_hz: Samples a second.
        """
        physics = spec.settings.physics
        self._spec = spec
        self._step_s = physics.step_s
        self._stride = max(1, round(physics.rate_hz / rate_hz))
        self._steps = 0
        self._phase_steps = 0
        self._spans: list[PhaseSpan] = []
        self._times_s: list[float] = []
        self._joints: list[tuple[tuple[float, ...], tuple[float, ...]]] = []
        self._travel_m: list[tuple[float, ...]] = []
        self._workpiece: list[tuple[float, ...]] = []
        others = spec.scene.others
        self._objects: dict[str, list[tuple[float, ...]]] = (
            {one.workpiece.id: [] for one in spec.scene.objects} if others else {}
        )
        self._forces_n: list[tuple[float, ...]] = []
        self._margins: list[float] = []
        self._commanded_n: list[float] = []

    def after_step(
        self,
        world: ContactWorld,
        phase: str,
        contacts: Contacts,
        grip_margin: float | None,
        commanded_force_n: float | None,
    ) -> None:
        """Take a sample, or merge the step's forces and margin into the last one."""
        new_phase = not self._spans or self._spans[-1].phase != phase
        self._phase_steps = 0 if new_phase else self._phase_steps + 1
        start_s = self._steps * self._step_s if new_phase else self._spans.pop().start_s
        self._steps += 1
        margin = math.nan if grip_margin is None else grip_margin
        if self._phase_steps % self._stride == 0:
            self._sample(world, contacts, margin)
            self._commanded_n.append(math.nan if commanded_force_n is None else commanded_force_n)
        else:
            pairs = zip(self._forces_n[-1], contacts.finger_forces_n, strict=True)
            self._forces_n[-1] = tuple(max(pair) for pair in pairs)
            self._margins[-1] = float(np.fmin(self._margins[-1], margin))
        end_s = self._steps * self._step_s
        self._spans.append(PhaseSpan(phase=phase, start_s=start_s, end_s=end_s, last=len(self._times_s) - 1))

    def trace(self, phases: Collection[str]) -> TrialTrace | None:
        """Trace of these phases, which must be the first ones that ran; None if there are none."""
        spans = tuple(span for span in self._spans if span.phase in phases)
        if not spans:
            return None
        spec, count = self._spec, spans[-1].last + 1
        positions = np.array([position for position, _ in self._joints[:count]])
        if offsets := conditions_of(
            spec
        ).joint_offsets_rad:  # the trace has the true positions of the arm, not the reported ones
            positions = positions + np.array(offsets)
        velocities = np.array([velocity for _, velocity in self._joints[:count]])
        arm = Arm(spec.scene.robot, spec.gripper.geometry.grasp_centre)
        jacobians = np.array([arm.tool_jacobian(position)[:3] for position in positions])
        workpiece = np.array(self._workpiece[:count])
        return TrialTrace(
            spans=spans,
            time_s=np.array(self._times_s[:count]),
            joint_positions_rad=positions,
            finger_travel_m=np.array(self._travel_m[:count]),
            workpiece_position_m=workpiece[:, :3],
            workpiece_quaternion_xyzw=workpiece[:, 3:],
            tool_position_m=arm.tool_position(positions),
            tool_speed_m_s=np.linalg.norm(np.einsum("nij,nj->ni", jacobians, velocities), axis=1),
            tool_speed_limit_m_s=conditions_of(spec).tool_speed_m_s,
            finger_forces_n=np.array(self._forces_n[:count]),
            commanded_force_n=np.array(self._commanded_n[:count]),
            grip_margin=np.array(self._margins[:count]),
            objects={name: np.array(poses[:count]) for name, poses in self._objects.items()},
        )

    def _sample(self, world: ContactWorld, contacts: Contacts, margin: float) -> None:
        positions, velocities, _ = world.arm_state()
        pose = world.workpiece_pose()
        self._times_s.append(self._steps * self._step_s)
        self._joints.append((positions, velocities))
        self._travel_m.append(world.finger_travel_m())
        self._workpiece.append((*pose.position_m, *pose.quaternion_xyzw))
        for name, poses in self._objects.items():
            at = world.object_pose(name)
            poses.append((*at.position_m, *at.quaternion_xyzw))
        self._forces_n.append(contacts.finger_forces_n)
        self._margins.append(margin)
