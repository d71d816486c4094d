"""Plant of the highest fidelity: arm, hand, object and scene in contact."""

# long file: one class with a method for each kind of step; they share the state of the hand and its monitors.

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from rgss.evidence import Failure, Metric
from rgss.grasping import GraspGeometryCache
from rgss.physics import Contacts, ContactWorld
from rgss.scenes import Pose
from rgss.tasks import (
    CheckStep,
    GripStep,
    HandAction,
    MoveStep,
    NeutralStep,
    ReleaseStep,
    Stage,
    Step,
    TaskProgram,
    WaitStep,
)
from rgss.trials.grip_control import GripControl
from rgss.trials.hands import hand_of
from rgss.trials.monitors import (
    DragMonitor,
    ForceSensor,
    GripEstimate,
    InHandMotionTracker,
    LandingMonitor,
    PhaseMonitor,
    PlacedObjectMonitor,
    StepObserver,
    ToolKinematics,
    grasp_metrics,
    violated_condition,
)
from rgss.trials.object_checks import check_displacement, check_place, has_moved
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import ControlSettings, MoveTargets
from rgss.trials.program import run_program
from rgss.trials.reference import Array, Reference
from rgss.trials.task_objects import TaskObjects

_OPEN_TOLERANCE_M = 5.0e-4


