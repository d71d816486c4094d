"""A body whose centre of mass is not the centre of its shape, and an arm whose encoders are off."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.physics import PhysicsSettings, World
from rgss.scenes import Pose

pytestmark = pytest.mark.engine

HIGH = Pose(position_m=(-1.6, 1.6, 2.0))


def test_the_pose_of_a_workpiece_is_that_of_its_shape(three_fingers):
    with three_fingers.world(**three_fingers.with_workpiece(pose=HIGH, centre_of_mass_m=0.02)) as world:
        assert world.workpiece_pose().position_m == pytest.approx(HIGH.position_m, abs=1e-12)
        assert world.hand_view().workpiece_m == pytest.approx(HIGH.position_m, abs=1e-12)


@pytest.mark.parametrize(("height_m", "falls"), [(-0.03, False), (0.03, True)])
def test_an_object_topples_when_its_centre_of_mass_is_beyond_its_edge(three_fingers, height_m, falls):
    """A cylinder on its edge falls over when tan(lean) > radius / height of the centre of mass above its foot."""
    workpiece = three_fingers.scene.workpiece
    radius, half = workpiece.shape.radius_m, workpiece.shape.half_height_m
    limit_rad = math.atan(radius / (half + height_m))
    lean_rad = math.atan(radius / half)
    assert (lean_rad > limit_rad) is falls
    x, y, z = workpiece.pose.position_m
    foot = z - half
    # On its edge, its shape's centre above the foot by the leaning diagonal.
    height = half * math.cos(lean_rad) + radius * math.sin(lean_rad)
    leaning = Pose.from_roll_pitch_yaw((x, y, foot + height), (0.0, lean_rad, 0.0))
    changes = three_fingers.with_workpiece(pose=leaning, centre_of_mass_m=height_m)
    with three_fingers.world(**changes) as world:
        world.reset_arm([angle + 0.5 for angle in three_fingers.scene.robot.home_rad])
        for _ in range(480):
            world.step()
        assert (world.workpiece_pose().tilt_rad > math.radians(45)) is falls


def test_an_arm_goes_where_its_encoders_say_the_target_is(three_fingers):
    cell = three_fingers
    offsets = (0.001, -0.002, 0.0015, 0.0, 0.003, -0.001)
    # Without the object, which the shifted hand would touch.
    scene = replace(cell.scene, workpiece=replace(cell.scene.workpiece, pose=HIGH))
    with World(scene, cell.gripper, PhysicsSettings(), joint_offsets_rad=offsets) as world:
        world.reset_arm(cell.grasp_rad.tolist())
        cell.hold(world, 60)
        reported, _, _ = world.arm_state()
        found = world.tool_pose().position_m

    assert reported == pytest.approx(cell.grasp_rad.tolist(), abs=2e-4)
    true = cell.grasp_rad + offsets
    assert found == pytest.approx(cell.arm.tool_position(true[None])[0].tolist(), abs=4e-4)
    assert math.dist(found, cell.arm.tool_position(cell.grasp_rad[None])[0]) > 1e-3
