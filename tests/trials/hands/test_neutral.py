"""The neutral state of an open-loop hand: what its unpowered fingers hold, against Coulomb's law."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.cli.driven import timed_task
from rgss.cli.driven.running import _require_neutral
from rgss.drivers import GripperState, SetPoint, SimulatedDriver
from rgss.errors import DefinitionError
from rgss.evidence import Failure, Fidelity
from rgss.scenes import load_gripper_file
from rgss.studies.motion import neutral_findings
from rgss.tasks import NeutralStep, load_task
from rgss.trials import plan_of, timing_of
from rgss.trials.second_engine import mujoco_settings
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import FILES

pytestmark = pytest.mark.engine

MASS_KG = 0.2


@pytest.fixture
def neutral_after(trial):
    """Makes a trial that goes neutral after a step, with fingers that resist with a share of what friction needs."""

    def make(phase, fidelity, share):
        spec = trial("open-loop", fidelity, mass_kg=MASS_KG)
        needed_n = MASS_KG * 9.81 / (2 * 0.7 * spec.scene.workpiece.friction)
        drive = replace(spec.gripper.drive, unpowered_force_n=share * needed_n)
        place = spec.task.phases.index(phase) + 1
        steps = (*spec.task.steps[:place], NeutralStep(name="neutral"), *spec.task.steps[place:])
        return replace(spec, gripper=replace(spec.gripper, drive=drive), task=replace(spec.task, steps=steps))

    return make


@pytest.mark.parametrize("fidelity", Fidelity)
@pytest.mark.parametrize("share", [0.0, 0.8])
def test_what_the_unpowered_fingers_do_not_hold_is_dropped(neutral_after, fidelity, share):
    record = record_without_bench(neutral_after("lift", fidelity, share))

    assert (record.failed_phase, record.failure) == ("neutral", Failure.OBJECT_DROPPED)


@pytest.mark.parametrize("fidelity", Fidelity)
def test_what_they_hold_is_carried_on_and_placed(neutral_after, fidelity):
    record = record_without_bench(neutral_after("lift", fidelity, 1.6))

    assert record.failure_detail == ""
    assert record.success
    neutral = next(phase for phase in record.phases if phase.phase == "neutral")
    assert neutral.duration_s == pytest.approx(0.275, abs=0.01)


@pytest.mark.parametrize(
    ("share", "failed"),
    [(0.0, ("neutral", Failure.OBJECT_DROPPED)), (0.8, ("neutral", Failure.OBJECT_DROPPED)), (1.6, (None, None))],
)
def test_in_the_second_engine_friction_decides_alike(neutral_after, share, failed):
    spec = neutral_after("lift", Fidelity.CONTACT, share)
    record = record_without_bench(replace(spec, settings=replace(spec.settings, physics=mujoco_settings())))

    assert (record.failed_phase, record.failure) == failed
    assert record.success is (failed == (None, None))


@pytest.mark.parametrize("fidelity", [Fidelity.DYNAMIC, Fidelity.CONTACT])
def test_an_object_that_stands_needs_no_force(neutral_after, fidelity):
    spec = neutral_after("grasp", fidelity, 0.0)
    closing = spec.task.steps[spec.task.phases.index("grasp") + 2]
    assert closing.name == "lift"
    record = record_without_bench(spec)
    neutral = next(phase for phase in record.phases if phase.phase == "neutral")
    # It fails at the lift in contact, where nothing holds it, and not before.
    assert neutral.duration_s == pytest.approx(0.275, abs=0.01)
    if fidelity is Fidelity.CONTACT:
        assert (record.failed_phase, record.failure) == ("lift", Failure.OBJECT_DROPPED)


def test_a_driver_gets_the_state(neutral_after):
    spec = neutral_after("lift", Fidelity.KINEMATIC, 1.6)
    plan = plan_of(spec)
    segments = {one.name: one for one in timed_task(spec, plan, timing_of(spec, plan)).segments}
    assert segments["neutral"].gripper is GripperState.NEUTRAL
    assert segments["neutral"].wait_s == pytest.approx(0.275)
    assert segments["move_to_place"].gripper is GripperState.NEUTRAL
    assert segments["place"].gripper is GripperState.OPEN


def test_a_task_file_sets_it_for_grippers_with_commands_alone(tmp_path):
    path = tmp_path / "task.yaml"
    path.write_text(
        "task: t\nsteps:\n  - move: {to: grasp}\n  - grip: {}\n  - neutral: {name: off}\n", encoding="utf-8"
    )
    loaded = load_task(path, label="task.yaml")
    assert loaded.program.steps[-1] == NeutralStep(name="off")
    files = {}
    for name in ("open-loop", "vacuum"):
        (tmp_path / f"{name}.yaml").write_text(FILES[name], encoding="utf-8")
        files[name] = load_gripper_file(tmp_path / f"{name}.yaml")
    assert list(neutral_findings(loaded, files)) == []
    (found,) = neutral_findings(loaded, {"vacuum": files["vacuum"]})
    assert str(found).startswith("task.yaml:5:14: error: 'off' sets a state of open-loop grippers")


def test_the_simulated_robot_drops_what_friction_does_not_hold(neutral_after):
    for share, falls in ((0.8, True), (1.6, False)):
        spec = neutral_after("lift", Fidelity.KINEMATIC, share)
        driver = SimulatedDriver(
            spec.scene, spec.gripper, spec.settings.physics, start_rad=spec.scene.robot.home_rad, grips=[spec.scene]
        )
        driver.connect()
        try:
            still = (0.0,) * 6
            for state in (GripperState.CLOSED, GripperState.NEUTRAL):
                driver.send(SetPoint(positions_rad=spec.scene.robot.home_rad, velocities_rad_s=still, gripper=state))
            driver.wait_until(0.2)
            assert (driver._held is None) is falls
            # The controller's model is that of what is in the hand: the arm stays where it is.
            assert driver.read().positions_rad == pytest.approx(spec.scene.robot.home_rad, abs=1e-3)
        finally:
            driver.disconnect()


def test_a_robot_with_one_output_refuses_the_task(neutral_after):
    with pytest.raises(DefinitionError, match="one output for the gripper"):
        _require_neutral("ur", neutral_after("lift", Fidelity.KINEMATIC, 1.0).task)
    _require_neutral("xarm", neutral_after("lift", Fidelity.KINEMATIC, 1.0).task)
