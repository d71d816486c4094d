"""Digests of the inputs of each piece of a trial from its scene and its objects.

All objects are treated alike, the first and the further ones: planning uses their ids, shapes, perceived poses,
supports and places; the choice of a grasp also their friction and centre of mass; only the execution uses the other
numbers, the true and the assumed ones. Of a mesh, planning reads the corners; the digest of its file is an input of the
execution alone. The name of the scene and all colours are no inputs.

Planning reads the joints and the collision shapes of the robot and of a linkage, not the inertias of their links: these
are inputs of the execution. A named frame is an input of a task that moves to it, and of no other.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from functools import lru_cache
from typing import Any

from rgss.documents import digest
from rgss.scenes import GripperGeometry, MeshShape, ObjectShape, PlaceRegion, Robot, Scene, Workpiece, centre_of_mass
from rgss.trials.conditions import Conditions
from rgss.trials.pieces.plain_values import to_plain, without

ARM_RATES = ("speed_rad_s", "acceleration_rad_s2")
"""Fields of a joint that only the timing uses."""

_KEPT = 512
_UNPLANNED = ("payload_kg", "tool_speed_m_s", "tool_acceleration_m_s2", "calibration", "frames", "files")
_UNPLANNED_OF_LINK = ("mass_kg", "inertial", "inertia_kg_m2")


@lru_cache(maxsize=_KEPT)
def geometry_digest(scene: Scene, *, frames: frozenset[str] = frozenset(), has_inertias: bool = False) -> str:
    """Digest of the scene's inputs of planning: poses, shapes and joint ranges.

    Args:
        scene: The perceived scene.
        frames: The named frames to which the task moves.
        has_inertias: True if planning reads the inertias of the robot's links.
    """
    robot = without(to_plain(scene.robot), _UNPLANNED)
    if not has_inertias:
        robot["urdf"] = _without_inertias(scene.robot.urdf)
    robot["joints"] = [without(joint, (*ARM_RATES, "torque_n_m")) for joint in robot["joints"]]
    # The effort of a follower limits the execution alone.
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
    if named := [one for one in scene.frames if one.id in frames]:
        geometry["frames"] = to_plain(named)
    if scene.places:
        geometry["places"] = [[one.id, one.support, _position(one.region)] for one in scene.places]
    return digest(geometry)


def choice_digest(conditions: Conditions) -> tuple[str, ...]:
    """Digests of the non-geometric inputs of the choice of the grasps; empty for stated grasps."""
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
def gripper_geometry_digest(geometry: GripperGeometry) -> str:
    """Digest of the gripper's inputs of planning.

    Args:
        geometry: The gripper's shape.
    """
    plain = to_plain(geometry)
    if geometry.linkage is not None:
        plain["linkage"]["links"] = [without(link, _UNPLANNED_OF_LINK) for link in plain["linkage"]["links"]]
    return digest(plain)


@lru_cache(maxsize=16)
def description_digest(robot: Robot) -> str:
    """Digest of the robot's description with the inertias of its links and the content of its meshes."""
    return digest([robot.urdf, to_plain(robot.files)])


@lru_cache(maxsize=16)
def _without_inertias(urdf: str) -> str:
    """URDF without the inertias of its links and without comments; a text that is no XML as it is."""
    try:
        root = ET.fromstring(urdf)  # noqa: S314 - entities and document types were refused on reading
    except ET.ParseError:
        return urdf
    for link in root.iter("link"):
        for inertial in link.findall("inertial"):
            link.remove(inertial)
    return ET.tostring(root, encoding="unicode")


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
        "description": description_digest(scene.robot),
        **_stated_inertia(scene.workpiece),
    }
    if scene.others:
        physics["others"] = [
            [_strength(one.workpiece), _tolerances(one.place), _stated_inertia(one.workpiece)] for one in scene.others
        ]
    if followers := scene.robot.followers:
        physics["follower_efforts"] = [one.effort if math.isfinite(one.effort) else None for one in followers]
    if meshes := [one.workpiece.shape.sha256 for one in scene.objects if isinstance(one.workpiece.shape, MeshShape)]:
        physics["meshes"] = meshes
    if scene.places:
        physics["places"] = [_tolerances(one.region) for one in scene.places]
    return digest(physics)


def true_values_digest(conditions: Conditions) -> str:
    """Digest of the true values that planning does not use, and of the properties that the robot assumes."""
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
    """Plain shape; of a mesh the corners alone, without the digest of its file."""
    return {"kind": type(shape).__name__, **without(to_plain(shape), ("sha256",))}
