"""What every contact world must do, by the laws of mechanics, on each engine."""

from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import DefinitionError, SimulationError
from rgss.physics import PhysicsSettings, open_world
from rgss.physics.mujoco.robot_links import read_links
from rgss.scenes import Box, ObjectPlacement, Pose, SceneObject, scene_about
from rgss.trials.second_engine import mujoco_settings

pytestmark = pytest.mark.engine

GRAVITY = 9.81


@pytest.fixture(scope="session", params=["pybullet", "mujoco"])
def settings(request):
    return PhysicsSettings() if request.param == "pybullet" else mujoco_settings()


@pytest.fixture
def raised(scene):
    """The scene with its cup in the air, far from everything."""
    cup = scene.workpiece
    return replace(scene, workpiece=replace(cup, pose=Pose(position_m=(0.0, 2.0, 3.0))))


def test_a_body_falls_as_galilei_says(settings, raised, gripper_with):
    with open_world(raised, gripper_with(2), settings) as world:
        world.reset_arm(raised.robot.home_rad)
        steps = round(0.25 * settings.rate_hz)
        for _ in range(steps):
            world.command_arm(raised.robot.home_rad, (0.0,) * 6)
            world.step()
        fallen_m = 3.0 - world.workpiece_pose().position_m[2]
    time_s = steps / settings.rate_hz
    # By the speed at each step's end, half a step more than the parabola.
    assert fallen_m == pytest.approx(GRAVITY * time_s * (time_s + settings.step_s) / 2, rel=1e-9)


def test_each_of_several_objects_falls_and_any_can_be_the_workpiece(settings, raised, gripper_with):
    own = SceneObject(
        workpiece=replace(raised.workpiece, id="box", shape=Box(size_m=(0.03, 0.02, 0.05)), mass_kg=2.0),
        support=raised.support,
        place=raised.place,
        place_support=raised.place_support,
    )
    beside = Pose(position_m=(1.0, 2.0, 4.0))
    scene = replace(raised, others=(replace(own, workpiece=replace(own.workpiece, pose=beside)),))
    with open_world(scene, gripper_with(2), settings) as world:
        world.reset_arm(scene.robot.home_rad)
        for _ in range(round(0.1 * settings.rate_hz)):
            world.command_arm(scene.robot.home_rad, (0.0,) * 6)
            world.step()
        cup, box = world.object_pose(scene.workpiece.id), world.object_pose("box")
        assert world.workpiece_pose() == cup
        placements = {
            name: ObjectPlacement(pose=pose, support="") for name, pose in ((scene.workpiece.id, cup), ("box", box))
        }
        world.set_workpiece(scene_about(scene, "box", place="", placements=placements))
        assert world.workpiece_pose() == box
        assert world.object_pose(scene.workpiece.id) == cup
    assert 3.0 - cup.position_m[2] == pytest.approx(4.0 - box.position_m[2], rel=1e-9)
    assert box.position_m[:2] == pytest.approx(beside.position_m[:2])


def test_an_object_that_is_not_the_workpiece_counts_as_a_body(settings, scene, gripper_with):
    """It stands at the tool, and under the cup."""
    with open_world(scene, gripper_with(2), settings) as free:
        free.reset_arm(scene.robot.home_rad)
        tool = free.tool_pose().position_m
    x, y, z = scene.workpiece.pose.position_m
    low, high = z - scene.workpiece.shape.half_height_m + 0.025, z + 0.05
    small = Box(size_m=(0.05, 0.05, 0.05))
    places = {"at_tool": (tool, Box(size_m=(0.2, 0.2, 0.2))), "under": ((x, y, low), small)}
    others = tuple(
        SceneObject(
            workpiece=replace(scene.workpiece, id=name, shape=shape, pose=Pose(position_m=at)),
            support=scene.support,
            place=scene.place,
            place_support=scene.place_support,
        )
        for name, (at, shape) in places.items()
    )
    lifted = replace(scene.workpiece, pose=Pose(position_m=(x, y, high - 1e-4)))
    with open_world(replace(scene, workpiece=lifted, others=others), gripper_with(2), settings) as world:
        world.reset_arm(scene.robot.home_rad)
        world.command_arm(scene.robot.home_rad, (0.0,) * 6)
        world.step()
        contacts = world.contacts()
    assert {body for _, body in contacts.robot_bodies} == {"at_tool"}
    assert contacts.workpiece_bodies == ("under",)


