"""Digests of the inputs of each piece of a trial from its scene and its objects.

All objects are treated alike, the first and the further ones: planning uses their ids, shapes, perceived poses,
supports and places; the choice of a grasp also their friction and centre of mass; only the execution uses the other
numbers, the true and the assumed ones. The name of the scene and all colours are no inputs.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from rgss.documents import digest
from rgss.scenes import ObjectShape, PlaceRegion, Scene, Workpiece, centre_of_mass
from rgss.trials.conditions import Conditions
from rgss.trials.pieces.plain_values import to_plain, without

ARM_RATES = ("speed_rad_s", "acceleration_rad_s2")
"""Fields of a joint that only the timing uses."""

_KEPT = 512
_UNPLANNED = ("payload_kg", "tool_speed_m_s", "tool_acceleration_m_s2", "calibration", "frames")


@lru_cache(maxsize=_KEPT)
def geometry_digest(scene: Scene) -> str:
    """Digest of the scene's inputs of planning: poses, shapes and joint ranges.

    Args:
        scene: The perceived scene.
    """
    robot = without(to_plain(scene.robot), _UNPLANNED)
    robot["joints"] = [without(joint, (*ARM_RATES, "torque_n_m")) for joint in robot["joints"]]
    # No trial uses the effort of a follower.
    robot["followers"] = [without(one, ("effort",)) for one in robot["followers"]]
    if not robot["followers"]:
        del robot["followers"]
    geometry = {
        "robot": robot,
        "bodies": [{"id": body.id, "shape": _shape(body.shape), "pose": to_plain(body.pose)} for body in scene.bodies],
        "workpiece": _solid(scene.workpiece),
        "supports": [scene.support, scene.place_support],
        "place": _position(scene.place),
        "task": _waypoints(scene),
    }
    if scene.others:
        geometry["others"] = [
            [_solid(one.workpiece), one.support, one.place_support, _position(one.place)] for one in scene.others
        ]
    if scene.frames:
        geometry["frames"] = to_plain(scene.frames)
    if scene.places:
        geometry["places"] = [[one.id, one.support, _position(one.region)] for one in scene.places]
    return digest(geometry)


def choice_digest(conditions: Conditions) -> tuple[str, ...]:
    """Digests of the non-geometric inputs of the choice of the grasps; empty for stated grasps.

    Args:
        conditions: The conditions of the trial.
    """
    scene, gripper = conditions.perceived_scene, conditions.design_gripper
    if scene.task.candidates is None:
        return ()
    own = gripper.grip_coefficient(1.0)
    chosen = [
        # A cup grips by its own forces, whatever the friction of the object.
        [to_plain(one.grasps), list(centre_of_mass(one)), [own] if gripper.suction else [one.friction, own]]
        for one in (each.workpiece for each in scene.objects)
    ]
    return tuple(map(digest, chosen))


@lru_cache(maxsize=_KEPT)
def physics_digest(scene: Scene) -> str:
    """Digest of the scene's inputs that only the physics uses.

    Args:
        scene: The true scene.
    """
    physics = {
        "gravity_m_s2": scene.gravity_m_s2,
        "frictions": [body.friction for body in scene.bodies],
        "workpiece": _strength(scene.workpiece),
        "place": _tolerances(scene.place),
        "torques_n_m": [joint.torque_n_m for joint in scene.robot.joints],
        **_stated_inertia(scene.workpiece),
    }
    if scene.others:
        physics["others"] = [
            [_strength(one.workpiece), _tolerances(one.place), _stated_inertia(one.workpiece)] for one in scene.others
        ]
    if scene.places:
        physics["places"] = [_tolerances(one.region) for one in scene.places]
    return digest(physics)


def true_values_digest(conditions: Conditions) -> str:
    """Digest of the true values that planning does not use, and of the properties that the robot assumes.

    Args:
        conditions: The conditions of the trial.
    """
    true, assumed = conditions.true_scene.objects, conditions.scene.objects
    return digest(
        {
            "objects": [
                [to_plain(one.workpiece.pose), one.workpiece.centre_of_mass_m, *_assumed(known.workpiece)]
                for one, known in zip(true, assumed, strict=True)
            ],
            "pads": conditions.design_gripper.friction,
            "sensor": [conditions.sensor_noise_n, conditions.sensor_offset_n, conditions.sensor_delay_s],
            "joint_offsets_rad": list(conditions.joint_offsets_rad),
        }
    )


def _assumed(workpiece: Workpiece) -> tuple[float, ...]:
    """Properties that the control of the grip and the controller's model of the arm assume."""
    return workpiece.mass_kg, workpiece.friction, workpiece.centre_of_mass_m


def _strength(workpiece: Workpiece) -> list[float]:
    return [
        workpiece.mass_kg,
        workpiece.friction,
        workpiece.force_limit_n,
        workpiece.force_window_s,
        workpiece.landing_limit_m_s,
    ]


def _tolerances(place: PlaceRegion) -> list[float]:
    of_all = [place.radius_m, place.largest_tilt_rad, place.largest_drop_m, place.largest_drag_m]
    return of_all if place.largest_turn_rad is None else [*of_all, place.largest_turn_rad]


def _stated_inertia(workpiece: Workpiece) -> dict[str, Any]:
    """Stated mass properties that differ from those of a homogeneous shape."""
    if workpiece.gyration_m2 is None and not any((*workpiece.centre_of_mass_across_m, workpiece.rolling_resistance_m)):
        return {}
    stated = [workpiece.gyration_m2, workpiece.centre_of_mass_across_m, workpiece.rolling_resistance_m]
    return {"inertia": stated}


def _solid(workpiece: Workpiece) -> dict[str, Any]:
    return {"id": workpiece.id, "shape": _shape(workpiece.shape), "pose": to_plain(workpiece.pose)}


def _position(place: PlaceRegion) -> Any:
    """Centre of a place region; on an object its offset there, from which the centre follows."""
    return to_plain(place.offset_m or place.centre_m)


def _waypoints(scene: Scene) -> dict[str, Any]:
    task: dict[str, Any] = to_plain(scene.task)
    return task if scene.task.is_yaw_free else without(task, ("is_yaw_free",))


def _shape(shape: ObjectShape) -> dict[str, Any]:
    return {"kind": type(shape).__name__, **to_plain(shape)}