class Execution:
    """Plant of the highest fidelity: one run of the task program in one contact world."""

    def __init__(
        self,
        world: ContactWorld,
        references: Mapping[str, Reference],
        control: ControlSettings,
        kinematics: ToolKinematics,
        *,
        task: TaskProgram,
        estimates: Mapping[str, GripEstimate] | None = None,
        observer: StepObserver | None = None,
        checkpoint: Callable[[], None] | None = None,
        settling_limit_s: float = 0.5,
    ) -> None:
        """Prepare a run.

        Args:
            world: A new world.
            references: Targets of the moves; the program ends before the first move without targets.
            control: Thresholds.
            kinematics: The arm's, with the tool at the grasp centre.
            estimates: Grip estimates of the robot by object id, without objects whose true values are known.
            observer: Callback after each step.
            checkpoint: Callback after every step; it may block, or end the task by raising.
            task: The task.
            settling_limit_s: Longest settling time after a move with a stated tolerance.
        """
        self._world = world
        self._settling_limit_s = settling_limit_s
        self._task = task
        self._objects = TaskObjects(world, self._task)
        self._references = references
        self._control = control
        self._kinematics = kinematics
        self._observer = observer
        self._checkpoint = checkpoint
        self._is_alone = observer is None and checkpoint is None
        self._step_s = world.settings.step_s
        self._held_at: Pose | None = None
        self._memory = GraspGeometryCache()
        self._sensor = ForceSensor(world.scene.workpiece.force_window_s, world.settings.rate_hz)
        self._estimates = estimates or {}
        self._hand = hand_of(world.gripper)
        self._grip = self._grip_control()
        self._configuration: tuple[float, ...] = ()

    def run(self) -> tuple[PhaseResult, ...]:
        """Run the phases in order until one fails or has no targets; returns those that ran."""
        return run_program(self, self._references, task=self._task)

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, with the hand open."""
        self._configuration = tuple(configuration_rad)
        self._world.reset_arm(self._configuration)

    def move(self, step: MoveStep, reference: Reference) -> PhaseResult:
        """Follow a timed motion, with the held object."""
        world, stage = self._world, self._enter(step)
        carried_at = self._held_at if stage.is_carrying else None
        self._grip.begin_phase()
        placed = PlacedObjectMonitor(world) if stage.is_placed else None
        targets = self._targets(step, reference)
        monitor = self._phase_monitor(carried_at, self._objects.resting_on(stage), targets.tool_m, placed)
        steps, least_margin, is_alone = 0, self._control.tighten_below, self._is_alone
        world.reduce_solver_effort(free=carried_at is None)
        # The overhead of a step is a tenth of its cost: everything possible is computed before the loop.
        is_held = carried_at is not None
        for position, velocity, target, load, arc_m in targets:
            world.command_arm(position, velocity)
            world.step()
            if is_held:
                world.bend(arc_m)
            steps += 1
            contacts = monitor.after_step(load, target)
            if not is_alone:
                self._show(stage, monitor, contacts)
            if carried_at is not None:
                is_held = min(contacts.finger_forces_n) > 0.0
                self._grip.since_tightening_s += self._step_s
                margin = self._grip.margin(monitor.grip_margin, contacts.finger_forces_n, load)
                if self._hand.has_force_feedback and margin is not None and margin < least_margin:
                    self._grip.keep()
            if monitor.failure is not None:
                break
        world.reduce_solver_effort(free=False)
        self._configuration = tuple(reference.positions_rad[-1].tolist())
        if targets.shortfall:
            monitor.fail(Failure.TRACKING_ERROR, targets.shortfall)
        monitor.finish()
        metrics = monitor.metrics()
        metrics["commanded_tool_speed_m_s"] = reference.peak_tool_speed_m_s
        metrics["commanded_tool_acceleration_m_s2"] = reference.peak_tool_acceleration_m_s2
        if carried_at is not None:
            metrics["tightenings"] = self._grip.tightenings
        if monitor.failure is None:
            self._check_move(stage, monitor, metrics)
        return self._result(step, monitor, steps, metrics)

    def _targets(self, step: MoveStep, reference: Reference) -> MoveTargets:
        return MoveTargets(
            reference,
            reached_rad=step.reached_rad,
            positions_rad=lambda: self._world.arm_state()[0],
            gravity_m_s2=self._world.scene.gravity_m_s2,
            longest_wait_steps=math.ceil(self._settling_limit_s / self._step_s),
        )

    def _check_move(self, stage: Stage, monitor: PhaseMonitor, metrics: dict[str, Metric]) -> None:
        """Post-condition of a move: the object must not have moved, or at the end must be in its place."""
        if stage.is_approach:
            metrics["workpiece_displacement_m"], violation = check_displacement(
                self._world, self._control.displaced_m, touched=monitor.robot_touched_object
            )
            monitor.note(violation)
        elif stage.is_placed:
            self._check_place(monitor, metrics)

    def _check_place(self, monitor: PhaseMonitor, metrics: dict[str, Metric]) -> None:
        placed, violation = check_place(self._world)
        metrics.update(placed)
        monitor.note(violation)

    def grip(self, step: GripStep) -> PhaseResult:
        """Close until every finger holds above the force that Coulomb friction needs."""
        stage = self._enter(step)
        world, control = self._world, self._control
        scene = world.scene
        monitor = self._phase_monitor(None, scene.support)
        needed_n = self._hand.needed_force_n(self._grip.mass_kg * scene.gravity_m_s2, self._grip.friction)
        stated_n = step.firm_above_n
        firm_for_s = control.firm_grasp_s if step.firm_s is None else step.firm_s
        threshold_n = needed_n if stated_n is None else stated_n
        travel_s = self._hand.longest_travel_s
        self._grip.close()
        self._grip.tightenings = 0
        hand, look_every = (
            InHandMotionTracker(world),
            max(1, round(world.settings.rate_hz / control.observation_rate_hz)),
        )
        firm_s, touching_s, steps = 0.0, 0.0, 0
        forces: tuple[float, ...] = (0.0,)
        least_s = self._hand.least_closing_s - 1e-9
        while monitor.failure is None and (firm_s < firm_for_s - 1e-9 or steps * self._step_s < least_s):
            self._hold_arm_and_step()
            contacts = self._observe(stage, monitor, scene.gravity_m_s2)
            steps += 1
            if steps % look_every == 0:
                hand.look(steps)
            forces = self._grip.readings(contacts.finger_forces_n)
            is_firm = self._hand.is_firm(forces, threshold_n) and (stated_n is None or min(forces) > stated_n)
            firm_s = firm_s + self._step_s if is_firm else 0.0
            touching_s = touching_s + self._step_s if min(forces) > 0.0 else 0.0
            if firm_s == 0.0 and touching_s > firm_for_s:
                touching_s = 0.0
                self._grip.tighten()
            if steps * self._step_s > travel_s + control.grasp_timeout_s:
                why = self._hand.misfit(scene) or world.grip_fault
                monitor.fail(Failure.NO_FIRM_GRASP, why or self._hand.shortfall(forces, threshold_n))
        self._held_at = hand.look(steps).held
        metrics = monitor.metrics()
        metrics["finger_force_n"] = forces
        metrics["finger_force_needed_n"] = needed_n
        metrics["tightenings"] = self._grip.tightenings
        metrics["finger_travel_m"] = world.finger_travel_m()
        if monitor.failure is None:
            metrics.update(grasp_metrics(world, hand.motion, self._held_at, self._memory))
        return self._result(step, monitor, steps, metrics)

    def release(self, step: ReleaseStep) -> PhaseResult:
        """Open to the initial position and wait until the object is at rest."""
        stage = self._enter(step)
        world, gripper, control = self._world, self._world.gripper, self._control
        monitor, landing = self._phase_monitor(None, self._objects.resting_on(stage)), LandingMonitor(world)
        drag = DragMonitor(world, control)
        travel_s = self._hand.longest_travel_s
        world.drive_fingers(-gripper.finger_velocity_m_s, gripper.finger_force_n)
        steps = 0
        contacts = world.contacts()
        least_s = self._hand.least_opening_s - 1e-9
        open_within_m = _OPEN_TOLERANCE_M if step.opened_m is None else step.opened_m
        while monitor.failure is None and (
            max(world.finger_travel_m(), default=0.0) > open_within_m or steps * self._step_s < least_s
        ):
            self._hold_arm_and_step()
            contacts = self._observe(stage, monitor, 0.0)
            monitor.note(landing.after_step())
            monitor.note(drag.after_step(contacts))
            steps += 1
            if steps * self._step_s > travel_s + control.grasp_timeout_s:
                open_m = max(world.finger_travel_m())
                monitor.fail(Failure.NOT_RELEASED, f"a finger is still {open_m * 1e3:.1f} mm from open")
        monitor.note(landing.after_opening())
        opening_s = steps * self._step_s
        world.hold_open()
        still_s, waited_s, stood_at = 0.0, 0.0, world.workpiece_pose()
        while still_s < control.settled_s - 1e-9 and waited_s < control.settling_timeout_s and monitor.failure is None:
            self._hold_arm_and_step()
            contacts = self._observe(stage, monitor, 0.0)
            monitor.note(landing.after_step())
            monitor.note(drag.after_step(contacts))
            steps += 1
            waited_s += self._step_s
            still_s += self._step_s
            stands_at = world.workpiece_pose()
            if has_moved(world, control, stood_at, stands_at):
                still_s, stood_at = 0.0, stands_at
        if contacts.fingers_touching:
            monitor.fail(Failure.NOT_RELEASED, f"{contacts.fingers_touching} fingers still touch the object")
        metrics = monitor.metrics()
        metrics.update(landing.metrics())
        metrics.update(drag.metrics())
        metrics["opening_s"] = opening_s
        metrics["settling_s"] = waited_s - still_s
        self._check_place(monitor, metrics)
        self._objects.note_release(stage)
        return self._result(step, monitor, steps, metrics)

    def neutral(self, step: NeutralStep) -> PhaseResult:
        """Switch the drive off: fingers on an object press with what their mechanism resists, others are free."""
        world = self._world
        resisted_n = min(world.gripper.drive.unpowered_force_n, world.gripper.finger_force_n)
        is_held = self._objects.stage(step.name).is_held and resisted_n > 0.0
        # The solver passes a motor's force in proportion to its speed: at rest it would let the object go.
        world.drive_fingers(world.gripper.finger_velocity_m_s if is_held else 0.0, resisted_n)
        return self._rest(step, self._hand.least_opening_s or self._hand.longest_travel_s)

    def wait(self, step: WaitStep) -> PhaseResult:
        """Hold the configuration for a time, with the held object."""
        return self._rest(step, step.duration_s)

    def check(self, step: CheckStep) -> PhaseResult:
        """Evaluate the conditions of a check step."""
        before = self._world.object_pose(step.object or self._objects.stage(step.name).object)
        rested = self._rest(step, self._control.settled_s)
        problem = "" if rested.failure else violated_condition(self._world, self._control, step, before)
        return replace(rested, failure=Failure.CHECK_FAILED, detail=problem) if problem else rested

    def _rest(self, step: Step, duration_s: float) -> PhaseResult:
        """Hold the configuration for a time, with the held object."""
        stage, world = self._enter(step), self._world
        # A hand that goes neutral need not hold what stands.
        needs_grip = stage.is_held and not (stage.is_standing and isinstance(step, NeutralStep))
        carried_at = self._held_at if needs_grip else None
        self._grip.begin_phase()
        placed = PlacedObjectMonitor(world) if stage.is_placed else None
        monitor = self._phase_monitor(carried_at, self._objects.resting_on(stage), placed=placed)
        steps, load_m_s2 = 0, world.scene.gravity_m_s2 if stage.is_held else 0.0
        while steps * self._step_s < duration_s - 1e-9 and monitor.failure is None:
            self._hold_arm_and_step()
            self._observe(stage, monitor, load_m_s2)
            steps += 1
        monitor.finish()
        metrics = monitor.metrics()
        if stage.is_placed and monitor.failure is None:
            self._check_place(monitor, metrics)
        return self._result(step, monitor, steps, metrics)

    def _enter(self, step: Step) -> Stage:
        """Begin a phase: make its object that of the world and the grip control."""
        stage = self._objects.stage(step.name)
        if self._objects.enter(stage):
            workpiece, rate_hz = self._world.scene.workpiece, self._world.settings.rate_hz
            self._memory = GraspGeometryCache()
            self._sensor = ForceSensor(workpiece.force_window_s, rate_hz)
            self._grip = self._grip_control()
        return stage

    def _grip_control(self) -> GripControl:
        estimate = self._estimates.get(self._world.scene.workpiece.id)
        return GripControl(self._world, self._control, estimate, is_regulated=self._hand.has_force_feedback)

    def _hold_arm_and_step(self) -> None:
        self._world.command_arm(self._configuration, (0.0,) * len(self._configuration))
        self._world.step()

    def _phase_monitor(
        self,
        carried_at: Pose | None,
        resting_on: str,
        path_m: Sequence[Sequence[float]] | Array = (),
        placed: PlacedObjectMonitor | None = None,
    ) -> PhaseMonitor:
        return PhaseMonitor(
            self._world,
            self._kinematics,
            self._control,
            carried_at=carried_at,
            resting_on=resting_on,
            path_m=path_m,
            memory=self._memory,
            placed=placed,
            sensor=self._sensor,
        )

    def _observe(self, stage: Stage, monitor: PhaseMonitor, load_m_s2: float) -> Contacts:
        """Observe a step in which the arm is at rest."""
        contacts = monitor.after_step(load_m_s2, None)
        if not self._is_alone:
            self._show(stage, monitor, contacts)
        return contacts

    def _show(self, stage: Stage, monitor: PhaseMonitor, contacts: Contacts) -> None:
        """Call the observer and the checkpoint, which may block or end the task."""
        if self._observer is not None:
            is_closed = stage.is_held and stage.step.hand is not HandAction.OPENS
            force_n = self._grip.force_n if is_closed else None
            self._observer.after_step(self._world, stage.step.name, contacts, monitor.grip_margin, force_n)
        if self._checkpoint is not None:
            self._checkpoint()

    def _result(self, step: Step, monitor: PhaseMonitor, steps: int, metrics: dict[str, Metric]) -> PhaseResult:
        monitor.note(self._objects.displaced(self._control.displaced_m))
        pose = self._world.workpiece_pose()
        metrics["workpiece_position_m"] = pose.position_m
        metrics["workpiece_tilt_rad"] = pose.tilt_rad
        return PhaseResult(
            phase=step.name,
            failure=monitor.failure,
            detail=self._objects.named(monitor.detail),
            duration_s=steps * self._step_s,
            metrics=metrics,
        )