def test_the_arm_holds_where_it_is_told_against_gravity(settings, scene, gripper_with):
    with open_world(scene, gripper_with(3), settings) as world:
        world.reset_arm(scene.robot.home_rad)
        start = world.tool_pose().position_m
        for _ in range(round(0.3 * settings.rate_hz)):
            world.command_arm(scene.robot.home_rad, (0.0,) * 6)
            world.step()
        positions, velocities, torques = world.arm_state()
        moved = [abs(a - b) for a, b in zip(world.tool_pose().position_m, start, strict=True)]
    assert positions == pytest.approx(scene.robot.home_rad, abs=1e-4)
    assert velocities == pytest.approx([0.0] * 6, abs=1e-3)
    assert max(moved) < 1.0e-4
    assert 0.0 < max(map(abs, torques)) < max(joint.torque_n_m for joint in scene.robot.joints)


def test_both_engines_need_the_same_torques_against_gravity(scene, gripper_with):
    """Masses and centres of mass are read from the description in two ways."""
    torques = []
    for settings in (PhysicsSettings(), mujoco_settings()):
        with open_world(scene, gripper_with(3), settings) as world:
            world.reset_arm(scene.robot.home_rad)
            for _ in range(round(0.5 * settings.rate_hz)):
                world.command_arm(scene.robot.home_rad, (0.0,) * 6)
                world.step()
            torques.append(world.arm_state()[2])
    assert torques[1] == pytest.approx(torques[0], rel=2e-3, abs=0.02)


def test_a_cup_at_rest_is_borne_by_its_support_alone(settings, scene, gripper_with):
    with open_world(scene, gripper_with(2), settings) as world:
        world.reset_arm(scene.robot.home_rad)
        forces = []
        for _ in range(round(0.3 * settings.rate_hz)):
            world.command_arm(scene.robot.home_rad, (0.0,) * 6)
            world.step()
            forces.append(world.support_force_n())
        contacts = world.contacts()
        assert world.contacts(contacts) is contacts
        assert world.finger_contacts() == ()
        stands_m = world.workpiece_pose().position_m
    half = forces[len(forces) // 2 :]
    assert sum(half) / len(half) == pytest.approx(scene.workpiece.mass_kg * GRAVITY, rel=1e-3)
    assert contacts.workpiece_bodies == (scene.support,)
    assert not contacts.is_robot_touching
    assert stands_m == pytest.approx(scene.workpiece.pose.position_m, abs=2e-4)


def test_an_arm_that_stands_in_the_counter_is_told(settings, scene, gripper_with):
    body = scene.bodies[0]
    with open_world(scene, gripper_with(2), settings) as free:
        free.reset_arm(scene.robot.home_rad)
        tool = free.tool_pose().position_m
    inside = replace(body, id="finger_0", pose=Pose(position_m=tool))
    blocked = replace(scene, bodies=(*scene.bodies, inside))
    with open_world(blocked, gripper_with(2), settings) as world:
        world.reset_arm(scene.robot.home_rad)
        world.command_arm(scene.robot.home_rad, (0.0,) * 6)
        world.step()
        pairs = world.contacts().robot_bodies
    assert "finger_0" in {name for _, name in pairs}
    assert {link for link, _ in pairs} & {"gripper_base", "wrist_3_link", "finger_0", "finger_1"}


def test_what_fingers_stand_in_presses_them_out(settings, scene, gripper_with):
    gripper = gripper_with(2)
    with open_world(scene, gripper, settings) as free:
        free.reset_arm(scene.robot.home_rad)
        tool = free.tool_pose()
    assert tool.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-3)
    x, y, z = tool.position_m
    top_m = z - 0.03 + 0.002  # the fingertips reach 30 mm below the grasp centre
    slab = replace(
        scene.bodies[0], id="slab", shape=Box(size_m=(0.3, 0.3, 0.02)), pose=Pose(position_m=(x, y, top_m - 0.01))
    )
    with open_world(replace(scene, bodies=(*scene.bodies, slab)), gripper, settings) as world:
        world.reset_arm(scene.robot.home_rad)
        world.command_arm(scene.robot.home_rad, (0.0,) * 6)
        world.step()
        contacts = world.contacts()
        found = contacts.robot_contacts

    assert {(one.link, one.body) for one in found} == {*contacts.robot_bodies}
    assert {link for link, _ in contacts.robot_bodies} == {
        link for link, body in contacts.robot_bodies if body == "slab"
    }
    assert len({one.link for one in found}) == 2
    for one in found:
        assert one.position_m[2] == pytest.approx(top_m, abs=3e-3)
        assert np.hypot(x - one.position_m[0], y - one.position_m[1]) < 0.1
        assert one.force_n[2] > 0.9 * np.linalg.norm(one.force_n) > 0.0


