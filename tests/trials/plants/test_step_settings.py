"""Thresholds and control that steps of a task state: what they change, and what they leave as it is."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity
from rgss.tasks import CheckStep, Nearness, StepControl, default_task
from rgss.trials import JointController, JointGains, stated_in_step
from rgss.trials.pieces import Pieces
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.plants import ControlMode
from rgss.trials.plants.move_targets import MoveTargets
from rgss.trials.reference import Reference
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine
VERSIONS = {"rgss.plan": "1"}


@pytest.fixture(scope="module")
def pieces():
    return Pieces()


@pytest.fixture(scope="module")
def record_of(spec_of, pieces):
    """The record of the eight states at a fidelity, with other settings of some steps, and with further steps."""

    def record(fidelity, *further, **changes):
        return pieces.record(spec_with(spec_of, fidelity, *further, **changes))

    return record


def spec_with(spec_of, fidelity, *further, **changes):
    steps = tuple(replace(step, **changes.get(step.name, {})) for step in default_task().steps)
    return replace(spec_of(65), fidelity=fidelity, task=replace(default_task(), steps=(*steps, *further)))


def phase_of(record, name):
    return next(phase for phase in record.phases if phase.phase == name)


@pytest.mark.parametrize(("fidelity", "close"), [(Fidelity.KINEMATIC, 2e-5), (Fidelity.DYNAMIC, 1e-8)])
def test_the_scheduler_goes_on_when_the_joints_are_within_the_threshold(record_of, fidelity, close):
    times = []
    for within in (close, None, 2e-2):
        record = record_of(fidelity, move_to_grasp={"reached_rad": within})
        assert record.success
        times.append(phase_of(record, Phase.MOVE_TO_GRASP).duration_s)
    assert times[0] > times[1] >= times[2]
    # The default is the threshold of the study, 1 mrad.
    same = record_of(fidelity, move_to_grasp={"reached_rad": 1e-3})
    assert same.phases == record_of(fidelity).phases
    never = record_of(fidelity, lift={"reached_rad": 1e-17})
    if fidelity is Fidelity.DYNAMIC:
        assert (never.failure, never.failed_phase) == (Failure.TRACKING_ERROR, Phase.LIFT)
        assert re.search(r"_joint was \S+ rad from its target 0\.5 s after the move, at most", never.failure_detail)


def test_in_contact_the_end_is_awaited_where_a_step_says_so(record_of):
    plain, reached = record_of(Fidelity.CONTACT), record_of(Fidelity.CONTACT, lift={"reached_rad": 1e-3})
    assert plain.success
    assert reached.phases == plain.phases
    never = record_of(Fidelity.CONTACT, lift={"reached_rad": 1e-17})
    assert (never.failure, never.failed_phase) == (Failure.TRACKING_ERROR, Phase.LIFT)
    assert "from its target, at most 1e-17 are allowed" in never.failure_detail
    # The hand holds the object on, for as long as the study waits.
    waited_s = phase_of(never, Phase.LIFT).duration_s - phase_of(plain, Phase.LIFT).duration_s
    assert waited_s == pytest.approx(0.5)
    assert phase_of(never, Phase.LIFT).metrics["slip_m"] < 1e-3
    tool = [phase_of(one, Phase.LIFT).metrics["tracking_error_m"] for one in (never, plain)]
    assert tool[0] == pytest.approx(tool[1], abs=1e-4)


def test_the_targets_of_a_move_end_when_the_joints_are_there():
    steps, there = 4, np.array([0.4, -0.2])
    reference = Reference(
        positions_rad=np.linspace(np.zeros(2), there, steps + 1),
        velocities_rad_s=np.ones((steps, 2)),
        tool_m=np.zeros((steps + 1, 3)),
        load_m_s2=np.full(steps, 9.0),
        arc_m=np.ones((steps, 3)),
        peak_tool_speed_m_s=1.0,
        peak_tool_acceleration_m_s2=1.0,
    )

    def rows(errors, reached_rad):
        late = iter(errors)
        targets = MoveTargets(
            reference,
            reached_rad=reached_rad,
            positions_rad=lambda: [there[0], there[1] + next(late)],
            gravity_m_s2=9.81,
            longest_wait_steps=3,
        )
        return targets, list(targets)

    targets, found = rows((), None)
    assert len(found) == steps
    assert len(targets.tool_m) == steps + 1
    targets, found = rows((0.1, -0.05, 0.01), 0.02)
    assert found[steps:] == [([0.4, -0.2], [0.0, 0.0], [0.4, -0.2], 9.81, (0.0, 0.0, 0.0))] * 2
    assert targets.shortfall == ""
    assert len(targets.tool_m) == steps + 1 + 3
    targets, found = rows((0.1, 0.1, 0.1, -0.03), 0.02)
    assert len(found) == steps + 3
    assert targets.shortfall == "a joint is 0.03 from its target, at most 0.02 are allowed"
    assert rows((0.1, 0.1, 0.1, 0.01), 0.02)[0].shortfall == ""


def test_the_gripper_has_thresholds_of_its_own(record_of):
    plain = record_of(Fidelity.CONTACT)
    longer = record_of(Fidelity.CONTACT, grasp={"firm_s": 0.25})
    assert phase_of(longer, Phase.GRASP).duration_s - phase_of(plain, Phase.GRASP).duration_s == pytest.approx(
        0.2, abs=0.01
    )
    wide = record_of(Fidelity.CONTACT, place={"opened_m": 8e-3})
    assert wide.success
    assert phase_of(wide, Phase.PLACE).metrics["opening_s"] < phase_of(plain, Phase.PLACE).metrics["opening_s"]
    weak = record_of(Fidelity.CONTACT, grasp={"firm_above_n": 50.0})
    assert (weak.failure, weak.failed_phase) == (Failure.NO_FIRM_GRASP, Phase.GRASP)


def test_a_firm_grasp_takes_as_long_in_every_fidelity_as_the_step_says(record_of):
    for fidelity in (Fidelity.KINEMATIC, Fidelity.DYNAMIC):
        short, long = (record_of(fidelity, grasp={"firm_s": time_s}) for time_s in (0.05, 0.45))
        added = phase_of(long, Phase.GRASP).duration_s - phase_of(short, Phase.GRASP).duration_s
        assert added == pytest.approx(0.4, abs=0.01)


def test_a_controller_of_one_step_acts_in_that_step_alone(record_of):
    plain = record_of(Fidelity.DYNAMIC)
    soft = StepControl(mode="position", natural_frequency_rad_s=60.0)
    record = record_of(Fidelity.DYNAMIC, move_to_grasp_departure={"control": soft})
    at = [phase.phase for phase in plain.phases].index(Phase.MOVE_TO_GRASP_DEPARTURE)
    assert record.phases[:at] == plain.phases[:at]
    error_m, was_m = (one.phases[at].metrics["tracking_error_m"] for one in (record, plain))
    assert error_m > 10 * was_m
    assert record.success
    # The next steps are again under the study's control; the first begins where the soft one ended.
    assert record.phases[at + 2].metrics["tracking_error_m"] < 10 * plain.phases[at + 2].metrics["tracking_error_m"]


def test_what_a_step_does_not_state_is_that_of_the_study():
    study = JointController(joints=(JointGains(joint="a", damping_ratio=0.7, natural_frequency_rad_s=50.0),))
    own = stated_in_step(study, StepControl(mode="velocity", natural_frequency_rad_s=30.0))
    assert own.mode is ControlMode.VELOCITY
    assert own.natural_frequency_rad_s == 30.0
    assert own.velocity_gain_1_s == study.velocity_gain_1_s
    assert own.joints == (JointGains(joint="a", damping_ratio=0.7),)


@pytest.mark.parametrize(
    ("near", "problem"),
    [
        (Nearness(within_m=0.02, point_m=None, place="", object="cup"), ""),
        (Nearness(within_m=0.03, point_m=(0.0, 0.0, 0.0)), "mm from the point, at most 30 mm are allowed"),
    ],
    ids=["itself", "far from a point"],
)
def test_an_object_is_checked_by_its_distance(record_of, spec_of, near, problem):
    name = spec_of(65).scene.workpiece.id
    near = replace(near, object=name) if near.object else near
    record = record_of(Fidelity.CONTACT, CheckStep(name="check", near=near))
    assert record.success == (not problem)
    assert problem in record.failure_detail
    assert problem == "" or record.failure is Failure.CHECK_FAILED


def test_thresholds_and_control_are_inputs_of_the_execution_alone(spec_of):
    def digests(fidelity=Fidelity.DYNAMIC, **changes):
        return digests_of(spec_with(spec_of, fidelity, **changes), VERSIONS)

    plain = digests()
    for changes in (
        {"lift": {"reached_rad": 1e-4}},
        {"lift": {"control": StepControl(mode="position")}},
        {"grasp": {"firm_s": 0.1}},
        {"grasp": {"firm_above_n": 1.0}},
        {"place": {"opened_m": 1e-3}},
    ):
        changed = digests(**changes)
        assert (changed.plan, changed.timing) == (plain.plan, plain.timing)
        assert changed.execution != plain.execution
    assert digests(lift={"resolution_rad": 0.02}).plan != plain.plan
