"""Plant of the middle fidelity: the arm under joint torques, without contact.

It gives the required torques, the tracking error, and the joints that reach their limits. The object is a load of the
flange from the grasp to the release; forces on it and slip are not modelled.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rgss.evidence import Failure, Metric
from rgss.kinematics import Arm, ArmDynamics, gripper_loads, workpiece_load
from rgss.physics import PhysicsSettings, TorqueArm
from rgss.scenes import Gripper, JointKind, Scene, Workpiece, grasp_opening_m, object_in_hand, unpowered_shortfall
from rgss.tasks import CheckStep, GripStep, MoveStep, NeutralStep, ReleaseStep, Step, StepControl, TaskProgram, WaitStep
from rgss.trials.hands import hand_of
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants.arm_observations import ArmObservations, tool_metrics_by_differences
from rgss.trials.plants.control import ControlSettings
from rgss.trials.plants.follower_slip import slip_detail
from rgss.trials.plants.grip_sequence import GripSequence
from rgss.trials.plants.joint_controller import ControlLaw, JointController, control_law, stated_in_step
from rgss.trials.reference import Array, Reference


class DynamicPlant:
    """Arm under joint control, with a Boolean hand."""

    def __init__(
        self,
        machine: TorqueArm,
        arm: Arm,
        scene: Scene,
        gripper: Gripper,
        settings: PhysicsSettings,
        control: ControlSettings,
        *,
        task: TaskProgram,
        controller: JointController | None = None,
        assumed: Sequence[Workpiece] = (),
        checkpoint: Callable[[], None] | None = None,
    ) -> None:
        """Prepare the plant.

        Args:
            machine: The simulated arm.
            arm: Kinematics of the tool.
            scene: The robot with its limits, gravity, the object.
            gripper: The hand.
            settings: Step length.
            control: Thresholds of the task program.
            controller: Mode and gains; computed torque by default.
            assumed: Objects of the controller's model; those of the scene by default.
            checkpoint: Callback before each step; it may block, or end the task by raising.
            task: The task.
        """
        self._machine = machine
        self._arm = arm
        self._scene = scene
        self._gripper = gripper
        self._hand = hand_of(gripper)
        self._step_s = settings.step_s
        self._control = control
        self._controller = controller or JointController()
        self._law = self._law_of(self._controller)
        self._own_control: StepControl | None = None
        self._checkpoint = checkpoint
        self._limits = np.array([joint.torque_n_m for joint in scene.robot.joints])
        opening_m = gripper.geometry.largest_opening_m
        self._assumed = {one.id: one for one in assumed}
        self._grips = GripSequence(task, scene, gripper.geometry)
        empty = gripper_loads(gripper, opening_m)
        self._empty = ArmDynamics(scene.robot, empty, gravity_m_s2=scene.gravity_m_s2)
        self._loaded: dict[str, ArmDynamics] = {}
        self._model = self._empty
        self._at_rad: Array = np.zeros(len(scene.robot.joints))
        self._followed: dict[str, list[Array]] = {}
        self._has_followers, self._slipped = bool(scene.robot.followers), ""

    @property
    def followed(self) -> Mapping[str, Array]:
        """Joint positions (k + 1, n) at each step of the moves that ran, including settling; the first at the start."""
        return {phase: np.array(positions) for phase, positions in self._followed.items()}

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration."""
        self._at_rad = np.array(configuration_rad)
        self._machine.reset(configuration_rad, 0.0)

    def move(self, step: MoveStep, reference: Reference) -> PhaseResult:
        """Follow the targets until the end is reached."""
        log = self._log()
        self._enter(step)
        log.positions_rad.append(np.array(self._machine.state()[0]))
        self._followed[step.name] = log.positions_rad
        target = reference.positions_rad
        # The engine adds an acceleration to the speed of the previous step, and that speed to the position.
        speeds = np.vstack([np.zeros((1, target.shape[1])), reference.velocities_rad_s])
        accelerations = np.diff(speeds, axis=0) / self._step_s
        actual = [
            self._drive(target[index], speeds[index], accelerations[index], log) for index in range(reference.steps)
        ]
        # The arm begins where it is, which after a grip or another move is not quite where it should be.
        tool_m = self._arm.tool_position(np.vstack([log.positions_rad[0], *actual]))
        tool = tool_metrics_by_differences(tool_m, reference.tool_m, step_s=self._step_s)
        log.arm.note_tool(tool)
        self._at_rad = target[-1]
        failure, detail = None, ""
        is_settled = self._settle(log, self._largest_rad(step))
        if tool["tracking_error_m"] > self._control.largest_tracking_error_m:
            failure, detail = Failure.TRACKING_ERROR, log.arm.tracking_failure(tool["tracking_error_m"])
        elif not is_settled:
            failure, detail = Failure.TRACKING_ERROR, self._shortfall(step, log)
        return self._result(step.name, log, failure, detail, {})

    def grip(self, step: GripStep) -> PhaseResult:
        """Close: the arm rests for the fingers' travel and the duration of a firm grasp."""
        view = self._grips.view_of(step)
        misfit = self._hand.misfit(view)
        if misfit:
            waited = self._rest(step, self._hand.longest_travel_s + self._control.grasp_timeout_s, {})
            return replace(waited, failure=Failure.NO_FIRM_GRASP, detail=misfit)
        firm_s = self._control.firm_grasp_s if step.firm_s is None else step.firm_s
        result = self._rest(step, self._hand.closing_s(view, firm_s), {})
        self._machine.hold_fingers(self._grips.travel_m(step))
        self._machine.attach(view.workpiece, object_in_hand(view, self._gripper.geometry))
        self._model = self._loaded_with(view)
        return result

    def release(self, step: ReleaseStep) -> PhaseResult:
        """Open: the arm rests for the fingers' travel."""
        self._machine.detach()
        self._machine.hold_fingers(0.0)
        self._model = self._empty
        opening_s = self._hand.opening_s(self._grips.view_of(step))
        return self._rest(step, opening_s, {"opening_s": opening_s})

    def neutral(self, step: NeutralStep) -> PhaseResult:
        """Rest for the duration of a command; what the unpowered fingers do not hold is dropped."""
        result = self._rest(step, self._hand.least_opening_s or self._hand.longest_travel_s, {})
        why = unpowered_shortfall(self._gripper, self._grips.view_of(step)) if self._grips.is_lifted(step) else ""
        return replace(result, failure=Failure.OBJECT_DROPPED, detail=why) if why else result

    def wait(self, step: WaitStep) -> PhaseResult:
        """Hold the configuration with the held object."""
        return self._rest(step, step.duration_s, {})

    def check(self, step: CheckStep) -> PhaseResult:
        """Rest as contact physics does, and assume that the conditions hold: free objects are not modelled."""
        return self._rest(step, self._control.settled_s, {})

    def _law_of(self, controller: JointController) -> ControlLaw:
        return control_law(controller, self._scene.robot.joints, step_s=self._step_s, tool=self._arm)

    def _enter(self, step: Step) -> None:
        """Begin a step with its own control or that of the study; a new control law starts at rest."""
        own = step.control
        if own != self._own_control:
            self._own_control = own
            self._law = self._law_of(self._controller if own is None else stated_in_step(self._controller, own))

    def _loaded_with(self, view: Scene) -> ArmDynamics:
        """Dynamics of the arm in the controller's model, with the object of a scene in the hand."""
        workpiece = view.workpiece
        if workpiece.id not in self._loaded:
            gripper, geometry = self._gripper, self._gripper.geometry
            known = self._assumed.get(workpiece.id, workpiece)
            loads, at = gripper_loads(gripper, grasp_opening_m(view, geometry)), object_in_hand(view, geometry)
            centre = geometry.grasp_centre
            held = workpiece_load(known, centre if at is None else centre @ at)
            self._loaded[workpiece.id] = ArmDynamics(view.robot, (*loads, held), gravity_m_s2=view.gravity_m_s2)
        return self._loaded[workpiece.id]

    def _rest(self, step: Step, duration_s: float, metrics: dict[str, Metric]) -> PhaseResult:
        log = self._log()
        self._enter(step)
        still = np.zeros(len(self._at_rad))
        for _ in range(math.ceil(duration_s / self._step_s)):
            self._drive(self._at_rad, still, still, log)
        return self._result(step.name, log, None, "", metrics)

    def _log(self) -> _Log:
        return _Log(arm=ArmObservations(self._scene.robot.joints, self._step_s))

    def _result(
        self, phase: str, log: _Log, failure: Failure | None, detail: str, metrics: dict[str, Metric]
    ) -> PhaseResult:
        observed = log.arm.metrics() if log.steps else {}
        if self._slipped and failure in (None, Failure.TRACKING_ERROR):
            failure, detail = Failure.TRACKING_ERROR, slip_detail(self._scene.robot, self._slipped)
        return PhaseResult(
            phase=phase,
            failure=failure,
            detail=detail,
            duration_s=log.steps * self._step_s,
            metrics={**metrics, **observed},
        )

    def _drive(self, target: Array, speed: Array, acceleration: Array, log: _Log) -> Array:
        """One step of the controller; returns the joint positions after it."""
        if self._checkpoint is not None:
            self._checkpoint()
        q, dq = (np.array(values) for values in self._machine.state())
        torques = self._model.torques(q, dq, self._law(target, speed, acceleration, q, dq))
        log.steps += 1
        self._machine.step(np.clip(torques, -self._limits, self._limits).tolist())
        reached_rad, speeds_rad_s = (np.array(values) for values in self._machine.state())
        log.arm.note_steps(torques[None], speeds_rad_s[None])
        if self._has_followers and not self._slipped:
            self._slipped = self._machine.slipped_follower
        log.positions_rad.append(reached_rad)
        return reached_rad

    def _errors_rad(self) -> Array:
        """Error of each joint, in m where it slides."""
        errors: Array = np.abs(np.array(self._machine.state()[0]) - self._at_rad)
        return errors

    def _largest_rad(self, step: MoveStep) -> float:
        """Error that a joint may have at the end of a move."""
        return self._controller.reached_rad if step.reached_rad is None else step.reached_rad

    def _shortfall(self, step: MoveStep, log: _Log) -> str:
        """Detail of the failure of a move whose end is not reached in time."""
        errors = self._errors_rad()
        joint = self._scene.robot.joints[int(np.argmax(errors))]
        unit = "m" if joint.kind is JointKind.PRISMATIC else "rad"
        return (
            f"{joint.name} was {float(errors.max()):.2g} {unit} from its target "
            f"{self._controller.settling_limit_s:g} s after the move, at most {self._largest_rad(step):.2g} are allowed"
            f"{log.arm.saturated_joints()}"
        )

    def _settle(self, log: _Log, largest_rad: float) -> bool:
        still = np.zeros(len(self._at_rad))
        for _ in range(math.ceil(self._controller.settling_limit_s / self._step_s)):
            if float(self._errors_rad().max()) <= largest_rad:
                return True
            self._drive(self._at_rad, still, still, log)
        return False


@dataclass(slots=True)
class _Log:
    """Observations of one phase, and its number of steps."""

    arm: ArmObservations
    steps: int = 0
    positions_rad: list[Array] = field(default_factory=list)
