"""Who touches whom, by name, and what it costs to ask."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pybullet
import pytest

from rgss.physics import Contacts, PhysicsSettings, RobotContact, World
from rgss.physics.contact_reader import ContactReader
from rgss.physics.world_builder import WorldBuilder
from rgss.scenes import Pose
from rgss.scenes.assembly import assembled_urdf

from .speeds import workpiece_speed

# What the engine tells of a point before its friction.
NOT_ASKED = (None,) * 10
ELSEWHERE = Pose(position_m=(-1.8, 1.8, 0.05))


def test_sums_and_counts_follow_from_the_forces():
    contacts = Contacts(
        finger_forces_n=(1.5, 0.0, 2.5),
        other_force_n=0.0,
        pressed=(
            (-1.0, (*NOT_ASKED, 2.0, (0.0, 0.0, -1.0), 3.0, (0.0, 1.0, 0.0))),
            (1.0, (*NOT_ASKED, 1.0, (0.0, 0.0, -1.0), 4.0, (1.0, 0.0, 0.0))),
        ),
        robot_bodies=(),
        workpiece_bodies=(),
        pressing_links=(),
    )
    assert contacts.finger_force_sum_n == 4.0
    assert contacts.friction_n == (4.0, -3.0, 1.0)
    assert contacts.is_robot_touching
    assert contacts.fingers_touching == 2


@pytest.mark.engine
def test_the_cup_on_its_support_is_reported(cell):
    with cell.world() as world:
        world.reset_arm(cell.scene.robot.home_rad)
        for _ in range(10):
            world.step()
        contacts = world.contacts()
    assert contacts.workpiece_bodies == (cell.scene.support,)
    assert contacts.robot_bodies == ()
    assert contacts.finger_forces_n == (0.0,) * cell.gripper.geometry.fingers
    assert contacts.other_force_n == 0.0
    assert contacts.friction_n == (0.0, 0.0, 0.0)


@pytest.mark.engine
def test_the_pedestal_that_bears_the_arm_is_not_reported(cell):
    base = cell.scene.robot.base
    (pedestal,) = (body for body in cell.scene.bodies if body.id == "pedestal")
    assert pedestal.pose.position_m[2] + pedestal.shape.half_height_m == pytest.approx(base.position_m[2])
    # Not even where the base is let into the pedestal.
    for depth_m in (0.0, 0.005):
        robot = replace(cell.scene.robot, base=base.raised(-depth_m))
        with cell.world(robot=robot) as world:
            for configuration in (cell.scene.robot.home_rad, tuple(cell.grasp_rad.tolist())):
                world.reset_arm(configuration)
                world.step()
                assert world.contacts().robot_bodies == ()


@pytest.mark.engine
def test_a_link_that_is_fixed_to_the_base_may_touch_the_pedestal_too(cell):
    root = ET.fromstring(cell.scene.robot.urdf)  # noqa: S314 - our own
    carried = {joint.find("child").get("link") for joint in root.findall("joint")}
    (base,) = (link.get("name") for link in root.findall("link") if link.get("name") not in carried)
    ET.SubElement(root, "link", {"name": "world"})
    mount = ET.SubElement(root, "joint", {"name": "mount", "type": "fixed"})
    ET.SubElement(mount, "parent", {"link": "world"})
    ET.SubElement(mount, "child", {"link": base})
    robot = replace(cell.scene.robot, urdf=ET.tostring(root, encoding="unicode"))
    for depth_m, touching in ((0.005, set()), (0.1, {("shoulder_link", "pedestal"), ("upper_arm_link", "pedestal")})):
        with cell.world(robot=replace(robot, base=robot.base.raised(-depth_m))) as world:
            world.reset_arm(robot.home_rad)
            world.step()
            assert {*world.contacts().robot_bodies} == touching


@pytest.mark.engine
def test_a_link_in_the_pedestal_is_reported(three_fingers):
    robot = three_fingers.scene.robot
    sunk = replace(robot, base=robot.base.raised(-0.1))
    with three_fingers.world(robot=sunk) as world:
        world.reset_arm(robot.home_rad)
        world.step()
        assert ("shoulder_link", "pedestal") in world.contacts().robot_bodies


@pytest.mark.engine
def test_fingers_pressed_into_the_counter_are_reported_by_name(cell):
    # The fingertips reach 30 mm below the grasp centre, which is 50 mm above the counter.
    above, into = (cell.near(cell.scene.grasp.raised(height)) for height in (0.0, -0.03))
    with cell.world(**cell.with_workpiece(pose=ELSEWHERE)) as world:
        world.reset_arm(above.tolist())
        cell.hold(world, 10, above)
        assert world.contacts().robot_bodies == ()
        cell.follow(world, cell.path(above, into, 0.5))
        contacts = world.contacts()
    fingers = {f"finger_{finger + 1}" for finger in range(cell.gripper.geometry.fingers)}
    assert set(contacts.robot_bodies) == {(finger, cell.scene.support) for finger in fingers}
    assert {(one.link, one.body) for one in contacts.robot_contacts} == {*contacts.robot_bodies}
    assert all(one.force_n[2] > 0.9 * math.hypot(*one.force_n) > 0.0 for one in contacts.robot_contacts)
    assert contacts.finger_forces_n == (0.0,) * cell.gripper.geometry.fingers


@pytest.fixture
def flat_pads(monkeypatch):
    """Fingers of one solid each, of which the engine tells more and in another order than of those with ribs."""
    monkeypatch.setattr(
        "rgss.physics.world_builder.assembled_urdf", lambda robot, gripper, **_: assembled_urdf(robot, gripper)
    )


@pytest.mark.engine
@pytest.mark.usefixtures("flat_pads")
def test_what_has_parted_is_not_reported(cell):
    """The engine lists a pair for a while after it parted, with a distance and no force."""
    touching, parted = (cell.near(cell.scene.grasp.raised(height)) for height in (-0.02001, -0.0197))
    with cell.world(**cell.with_workpiece(pose=ELSEWHERE)) as world:
        world.reset_arm(touching.tolist())
        cell.hold(world, 2, touching)
        assert len(world.contacts().robot_bodies) == cell.gripper.geometry.fingers
        cell.follow(world, cell.path(touching, parted, 0.05))
        points = world._engine.getContactPoints(world._robot, physicsClientId=world._client)
        assert min(point[8] for point in points) == pytest.approx(0.0003, abs=1e-4)
        assert world.contacts().robot_bodies == ()


@pytest.mark.engine
def test_a_pair_is_reported_once(three_fingers):
    """A finger's face meets the counter in up to four points."""
    cell = three_fingers
    into = cell.near(cell.scene.grasp.raised(-0.022))
    with cell.world(**cell.with_workpiece(pose=ELSEWHERE)) as world:
        world.reset_arm(into.tolist())
        world.step()
        contacts = world.contacts()
    assert len(contacts.robot_bodies) == len(set(contacts.robot_bodies)) == 3
    assert len(contacts.workpiece_bodies) == len(set(contacts.workpiece_bodies))


