"""Running the timed moves of a trial on a fresh plant."""

from __future__ import annotations

from collections.abc import Callable

from rgss.evidence import Fidelity, Phase
from rgss.physics import TorqueArm, open_world
from rgss.trials.execution import Execution
from rgss.trials.monitors import StepObserver
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plants import DynamicPlant, KinematicPlant
from rgss.trials.program import run_program
from rgss.trials.reference import reference_of
from rgss.trials.timing import TaskTiming
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of


def execute(
    spec: TrialSpec,
    cell: Workcell,
    timing: TaskTiming,
    *,
    observer: StepObserver | None = None,
    checkpoint: Callable[[], None] | None = None,
) -> tuple[PhaseResult, ...]:
    """Run the timed moves on a fresh plant of the trial's fidelity.

    Args:
        spec: The trial.
        cell: Kinematics of the tool.
        timing: The trajectories.
        observer: Looks on after every step in contact physics; the other fidelities have nothing to show.
        checkpoint: Called between two steps, which in the kinematic model are whole phases; it may wait,
            or end the task by raising.

    Raises:
        SimulationError: The physics engine cannot build the world.
    """
    physics, scene = spec.settings.physics, spec.scene
    references = {}
    for phase in Phase:
        if phase in timing.trajectories:
            references[phase] = reference_of(
                timing.trajectories[phase], cell.arm, step_s=physics.step_s, gravity_m_s2=scene.gravity_m_s2
            )
    control, gripper = spec.settings.control, spec.gripper
    if spec.fidelity is Fidelity.KINEMATIC:
        model = KinematicPlant(cell.arm, gripper, scene.workpiece, control, step_s=physics.step_s)
        return run_program(model, references, checkpoint=checkpoint)
    if spec.fidelity is Fidelity.DYNAMIC:
        with TorqueArm(scene.robot, gripper, physics, gravity_m_s2=scene.gravity_m_s2) as machine:
            plant = DynamicPlant(machine, cell.arm, scene, gripper, physics, control, checkpoint=checkpoint)
            return run_program(plant, references)
    # A light object, and light fingers, take more iterations to pass the fingers' force: fewer let them creep.
    firm = physics.passing(
        force_n=gripper.finger_force_n,
        speed_m_s=gripper.finger_velocity_m_s,
        lightest_kg=min(scene.workpiece.mass_kg, gripper.finger_mass_kg),
    )
    with open_world(scene, gripper, firm) as world:
        return Execution(world, references, control, cell.arm, observer=observer, checkpoint=checkpoint).run()


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
    return execute(spec, cell_of(spec), timing, observer=observer, checkpoint=checkpoint)
