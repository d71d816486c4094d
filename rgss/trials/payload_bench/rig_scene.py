"""Scene of the payload bench's rig: a vertical rail, and an object on a post below it."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

from rgss.scenes import (
    ChosenGrasp,
    Cylinder,
    Joint,
    PlaceRegion,
    Pose,
    Robot,
    Scene,
    SceneBody,
    Task,
    Workpiece,
    half_extents_m,
)
from rgss.trials.payload_bench.spec import BenchSpec

_CARRIAGE = "carriage"
_RAIL_JOINT = "rail_joint"
_CARRIAGE_MASS_KG = 10.0
_CARRIAGE_INERTIA_KG_M2 = 0.1
_RAIL_FORCE_N = 1.0e6
_RAIL_LENGTH_M = 1.0e3
_POST_HEIGHT_M = 0.2
_POST_SHARE = 0.5
_POST = "post"
_BLACK = (0.0, 0.0, 0.0, 1.0)


def rig_scene(spec: BenchSpec, mass_kg: float) -> Scene:
    """Scene with the object on top of a post, the origin at its foot below the grasp centre, and the rail above."""
    half_m = spec.shape.half_height_m
    radius_m = min(half_extents_m(spec.shape)[:2])
    stands, tool_m, taken = Pose(position_m=(0.0, 0.0, half_m)), half_m, None
    if spec.grasp is not None:
        tool_m += spec.grasp.position_m[2]
        tool = Pose.from_roll_pitch_yaw((0.0, 0.0, tool_m), (math.pi, 0.0, 0.0))
        stands = tool @ spec.grasp.inverse()
        taken = ChosenGrasp(
            id="bench",
            tool_in_object=spec.grasp,
            opening_m=spec.gripper.geometry.largest_opening_m,
            place_yaw_rad=0.0,
            quality_1=0.0,
            com_distance_m=0.0,
            candidates=1,
            rejected=0,
            suction=spec.suction,
        )
    workpiece = Workpiece(
        id="object",
        shape=spec.shape,
        mass_kg=mass_kg,
        friction=spec.object_friction,
        force_limit_n=spec.force_limit_n,
        force_window_s=spec.force_window_s,
        gyration_m2=spec.gyration_m2,
        centre_of_mass_m=spec.centre_of_mass_m[2],
        centre_of_mass_across_m=spec.centre_of_mass_m[:2],
        pose=stands,
        colour=_BLACK,
    )
    return Scene(
        id="payload-bench",
        gravity_m_s2=spec.gravity_m_s2,
        robot=_rail(tool_m + spec.gripper.geometry.grasp_depth_m),
        bodies=(_post(stands @ Pose(position_m=spec.centre_of_mass_m), spec),),
        support=_POST,
        place_support=_POST,
        workpiece=workpiece,
        # A scene has a task; nothing is placed on the bench.
        place=PlaceRegion(centre_m=(0.0, 0.0, 0.0), radius_m=radius_m, largest_tilt_rad=math.pi),
        task=Task(
            approach_height_m=0.0,
            lift_height_m=0.0,
            departure_height_m=0.0,
            place_approach_height_m=0.0,
            place_clearance_m=0.0,
            largest_carry_tilt_rad=math.pi,
            grasp_yaw_rad=0.0,
            place_yaw_rad=0.0,
            grasp=taken,
        ),
    )


def _post(centre_of_mass: Pose, spec: BenchSpec) -> SceneBody:
    """Post under the centre of mass of the object, which three fingers hold beside their axis if it is a box.

    For fingers it is thinner than the object, so that low ones pass it, and without friction: on a rough post the
    object can jam between post and hand, and geared fingers then press unevenly. For a cup it is wide and rough: the
    object neither topples nor slides from its place below the lip.
    """
    x, y, _ = centre_of_mass.position_m
    across_m = half_extents_m(spec.shape)[:2]
    is_for_cup = spec.suction is not None
    radius_m = 2.0 * max(across_m) if is_for_cup else _POST_SHARE * min(across_m)
    return SceneBody(
        id=_POST,
        shape=Cylinder(radius_m=radius_m, height_m=_POST_HEIGHT_M),
        pose=Pose(position_m=(x, y, -_POST_HEIGHT_M / 2)),
        friction=1.0 if is_for_cup else 0.0,
        colour=_BLACK,
    )


def _rail(flange_height_m: float) -> Robot:
    """Robot with one vertical prismatic joint at the flange, whose z points down; up is positive.

    The limits are in m and N despite their names, and so large that they are never active.
    """
    root = ET.Element("robot", {"name": "rail"})
    ET.SubElement(root, "link", {"name": "rail"})
    carriage = ET.SubElement(root, "link", {"name": _CARRIAGE})
    inertial = ET.SubElement(carriage, "inertial")
    ET.SubElement(inertial, "mass", {"value": repr(_CARRIAGE_MASS_KG)})
    along, across = repr(_CARRIAGE_INERTIA_KG_M2), "0"
    ET.SubElement(
        inertial, "inertia", {"ixx": along, "iyy": along, "izz": along, "ixy": across, "ixz": across, "iyz": across}
    )
    joint = ET.SubElement(root, "joint", {"name": _RAIL_JOINT, "type": "prismatic"})
    ET.SubElement(joint, "origin", {"xyz": "0 0 0", "rpy": f"{math.pi!r} 0 0"})
    ET.SubElement(joint, "parent", {"link": "rail"})
    ET.SubElement(joint, "child", {"link": _CARRIAGE})
    ET.SubElement(joint, "axis", {"xyz": "0 0 -1"})
    limits = {
        "lower": repr(-_RAIL_LENGTH_M),
        "upper": repr(_RAIL_LENGTH_M),
        "velocity": repr(_RAIL_LENGTH_M),
        "effort": repr(_RAIL_FORCE_N),
    }
    ET.SubElement(joint, "limit", limits)
    return Robot(
        id="rail",
        urdf=ET.tostring(root, encoding="unicode"),
        flange=_CARRIAGE,
        joints=(
            Joint(
                name=_RAIL_JOINT,
                lower_rad=-_RAIL_LENGTH_M,
                upper_rad=_RAIL_LENGTH_M,
                speed_rad_s=_RAIL_LENGTH_M,
                acceleration_rad_s2=_RAIL_LENGTH_M,
                torque_n_m=_RAIL_FORCE_N,
            ),
        ),
        base=Pose(position_m=(0.0, 0.0, flange_height_m)),
        payload_kg=_RAIL_LENGTH_M,
        tool_acceleration_m_s2=_RAIL_LENGTH_M,
        home_rad=(0.0,),
    )