@pytest.mark.parametrize("mass_kg", [0.0, float("nan"), float("inf"), -1.0])
def test_an_impossible_mass_is_refused(settings, scene, gripper_with, mass_kg):
    impossible = replace(scene, workpiece=replace(scene.workpiece, mass_kg=mass_kg))
    with pytest.raises(SimulationError, match="the mass of the workpiece must be positive"):
        open_world(impossible, gripper_with(2), settings)


def test_the_same_steps_give_the_same_bits(settings, scene, gripper_with):
    def run():
        with open_world(scene, gripper_with(3), settings) as world:
            world.reset_arm(scene.robot.home_rad)
            for index in range(200):
                world.command_arm(scene.robot.home_rad, (0.01 * (index % 7),) * 6)
                world.step()
            return world.arm_state(), world.workpiece_pose()

    assert run() == run()


def test_a_rate_at_which_contacts_are_unstable_is_refused(scene, gripper_with):
    with pytest.raises(DefinitionError, match=r"the rate must be at least 500 Hz in MuJoCo, got 240 Hz"):
        open_world(scene, gripper_with(2), mujoco_settings(rate_hz=240.0))


def test_a_robot_that_the_engine_refuses_is_told_in_one_line(scene, gripper_with):
    odd = scene.robot.urdf.replace("ixx=", 'ixx="-1" was=', 1)
    assert odd != scene.robot.urdf
    with pytest.raises(SimulationError, match="the physics engine rejected the world: "):
        open_world(replace(scene, robot=replace(scene.robot, urdf=odd)), gripper_with(2), mujoco_settings())


def test_a_shape_that_the_second_engine_is_not_given_is_named(scene, gripper_with):
    odd = scene.robot.urdf.replace("<cylinder ", "<ellipsoid ")
    with pytest.raises(
        SimulationError, match=r"the second engine does not support the robot.s collision shape <ellipsoid>"
    ):
        open_world(replace(scene, robot=replace(scene.robot, urdf=odd)), gripper_with(2), mujoco_settings())


def test_a_description_without_what_it_needs_is_named():
    urdf = '<robot><link name="a"/><joint name="j" type="fixed"><child link="a"/></joint></robot>'
    with pytest.raises(LookupError, match="a <joint> of the robot has no <parent>"):
        read_links(urdf)


def test_links_come_after_those_that_they_are_mounted_on():
    urdf = """<robot>
      <joint name="out" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0 1"/></joint>
      <joint name="up" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
      <joint name="aside" type="fixed"><parent link="a"/><child link="d"/></joint>
      <link name="c"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
      <link name="b"><inertial><mass value="2"/><inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/></inertial>
      </link><link name="d"/><link name="a"/></robot>"""
    base, turning, fixed, sliding = read_links(urdf)
    assert [base.name, turning.name, fixed.name, sliding.name] == ["a", "b", "d", "c"]
    assert (turning.joint, turning.axis, turning.is_prismatic, turning.mass_kg) == ("up", (0.0, 0.0, 1.0), False, 2.0)
    assert (fixed.joint, sliding.joint, sliding.is_prismatic, sliding.axis) == ("", "out", True, (1.0, 0.0, 0.0))
    assert sliding.pose.position_m == (0.0, 0.0, 1.0)
    assert sliding.shapes == ((0.1, Pose(position_m=(1.0, 0.0, 0.0))),)


def test_a_world_that_runs_away_is_told(scene, gripper_with):
    with open_world(scene, gripper_with(2), mujoco_settings()) as world:
        world.reset_arm(scene.robot.home_rad)
        world.drive_fingers(float("nan"), 10.0)
        with pytest.raises(SimulationError, match=r"MuJoCo warned: .*BAD.* \(use a higher rate\)"):
            world.step()