@pytest.mark.engine
def test_the_grippers_base_on_the_cup_is_another_force(cell):
    # The base ends 60 mm above the grasp centre, the cup 50 mm above its own.
    above, onto = (cell.near(cell.scene.grasp.raised(height)) for height in (0.0, -0.0105))
    with cell.world() as world:
        world.reset_arm(above.tolist())
        cell.follow(world, cell.path(above, onto, 0.5))
        contacts = world.contacts()
    assert contacts.other_force_n > 1.0
    assert contacts.pressing_links == ("gripper_base",)
    assert contacts.fingers_touching == 0
    assert contacts.robot_bodies == ()
    assert {(one.link, one.body) for one in contacts.robot_contacts} == {("gripper_base", None)}
    assert math.fsum(one.force_n[2] for one in contacts.robot_contacts) == pytest.approx(
        contacts.other_force_n, rel=1e-3
    )


@pytest.mark.engine
def test_a_cup_in_the_air_touches_nothing(three_fingers):
    with three_fingers.world(**three_fingers.with_workpiece(pose=ELSEWHERE.raised(0.5))) as world:
        world.reset_arm(three_fingers.scene.robot.home_rad)
        world.step()
        contacts = world.contacts()
    assert contacts.workpiece_bodies == ()
    assert contacts.robot_bodies == ()


def make_the_robot_first(monkeypatch):
    """Make the robot before the workpiece, so that contacts name them in the other order."""
    add_robot, add_objects, robots = WorldBuilder.add_robot, WorldBuilder.add_objects, []

    def both(builder: WorldBuilder) -> object:
        robots.append(add_robot(builder))
        return add_objects(builder)

    monkeypatch.setattr(WorldBuilder, "add_objects", both)
    monkeypatch.setattr(WorldBuilder, "add_robot", lambda _: robots.pop())


