"""Trials with one thing changed."""

from __future__ import annotations

from dataclasses import replace

from rgss.scenes import Box, Pose, SceneBody
from rgss.tasks import MoveKind
from tests.fixtures.eight_states import PLANNED_PHASES


def with_scene(spec, **changes):
    return replace(spec, scene=replace(spec.scene, **changes))


def with_workpiece(spec, **changes):
    return with_scene(spec, workpiece=replace(spec.scene.workpiece, **changes))


def with_cup_of(spec, radius_m):
    return with_workpiece(spec, shape=replace(spec.scene.workpiece.shape, radius_m=radius_m))


def with_cup_at(spec, x, y):
    return with_workpiece(spec, pose=Pose(position_m=(x, y, spec.scene.workpiece.pose.position_m[2])))


def with_place(spec, **changes):
    return with_scene(spec, place=replace(spec.scene.place, **changes))


def with_task(spec, **changes):
    return with_scene(spec, task=replace(spec.scene.task, **changes))


def with_gripper(spec, **changes):
    return replace(spec, gripper=replace(spec.gripper, **changes))


def with_control(spec, **changes):
    return replace(spec, settings=replace(spec.settings, control=replace(spec.settings.control, **changes)))


def with_planning(spec, **changes):
    return replace(spec, settings=replace(spec.settings, planning=replace(spec.settings.planning, **changes)))


def with_moves(spec, **kinds):
    """Some moves of another kind than planned."""
    moves = tuple(MoveKind(kinds.get(phase.value, "planned")) for phase in PLANNED_PHASES)
    return with_planning(spec, moves=moves)


def with_joint(spec, name, torque_n_m):
    robot = spec.scene.robot
    joints = tuple(replace(one, torque_n_m=torque_n_m) if one.name == name else one for one in robot.joints)
    return with_scene(spec, robot=replace(robot, joints=joints))


def with_slippery_slope(spec, slope_rad):
    """The counter of the place without friction to speak of, turned about a line through the place."""
    scene = spec.scene
    about = Pose(position_m=scene.place.centre_m)
    turn = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (slope_rad, 0.0, 0.0))
    bodies = tuple(
        replace(body, pose=about @ turn @ about.inverse() @ body.pose, friction=0.01)
        if body.id == scene.place_support
        else body
        for body in scene.bodies
    )
    return with_scene(spec, bodies=bodies)


def with_body(spec, size_m, position_m):
    body = SceneBody(
        id="obstacle", shape=Box(size_m=size_m), pose=Pose(position_m=position_m), friction=0.5, colour=(0, 0, 0, 1)
    )
    return with_scene(spec, bodies=(*spec.scene.bodies, body))
