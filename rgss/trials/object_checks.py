"""Checks of the object's pose: before the grasp, while it settles, and at its place."""

from __future__ import annotations

import math

from rgss.evidence import Failure, Metric
from rgss.grasping import configuration_distance_m
from rgss.grasping.candidates import symmetric_turns
from rgss.physics import ContactWorld
from rgss.scenes import Cylinder, ObjectShape, Pose
from rgss.trials.plants import ControlSettings

Violation = tuple[Failure, str]


def check_displacement(world: ContactWorld, largest_m: float, *, touched: bool) -> tuple[float, Violation | None]:
    """Displacement in m of an object before its grasp, and the violation if it exceeds a limit."""
    pose, start = world.workpiece_pose(), world.scene.workpiece.pose
    moved_m = math.dist(pose.position_m, start.position_m)
    if moved_m <= largest_m:
        return moved_m, None
    if touched:
        return moved_m, (Failure.OBJECT_COLLISION, f"the object was pushed {moved_m * 1e3:.1f} mm before the grasp")
    tilt_rad = world.scene.place.largest_tilt_rad
    return moved_m, moved_by_itself("the object", start, pose, largest_m, tilt_rad, when=" before the grasp")


def moved_by_itself(
    name: str, start: Pose, pose: Pose, largest_m: float, largest_tilt_rad: float, *, when: str = ""
) -> Violation:
    """Violation by an object that has moved and that nothing touched.

    Args:
        name: Name of the object in the message.
        start: Transform of the object to the world before it moved.
        pose: Its present transform.
        largest_m: Depth from which it counts as fallen.
        largest_tilt_rad: Tilt above which it counts as toppled.
        when: End of the message.
    """
    displacement = f"{math.dist(pose.position_m, start.position_m) * 1e3:.1f} mm{when}"
    fallen_m = start.position_m[2] - pose.position_m[2]
    if pose.tilt_rad > largest_tilt_rad:
        lean = f"it is tilted by {math.degrees(pose.tilt_rad):.0f}° and moved {displacement}"
        return Failure.NOT_UPRIGHT, f"{name} toppled by itself: {lean}"
    if fallen_m > largest_m:
        return Failure.OBJECT_DROPPED, f"{name} fell by itself: {fallen_m * 1e3:.1f} mm{when}"
    return Failure.OBJECT_DROPPED, f"{name} slid by itself: {displacement}"


def check_place(world: ContactWorld) -> tuple[dict[str, Metric], Violation | None]:
    """Position error, tilt and turn of the placed object, and the violation if one of them exceeds its limit."""
    scene, pose = world.scene, world.workpiece_pose()
    x, y, z = pose.position_m
    centre = scene.place.centre_m
    error_m, tilt_rad = math.dist((x, y), centre[:2]), pose.tilt_rad
    turn_rad = _turn_rad(pose, scene.placed_object, scene.workpiece.shape)
    largest_turn_rad = scene.place.largest_turn_rad
    height_error_m = abs(z - centre[2] - scene.workpiece.shape.half_height_m)
    violation: Violation | None = None
    if tilt_rad > scene.place.largest_tilt_rad:
        violation = Failure.NOT_UPRIGHT, f"the object is tilted by {math.degrees(tilt_rad):.1f} deg"
    elif error_m > scene.place.radius_m or height_error_m > scene.place.radius_m:
        found = f"{error_m * 1e3:.1f} mm from the place and {height_error_m * 1e3:.1f} mm off its height"
        most = f"at most {scene.place.radius_m * 1e3:.4g} mm each"
        violation = Failure.NOT_IN_PLACE_REGION, f"the object is {found}, {most}"
    elif largest_turn_rad is not None and turn_rad > largest_turn_rad:
        found = f"turned by {math.degrees(turn_rad):.1f} deg from its orientation at the place"
        violation = (
            Failure.NOT_IN_PLACE_REGION,
            f"the object is {found}, more than {math.degrees(largest_turn_rad):.4g} deg",
        )
    return {"place_error_m": error_m, "place_tilt_rad": tilt_rad, "place_turn_rad": turn_rad}, violation


def _turn_rad(pose: Pose, placed: Pose, shape: ObjectShape) -> float:
    """Angle about the vertical from one orientation of an object to another, up to its shape's symmetry."""
    if isinstance(shape, Cylinder):
        return 0.0
    # The rotation about the vertical is the twist in the swing-twist decomposition of the quaternion.
    _, _, qz, qw = (pose @ placed.inverse()).quaternion_xyzw
    turned_rad = 2.0 * math.atan2(qz, qw)
    return min(abs(math.remainder(turned_rad - one, math.tau)) for one in symmetric_turns(shape, 1))


def has_moved(world: ContactWorld, control: ControlSettings, before: Pose, now: Pose) -> bool:
    """True if the object has moved, by translation or rotation.

    The criterion is a displacement, not a speed: when the engine detects a resting body's contacts again, the body has
    a speed for one step and hardly moves.

    Args:
        world: The world.
        control: Speed and time below which the object counts as settled.
        before: Earlier transform of the object to the world.
        now: Present transform of the object to the world.
    """
    moved_m = configuration_distance_m(before, now, world.scene.workpiece.shape.half_height_m)
    return moved_m > control.settled_speed_m_s * control.settled_s