@pytest.mark.engine
@pytest.mark.usefixtures("flat_pads")
def test_friction_acts_on_the_cup_whichever_body_the_engine_names_first(cell, monkeypatch):
    weight = cell.scene.workpiece.mass_kg * cell.scene.gravity_m_s2
    named_first = set()
    for prepare in (lambda _: None, make_the_robot_first):
        prepare(monkeypatch)
        with World(cell.scene, cell.gripper, PhysicsSettings()) as world:
            cell.lift(world)
            point = world._engine.getContactPoints(physicsClientId=world._client)[0]
            named_first.add("robot" if point[1] == world._robot else "workpiece")
            assert world.contacts().friction_n[2] == pytest.approx(weight, rel=0.01)
    assert named_first == {"robot", "workpiece"}


@pytest.mark.engine
def test_asking_at_every_step_asks_the_engine_once(cell, monkeypatch):
    """The engine copies every contact for each question, which is what asking costs."""
    question, asked = pybullet.getContactPoints, []
    monkeypatch.setattr(pybullet, "getContactPoints", lambda *given: asked.append(given) or question(*given))
    with cell.world() as world:
        cell.lift(world)
        asked.clear()
        for _ in range(10):
            world.step()
            world.contacts()
    assert len(asked) == 10


@pytest.mark.engine
def test_the_points_of_the_fingers_add_up_to_their_forces(cell):
    with cell.world() as world:
        cell.lift(world)
        points, contacts = world.finger_contacts(), world.contacts()
        turn = Pose(quaternion_xyzw=world.workpiece_pose().quaternion_xyzw)
    fingers = range(cell.gripper.geometry.fingers)
    by_finger = [math.fsum(point.normal_force_n for point in points if point.finger == finger) for finger in fingers]
    friction = [math.fsum(axis) for axis in zip(*(turn.rotate(point.friction_n) for point in points), strict=True)]

    assert by_finger == pytest.approx(contacts.finger_forces_n)
    assert friction == pytest.approx(contacts.friction_n, abs=1e-6)


@pytest.mark.engine
def test_the_points_of_the_fingers_are_on_the_wall_of_the_cup_also_while_it_moves(cell):
    """The engine finds contacts where the bodies were before the step: a step at this speed is four millimetres."""
    cup = cell.scene.workpiece.shape
    with cell.world() as world:
        up = cell.lift(world, height_m=0.1)
        path = cell.path(up, up + np.array([-0.9, 0.0, 0.0, 0.0, 0.0, -1.5]), 1.0)
        velocities = np.diff(path, axis=0) / world.settings.step_s
        fastest, seen = 0.0, 0
        for position, velocity in zip(path[:-1].tolist(), velocities.tolist(), strict=True):
            world.command_arm(position, velocity)
            world.step()
            fastest = max(fastest, workpiece_speed(world)[0])
            for point in world.finger_contacts():
                x, y, z = point.position_m
                assert math.hypot(x, y) == pytest.approx(cup.radius_m, abs=5e-6)
                assert abs(z) <= cup.half_height_m
                assert abs(point.gap_m) < 3e-4
                assert math.hypot(*point.normal) == pytest.approx(1.0)
                seen += 1
    assert fastest > 0.8
    assert seen > 400


@pytest.mark.parametrize("robot_is_named_first", [True, False])
def test_the_force_on_a_link_is_the_same_whichever_body_the_engine_names_first(robot_is_named_first):
    """The engine's normal points from the body named second to the first."""
    robot, wall, link = 5, 7, 3
    bodies, links = ((robot, wall), (link, -1)) if robot_is_named_first else ((wall, robot), (-1, link))
    normal = (0.0, 0.6, 0.8) if robot_is_named_first else (0.0, -0.6, -0.8)
    point = (0, *bodies, *links, (1.0, 2.0, 3.0), (1.0, 2.0, 3.0), normal, -1e-4, 10.0, 0, (0, 0, 0), 0, (0, 0, 0))
    reader = ContactReader(
        SimpleNamespace(getContactPoints=lambda *_: [point]),
        0,
        robot=robot,
        workpiece=6,
        finger_of_link={},
        link_names={link: "forearm"},
        scene_names={wall: "wall"},
    )

    (found,) = reader.contacts().robot_contacts
    assert found == RobotContact("forearm", "wall", (1.0, 2.0, 3.0), pytest.approx((0.0, 6.0, 8.0)))
