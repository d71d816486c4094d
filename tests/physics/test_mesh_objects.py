"""An object of several convex parts is in the engine as large as in its file, and one rigid body."""

from __future__ import annotations

import itertools
import math

import pytest

from rgss.physics import World
from rgss.scenes import Box, MeshShape, Pose, SceneBody

pytestmark = pytest.mark.engine

SIZE_M = (0.06, 0.064, 0.04)
FRICTION = 0.5
SLOPE_FRICTION = 0.7


def block(low, high):
    return tuple(itertools.product(*zip(low, high, strict=True)))


WHOLE = (block((-0.03, -0.032, -0.02), (0.03, 0.032, 0.02)),)
LAYERS = (block((-0.03, -0.032, 0.0), (0.03, 0.032, 0.02)), block((-0.03, -0.032, -0.02), (0.03, 0.032, 0.0)))
BRACKET = (block((-0.03, -0.032, -0.02), (0.03, -0.008, 0.02)), block((-0.03, -0.008, -0.02), (-0.006, 0.032, 0.02)))


def gyration_m2():
    """That of a solid box of the size, by its textbook formula."""
    x, y, z = SIZE_M
    return ((y**2 + z**2) / 12, (x**2 + z**2) / 12, (x**2 + y**2) / 12, 0.0, 0.0, 0.0)


@pytest.fixture
def world_with(three_fingers):
    def world(parts, pose, *, centre=(0.0, 0.0, 0.0), gyration=None, **others) -> World:
        changes = three_fingers.with_workpiece(
            shape=MeshShape(parts_m=parts, sha256="parts"),
            pose=pose,
            friction=FRICTION,
            gyration_m2=gyration or gyration_m2(),
            centre_of_mass_across_m=centre[:2],
            centre_of_mass_m=centre[2],
        )
        return three_fingers.world(**changes, **others)

    return world


@pytest.mark.parametrize(
    ("parts", "centre", "products"),
    [
        (WHOLE, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (WHOLE, (0.004, -0.006, -0.005), (0.0, 0.0, 0.0)),
        (WHOLE, (0.0, 0.0, 0.0), (5e-5, -2e-5, 4e-5)),
        (LAYERS, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (BRACKET, (-0.008, -0.01, 0.0), (0.0, 0.0, 0.0)),
        (BRACKET, (-0.008, -0.01, 0.003), (3e-5, 0.0, 0.0)),
    ],
)
def test_a_mesh_stands_with_its_foot_on_the_table(three_fingers, world_with, parts, centre, products):
    """The engine enlarges a shape that is displaced in its body, or one of several, by 1 mm."""
    cup = three_fingers.scene.workpiece
    x, y, z = cup.pose.position_m
    table_m = z - cup.shape.half_height_m
    gyration = (*gyration_m2()[:3], *products)
    with world_with(parts, Pose(position_m=(x, y, table_m + 0.021)), centre=centre, gyration=gyration) as world:
        world.reset_arm([angle + 0.5 for angle in three_fingers.scene.robot.home_rad])
        for _ in range(480):
            world.step()
        pose = world.workpiece_pose()
        assert world.contacts().workpiece_bodies == (three_fingers.scene.support,)
    assert pose.position_m[2] == pytest.approx(table_m + 0.02, abs=3e-5)
    assert pose.tilt_rad < 1e-3


@pytest.mark.parametrize("lean", [-0.03, 0.05])
def test_a_part_that_stands_alone_has_the_friction_of_the_object(world_with, lean):
    """The lower layer is the second part: it rests below the angle of friction, and slides by Coulomb's law above."""
    angle_rad = math.atan(SLOPE_FRICTION * FRICTION) + lean
    tilt = Pose.from_roll_pitch_yaw((5.0, 0.0, 1.0), (0.0, angle_rad, 0.0))
    board = SceneBody(
        id="slope", shape=Box(size_m=(2, 2, 0.1)), pose=tilt, friction=SLOPE_FRICTION, colour=(0.0, 0.0, 0.0, 1.0)
    )
    start = board.pose @ Pose(position_m=(0.0, 0.0, 0.07))
    # A hull touches with one point more in each step, so that the first steps count less at a higher rate.
    others = {"bodies": (board,), "support": "slope", "place_support": "slope", "rate_hz": 960.0}
    with world_with(LAYERS, start, **others) as world:
        for _ in range(480):
            world.step()
        along_m = (board.pose.inverse() @ world.workpiece_pose()).position_m[0]
    pull = math.sin(angle_rad) - SLOPE_FRICTION * FRICTION * math.cos(angle_rad)
    expected_m = 9.81 * max(0.0, pull) * 0.5 * (0.5 + 1 / 960) / 2
    assert along_m == pytest.approx(expected_m, rel=0.03, abs=2e-4)


@pytest.mark.parametrize("parts", [LAYERS, WHOLE])
def test_a_tossed_mesh_flies_and_turns_as_a_box_of_its_size(three_fingers, world_with, parts):
    high = Pose.from_roll_pitch_yaw((-1.6, 1.6, 3.0), (0.3, 0.2, 0.1))
    box = three_fingers.with_workpiece(shape=Box(size_m=SIZE_M), pose=high, friction=FRICTION)
    found = []
    for made in (world_with(parts, high), three_fingers.world(**box)):
        with made as world:
            body, client = world._workpiece, world._client
            world._engine.resetBaseVelocity(body, (0.4, -0.2, 1.0), (3.0, -5.0, 2.0), physicsClientId=client)
            for _ in range(120):
                world.step()
            found.append(world.workpiece_pose())
    one, other = found
    assert one.position_m == pytest.approx(other.position_m, abs=1e-9)
    assert one.quaternion_xyzw == pytest.approx(other.quaternion_xyzw, abs=1e-9)
