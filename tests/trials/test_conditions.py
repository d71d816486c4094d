"""Conditions of a trial: what is true, what is perceived, and which piece of the trial knows of it."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import pytest

from rgss.evidence import Fidelity
from rgss.scenes import JointKind
from rgss.scenes.uncertainty import (
    QUANTITIES,
    Case,
    Constant,
    EntersAt,
    Normal,
    Uncertainty,
    UncertainValue,
    Workload,
    draws_of,
)
from rgss.trials.code.piece_versions import versions
from rgss.trials.conditions import Conditions, conditions_of, drawn_values, nominal_conditions
from rgss.trials.payload_bench.of_trial import bench_of
from rgss.trials.pieces.input_digests import digests_of

PIECES = ("plan", "timing", "execution")


def constant(name, value):
    return Uncertainty(values=(UncertainValue(quantity=name, distribution=Constant(value=value)),))


def with_constant(spec, name, value):
    return replace(spec, uncertainty=constant(name, value))


def test_without_uncertainty_all_is_as_the_files_say(spec_of):
    spec = spec_of(65)
    conditions = conditions_of(spec)

    assert conditions.true_scene == spec.scene
    assert conditions.perceived_scene == spec.scene
    assert conditions.true_gripper == spec.gripper
    assert (conditions.case, dict(conditions.draws), conditions.is_grip_known(spec.scene.workpiece.id)) == (
        "",
        {},
        True,
    )


@pytest.mark.parametrize("name", QUANTITIES)
def test_a_draw_changes_the_pieces_from_the_first_that_it_enters(spec_of, name):
    spec = spec_of(65)
    quantity = QUANTITIES[name]
    before = digests_of(spec, versions()).as_mapping()
    after = digests_of(with_constant(spec, name, 0.0123), versions()).as_mapping()

    first = PIECES.index(quantity.enters.value)
    assert [before[piece] != after[piece] for piece in PIECES] == [index >= first for index in range(3)]
    assert before["bench"] == after["bench"]
    assert before["trial"] != after["trial"]


def test_every_quantity_has_a_field_and_every_field_a_quantity():
    fixed = {"scene", "design_gripper", "case", "draws", "others"}
    changed = {each.name for each in fields(Conditions)} - fixed
    assert {quantity.field for quantity in QUANTITIES.values()} == changed


def test_a_draw_that_changes_nothing_is_recorded_all_the_same(spec_of):
    spec = spec_of(65)
    known = with_constant(spec, "perception.x", 0.0)

    before, after = (digests_of(each, versions()) for each in (spec, known))
    assert (before.plan, before.execution) == (after.plan, after.execution)
    assert before.trial != after.trial


def test_all_designs_have_the_same_draws(spec_of):
    uncertainty = Uncertainty(
        values=tuple(
            UncertainValue(quantity=name, distribution=Normal(mean=0.0, sd=0.001))
            for name in ("perception.x", "robot.joint_offset")
        )
    )
    two, three = (replace(spec_of(variant, 5), uncertainty=uncertainty) for variant in (30, 12))

    assert two.gripper.geometry.fingers != three.gripper.geometry.fingers
    assert conditions_of(two).draws == conditions_of(three).draws == draws_of(uncertainty, 5, joints=6)
    assert conditions_of(two).draws != conditions_of(replace(two, seed=6)).draws


def test_the_robot_perceives_the_object_elsewhere_than_it_stands(spec_of):
    spec = spec_of(65)
    x, y, z = spec.scene.workpiece.pose.position_m
    stands = replace(
        spec,
        uncertainty=Uncertainty(
            values=(*constant("workpiece.x", 0.02).values, *constant("perception.x", -0.005).values)
        ),
    )
    conditions = conditions_of(stands)

    assert conditions.true_scene.workpiece.pose.position_m == (x + 0.02, y, z)
    assert conditions.perceived_scene.workpiece.pose.position_m == pytest.approx((x + 0.015, y, z), abs=1e-15)
    assert conditions.perceived_scene.grasp.position_m == pytest.approx((x + 0.015, y, z), abs=1e-15)
    assert conditions.perceived_scene.place == spec.scene.place


def test_a_perceived_tilt_tilts_the_grasp_and_is_taken_off_at_the_place(spec_of):
    spec = with_constant(spec_of(65), "perception.roll", math.radians(3))
    seen = conditions_of(spec).perceived_scene

    assert math.pi - seen.grasp.tilt_rad == pytest.approx(math.radians(3))
    held = seen.grasp.inverse() @ seen.workpiece.pose
    assert (seen.place_pose @ held).tilt_rad == pytest.approx(0.0, abs=1e-7)
    truly_held = seen.grasp.inverse() @ conditions_of(spec).true_scene.workpiece.pose
    assert (seen.place_pose @ truly_held).tilt_rad == pytest.approx(math.radians(3))


def test_a_perceived_turn_turns_the_hand(spec_of):
    spec = spec_of(65)
    turned = conditions_of(with_constant(spec, "perception.yaw", math.radians(20))).perceived_scene

    across = spec.scene.grasp.rotate((1.0, 0.0, 0.0))
    angle = math.acos(sum(a * b for a, b in zip(across, turned.grasp.rotate((1.0, 0.0, 0.0)), strict=True)))
    assert angle == pytest.approx(math.radians(20))
    assert turned.grasp.tilt_rad == pytest.approx(math.pi)


def test_a_case_of_the_workload_is_known_to_the_robot(spec_of):
    light, tall = Case(id="light", mass_kg=0.1), Case(id="tall", height_m=0.12, radius_m=0.03, friction=0.8)
    spec = replace(spec_of(65, 1), workload=Workload(cases=(light, tall)))
    conditions = conditions_of(spec)
    workpiece, own = conditions.perceived_scene.workpiece, spec.scene.workpiece

    assert conditions.case == "tall"
    assert conditions.true_scene == conditions.perceived_scene
    assert (workpiece.shape.height_m, workpiece.shape.radius_m, workpiece.friction) == (0.12, 0.03, 0.8)
    assert workpiece.mass_kg == own.mass_kg
    stands_on = own.pose.position_m[2] - own.shape.half_height_m
    assert workpiece.pose.position_m[2] - 0.06 == pytest.approx(stands_on)
    assert conditions_of(replace(spec, seed=2)).scene.workpiece.mass_kg == 0.1
    # The bench tries the gripper with the scene's object, whatever is carried.
    assert bench_of(spec) == bench_of(spec_of(65))


def test_the_robot_does_not_know_what_was_drawn_of_the_grip(spec_of):
    spec = with_constant(spec_of(65), "workpiece.mass_factor", 2.0)
    conditions = conditions_of(spec)

    assert conditions.true_scene.workpiece.mass_kg == 2 * spec.scene.workpiece.mass_kg
    assert conditions.perceived_scene.workpiece.mass_kg == spec.scene.workpiece.mass_kg
    assert not conditions.is_grip_known(spec.scene.workpiece.id)


def test_what_was_drawn_is_told_beside_what_is_nominal(spec_of):
    spec = replace(
        spec_of(65),
        uncertainty=Uncertainty(
            values=(
                *constant("gripper.finger.force", 0.9).values,
                *constant("robot.joint_offset", 0.001).values,
                *constant("workpiece.mass", 0.5).values,
                *constant("workpiece.mass_factor", 1.2).values,
            )
        ),
    )
    told = {one.name: (one.unit, one.nominal, one.drawn) for one in drawn_values(spec)}

    assert told["gripper.finger.force"] == ("N", 10.0, 9.0)
    assert told["robot.joint_offset.3"] == ("rad", 0.0, 0.001)
    # Both act on one mass, the factor on what was drawn.
    assert told["workpiece.mass_factor"] == ("kg", 0.25, pytest.approx(0.6))
    assert len(told) == 9


def test_an_angle_is_no_offset_of_a_sliding_joint(spec_of):
    """Of an arm on a rail, 0.5 deg were 8.7 mm along the rail."""
    spec = with_constant(spec_of(65), "robot.joint_offset", 0.009)
    joints = spec.scene.robot.joints
    rail = replace(joints[0], kind=JointKind.PRISMATIC)
    on_rail = replace(spec, scene=replace(spec.scene, robot=replace(spec.scene.robot, joints=(rail, *joints[1:]))))
    assert conditions_of(spec).joint_offsets_rad == (0.009,) * 6
    assert conditions_of(on_rail).joint_offsets_rad == (0.0, *(0.009,) * 5)
    assert "robot.joint_offset.1" not in conditions_of(on_rail).draws
    assert conditions_of(on_rail).draws["robot.joint_offset.2"] == 0.009
    assert [one.name for one in drawn_values(on_rail)] == [f"robot.joint_offset.{at}" for at in range(2, 7)]


@pytest.mark.parametrize("names", [("robot.joint_offset", "robot.slide_offset"), ("robot.slide_offset",)])
def test_a_sliding_joint_has_an_offset_in_metres_of_its_own(spec_of, names):
    spec = spec_of(65)
    values = {"robot.joint_offset": 0.009, "robot.slide_offset": 0.0005}
    stated = Uncertainty(values=tuple(one for name in names for one in constant(name, values[name]).values))
    joints = spec.scene.robot.joints
    rail = replace(joints[0], kind=JointKind.PRISMATIC)
    robot = replace(spec.scene.robot, joints=(rail, *joints[1:]))
    on_rail = replace(spec, scene=replace(spec.scene, robot=robot), uncertainty=stated)

    turning = (0.009 if "robot.joint_offset" in names else 0.0,) * 5
    assert conditions_of(on_rail).joint_offsets_rad == (0.0005, *turning)
    slide = drawn_values(on_rail)[-1]
    assert (slide.name, slide.unit, slide.nominal, slide.drawn) == ("robot.slide_offset.1", "m", 0.0, 0.0005)
    assert conditions_of(replace(spec, uncertainty=stated)).joint_offsets_rad == (turning[0],) * 6


def test_the_tool_speed_is_of_the_timing(spec_of):
    spec = spec_of(65)

    assert QUANTITIES["robot.tool_speed"].enters is EntersAt.TIMING
    assert conditions_of(with_constant(spec, "robot.tool_speed", 0.5)).tool_speed_m_s == 0.5 * spec.tool_speed_m_s
    assert nominal_conditions(with_constant(spec, "robot.tool_speed", 0.5)).tool_speed_m_s == spec.tool_speed_m_s


def test_conditions_are_the_same_at_every_fidelity(spec_of):
    spec = with_constant(spec_of(65), "workpiece.mass", 0.5)

    assert conditions_of(spec) == conditions_of(replace(spec, fidelity=Fidelity.KINEMATIC))
