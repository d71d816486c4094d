"""Conditions of a check step, evaluated on the true state of the object."""

from __future__ import annotations

import math

from rgss.grasping import configuration_distance_m
from rgss.physics import ContactWorld
from rgss.scenes import PlaceRegion, Pose, region_now
from rgss.tasks import CheckStep, Nearness
from rgss.trials.plants import ControlSettings

Point = tuple[float, float, float]


def violated_condition(world: ContactWorld, control: ControlSettings, step: CheckStep, before: Pose) -> str:
    """Message of the first violated condition, with its numbers; empty if all hold.

    Args:
        world: The world after the observation time of rest.
        control: Thresholds of rest.
        step: The conditions.
        before: Transform of the object to the world before that time.
    """
    scene = world.scene
    name = step.object or scene.workpiece.id
    about, pose = next(one for one in scene.objects if one.workpiece.id == name), world.object_pose(name)
    if step.at:
        region = _region_now(world, step.at)
        error_m = math.dist(pose.position_m[:2], region.centre_m[:2])
        height_error_m = abs(pose.position_m[2] - region.centre_m[2] - about.workpiece.shape.half_height_m)
        if max(error_m, height_error_m) > region.radius_m:
            off = f" and {height_error_m * 1e3:.1f} mm off its height there" if height_error_m > region.radius_m else ""
            allowed = f"at most {region.radius_m * 1e3:g} mm are allowed"
            return f"{name} is {error_m * 1e3:.1f} mm from {step.at}{off}, {allowed}"
    if step.near is not None:
        point_m, name_of_point = _point(world, step.near, about.workpiece.shape.half_height_m)
        distance_m = math.dist(pose.position_m, point_m)
        if distance_m > step.near.within_m:
            allowed = f"at most {step.near.within_m * 1e3:g} mm are allowed"
            return f"the centre of {name} is {distance_m * 1e3:.1f} mm from {name_of_point}, {allowed}"
    if step.is_upright and pose.tilt_rad > about.place.largest_tilt_rad:
        return f"{name} is tilted by {math.degrees(pose.tilt_rad):.1f} deg"
    if step.is_at_rest:
        moved_m = configuration_distance_m(before, pose, about.workpiece.shape.half_height_m)
        if moved_m > control.settled_speed_m_s * control.settled_s:
            return f"{name} has moved by {moved_m * 1e3:.2f} mm in {control.settled_s:g} s"
    if step.held is not None:
        touching = world.contacts().fingers_touching if name == scene.workpiece.id else 0
        holding = 1 if world.gripper.geometry.cup is not None else world.gripper.geometry.fingers
        if touching != (holding if step.held else 0):
            if world.gripper.geometry.cup is not None:
                return f"the cup {'touches' if touching else 'does not touch'} {name}"
            return f"{touching} of {holding} fingers touch {name}"
    return ""


def _region_now(world: ContactWorld, place: str) -> PlaceRegion:
    """Region of a named place, on an object where that stands now."""
    named = next(one for one in world.scene.places if one.id == place)
    return region_now(world.scene, named.region, named.support, world.object_pose)


def _point(world: ContactWorld, near: Nearness, half_height_m: float) -> tuple[Point, str]:
    """Reference point of a nearness condition in the world, and its name."""
    if near.point_m is not None:
        return near.point_m, "the point"
    if near.object:
        return world.object_pose(near.object).position_m, f"that of {near.object}"
    x, y, z = _region_now(world, near.place).centre_m
    return (x, y, z + half_height_m), f"its position at {near.place}"
