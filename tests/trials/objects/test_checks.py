"""Steps that check what must hold of an object."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest

from rgss.evidence import Failure, PhaseOutcome
from rgss.scenes import NamedPlace, Pose
from rgss.tasks import CheckStep, Nearness
from rgss.trials.monitors import violated_condition
from rgss.trials.plants import ControlSettings
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import gripper_of


def with_checks(spec, **checks):
    steps = tuple(CheckStep(name=name, **conditions) for name, conditions in checks.items())
    return replace(spec, task=replace(spec.task, steps=(*spec.task.steps, *steps)))


@pytest.mark.engine
def test_a_check_ends_the_task_unless_its_conditions_hold(spec_of):
    record = record_without_bench(
        with_checks(
            spec_of(),
            placed={"is_upright": True, "is_at_rest": True, "held": False},
            held={"held": True},
            beyond={"is_upright": True},
        )
    )

    assert (record.failure, record.failed_phase) == (Failure.CHECK_FAILED, "held")
    assert record.failure_detail == "0 of 2 fingers touch cup"
    assert [phase.outcome for phase in record.phases[-3:]] == [
        PhaseOutcome.COMPLETED,
        PhaseOutcome.FAILED,
        PhaseOutcome.NOT_RUN,
    ]


@pytest.mark.engine
def test_a_check_before_the_first_move_is_made_at_the_start(spec_of):
    spec = spec_of()
    near = Nearness(within_m=0.01, point_m=(0.0, 0.0, 0.0))
    before = (CheckStep(name="free", is_at_rest=True, held=False), CheckStep(name="there", near=near))

    record = record_without_bench(replace(spec, task=replace(spec.task, steps=(*before, *spec.task.steps))))

    assert (record.failure, record.failed_phase) == (Failure.CHECK_FAILED, "there")
    assert [phase.outcome for phase in record.phases] == [
        PhaseOutcome.COMPLETED,
        PhaseOutcome.FAILED,
        *[PhaseOutcome.NOT_RUN] * len(spec.task.steps),
    ]


class Placed:
    """A world with one object at a place, which some fingers touch."""

    def __init__(self, spec, *, aside_m=0.0, above_m=0.0, tilt_rad=0.0, touching=0):
        region = spec.scene.place
        named = NamedPlace(id="counter_end", region=region, support=spec.scene.place_support)
        self.scene, self.gripper = replace(spec.scene, places=(named,)), spec.gripper
        x, y, z = region.centre_m
        above = z + spec.scene.workpiece.shape.half_height_m + above_m
        self.pose = Pose.from_roll_pitch_yaw((x + aside_m, y, above), (tilt_rad, 0.0, 0.0))
        self._touching = touching

    def object_pose(self, _):
        return self.pose

    def contacts(self):
        return SimpleNamespace(fingers_touching=self._touching)


CASES = {
    "beside its place": ({"at": "counter_end"}, {"aside_m": 0.0501}, "cup is 50.1 mm from counter_end, at most "),
    "above its place": (
        {"at": "counter_end"},
        {"above_m": 0.0501},
        "cup is 0.0 mm from counter_end and 50.1 mm off its height there, at most 40 mm are allowed",
    ),
    "leaning": ({"is_upright": True}, {"tilt_rad": 0.5}, "cup is tilted by 28.6 deg"),
    "moving": ({"is_at_rest": True}, {}, "cup has moved by 30.00 mm in "),
    "not held": ({"held": True}, {"touching": 1}, "1 of 2 fingers touch cup"),
    "still held": ({"held": False}, {"touching": 2}, "2 of 2 fingers touch cup"),
}


@pytest.mark.parametrize("name", CASES)
def test_what_does_not_hold_is_told_with_its_numbers(spec_of, name):
    conditions, state, told = CASES[name]
    world = Placed(spec_of(), **state)
    x, y, z = world.pose.position_m
    before = Pose(position_m=(x - 0.03, y, z), quaternion_xyzw=world.pose.quaternion_xyzw)
    said = violated_condition(world, ControlSettings(), CheckStep(name="checked", **conditions), before)

    assert said.startswith(told)


@pytest.mark.parametrize(
    ("held", "touching", "told"),
    [(True, 1, ""), (False, 0, ""), (True, 0, "the cup does not touch cup"), (False, 1, "the cup touches cup")],
)
def test_a_suction_cup_holds_by_its_one_contact(spec_of, tmp_path, held, touching, told):
    spec = spec_of()
    world = Placed(replace(spec, gripper=gripper_of(tmp_path, "vacuum", spec.scene.workpiece.shape)), touching=touching)
    step = CheckStep(name="checked", held=held)

    assert violated_condition(world, ControlSettings(), step, world.pose) == told


def test_what_holds_is_no_problem(spec_of):
    step = CheckStep(name="checked", at="counter_end", is_upright=True, is_at_rest=True, held=True)
    world = Placed(spec_of(), aside_m=0.001, touching=2)

    assert violated_condition(world, ControlSettings(), step, world.pose) == ""
