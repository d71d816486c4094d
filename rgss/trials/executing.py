"""Execution of the timed moves of a trial on a new plant."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace

from rgss.evidence import Fidelity
from rgss.physics import TorqueArm, open_world, passing_mass_kg
from rgss.scenes import Gripper, Scene, Workpiece
from rgss.trials.conditions import Conditions, conditions_of
from rgss.trials.controlled_motion import controlled_motion
from rgss.trials.execution import Execution
from rgss.trials.grasp_choice import with_chosen_grasp
from rgss.trials.monitors import ForceSensorErrors, GripEstimate, StepObserver
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import DynamicPlant, GripSequence, KinematicPlant
from rgss.trials.program import run_program
from rgss.trials.reference import Reference, reference_of
from rgss.trials.timing import TaskTiming
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of, with_grasp_of


def execute(
    spec: TrialSpec,
    cell: Workcell,
    timing: TaskTiming,
    *,
    observer: StepObserver | None = None,
    checkpoint: Callable[[], None] | None = None,
) -> tuple[PhaseResult, ...]:
    """Run the timed moves on a new plant of the trial's fidelity.

    Args:
        spec: The trial.
        cell: Kinematics of the tool.
        timing: The trajectories.
        observer: Callback after each step in contact physics; other fidelities do not call it.
        checkpoint: Callback between two steps, which in the kinematic model are whole phases; it may block, or end the
            task by raising.

    Raises:
        SimulationError: The physics engine cannot build the world.
    """
    conditions = conditions_of(spec)
    scene = with_grasp_of(conditions.true_scene, cell)
    references = {
        phase: reference_of(
            timing.trajectories[phase],
            cell.arm,
            step_s=spec.settings.physics.step_s,
            gravity_m_s2=scene.gravity_m_s2,
        )
        for phase in spec.task.phases
        if phase in timing.trajectories
    }
    if spec.fidelity is Fidelity.KINEMATIC:
        plant = _kinematic_plant(spec, cell, scene, conditions.true_gripper)
        results = run_program(plant, references, task=spec.task, checkpoint=checkpoint)
    elif spec.fidelity is Fidelity.DYNAMIC:
        with _dynamic_plant(spec, cell, scene, conditions, checkpoint) as dynamic:
            results = run_program(dynamic, references, task=spec.task)
    else:
        results = _in_contact(spec, cell, scene, conditions, references, observer=observer, checkpoint=checkpoint)
    return _with_quality(results, timing)


def _kinematic_plant(spec: TrialSpec, cell: Workcell, scene: Scene, gripper: Gripper) -> KinematicPlant:
    return KinematicPlant(
        cell.arm,
        scene.robot.joints,
        gripper,
        GripSequence(spec.task, scene, gripper.geometry),
        spec.settings.control,
        step_s=spec.settings.physics.step_s,
    )


@contextmanager
def _dynamic_plant(
    spec: TrialSpec, cell: Workcell, scene: Scene, conditions: Conditions, checkpoint: Callable[[], None] | None
) -> Iterator[DynamicPlant]:
    physics, gripper = spec.settings.physics, conditions.true_gripper
    with TorqueArm(scene.robot, gripper, physics, gravity_m_s2=scene.gravity_m_s2) as machine:
        yield DynamicPlant(
            machine,
            cell.arm,
            scene,
            gripper,
            physics,
            spec.settings.control,
            controller=spec.settings.controller,
            assumed=[one.workpiece for one in conditions.scene.objects],
            checkpoint=checkpoint,
            task=spec.task,
        )


def _in_contact(
    spec: TrialSpec,
    cell: Workcell,
    scene: Scene,
    conditions: Conditions,
    references: Mapping[str, Reference],
    *,
    observer: StepObserver | None,
    checkpoint: Callable[[], None] | None,
) -> tuple[PhaseResult, ...]:
    """The phases in contact physics; where the controller acts in contact, on the motion that it makes of the arm."""
    physics, gripper, motion = spec.settings.physics, conditions.true_gripper, None
    if spec.settings.controller.in_contact:
        with _dynamic_plant(spec, cell, scene, conditions, checkpoint) as plant:
            motion = controlled_motion(
                plant,
                references,
                task=spec.task,
                tool=cell.arm,
                step_s=physics.step_s,
                gravity_m_s2=scene.gravity_m_s2,
            )
    # Light objects and fingers need more iterations to transmit the fingers' force; with fewer they creep.
    firm = physics.passing(
        force_n=gripper.finger_force_n,
        speed_m_s=gripper.finger_velocity_m_s,
        lightest_kg=min(*(one.workpiece.mass_kg for one in scene.objects), passing_mass_kg(gripper)),
    )
    with open_world(scene, gripper, firm, joint_offsets_rad=conditions.joint_offsets_rad) as world:
        execution = Execution(
            world,
            references if motion is None else motion.references,
            spec.settings.control,
            cell.arm,
            estimates=_grip_estimates(spec, conditions),
            observer=observer,
            checkpoint=checkpoint,
            task=spec.task,
            settling_limit_s=spec.settings.controller.settling_limit_s,
        )
        results = execution.run()
    return results if motion is None else motion.joined(results)


def _grip_estimates(spec: TrialSpec, conditions: Conditions) -> dict[str, GripEstimate]:
    """Grip estimates of the robot by object, without objects whose true values are known."""
    objects = [one.workpiece for one in conditions.scene.objects]
    # Each object has its own sensor noise; that of the first is named after the sensor only.
    noises = ("", *(one.id for one in objects[1:]))
    return {
        one.id: _grip_estimate(spec, conditions, one, noise_of=noise)
        for one, noise in zip(objects, noises, strict=True)
        if not conditions.is_grip_known(one.id)
    }


def _grip_estimate(spec: TrialSpec, conditions: Conditions, assumed: Workpiece, *, noise_of: str) -> GripEstimate:
    errors = ForceSensorErrors(
        noise_n=conditions.sensor_noise_n, offset_n=conditions.sensor_offset_n, delay_s=conditions.sensor_delay_s
    )
    return GripEstimate(
        errors,
        mass_kg=assumed.mass_kg,
        friction=conditions.design_gripper.grip_coefficient(assumed.friction),
        fingers=max(1, spec.gripper.geometry.fingers),
        window_s=spec.settings.control.force_window_s,
        rate_hz=spec.settings.physics.rate_hz,
        seed=spec.seed,
        noise_of=noise_of,
    )


def execution_of(
    spec: TrialSpec,
    timing: TaskTiming,
    *,
    observer: StepObserver | None = None,
    checkpoint: Callable[[], None] | None = None,
) -> tuple[PhaseResult, ...]:
    """The execution of a trial.

    Args:
        spec: The trial.
        timing: Its timing.
        observer: As of `execute`.
        checkpoint: As of `execute`.

    Raises:
        SimulationError: The physics engine cannot build the world.
    """
    cell = cell_of(spec)
    results = execute(spec, cell, timing, observer=observer, checkpoint=checkpoint)
    return with_chosen_grasp(results, cell.scene, spec.task)


def _with_quality(results: tuple[PhaseResult, ...], timing: TaskTiming) -> tuple[PhaseResult, ...]:
    """Phases with the clearance and the manipulability of their reference motion."""
    return tuple(
        result
        if (quality := timing.qualities.get(result.phase)) is None
        else replace(
            result,
            metrics={
                **result.metrics,
                "path_clearance_min_m": quality.clearance_m,
                "manipulability_min_m3": quality.manipulability_m3,
            },
        )
        for result in results
    )
