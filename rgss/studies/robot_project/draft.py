"""A robot file drafted from a URDF, with copies of the files that the URDF names."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from rgss.errors import DefinitionError, DocumentError
from rgss.findings import shown
from rgss.scenes import Pose, Robot, load_robot
from rgss.studies.robot_project.palm_of_fingers import with_palm
from rgss.studies.robot_project.robot_text import robot_text
from rgss.studies.robot_project.tool_axis import add_tool_frame, likely_tool_axes
from rgss.studies.robot_project.urdf import (
    NO_ARGUMENTS,
    UrdfArm,
    arm_of_urdf,
    complete_masses,
    copy_named_files,
    decompose,
    read_arm_urdf,
    snap_right_angles,
)

_DRAFT_PAYLOAD_KG = 1.0
_POSE_FREEDOMS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedRobot:
    """A robot with the limits of its URDF.

    Attributes:
        arm: The arm in the URDF.
        robot: The robot.
        file: The robot file.
        likely_tool_axes: Axes of the flange along which a gripper may point away from the arm, the most likely first.
        flange: The link whose axes these are.
    """

    arm: UrdfArm
    robot: Robot
    file: Path
    likely_tool_axes: tuple[str, ...]
    flange: str


def drafted_robot(
    urdf: Path,
    project: Path,
    *,
    flange: str | None = None,
    tool_axis: str = "z",
    mass_kg: float | None = None,
    xacro: Mapping[str, str] = NO_ARGUMENTS,
    is_decomposed: bool = False,
) -> DraftedRobot:
    """Draft a robot file from a URDF, at home in the middle of its ranges.

    Args:
        urdf: The URDF.
        project: The folder in whose ``scenes/robots`` the files are put.
        flange: The link that carries the gripper; found if None.
        tool_axis: The axis of that link along which the gripper points away from the arm.
        mass_kg: Mass of the arm with its base, for a URDF without masses.
        xacro: Arguments, if the URDF is a xacro.
        is_decomposed: True to divide concave collision meshes into convex parts.

    Raises:
        DefinitionError: There is no arm in the URDF, a file that it names is missing, or the description is wrong.
    """
    root, notes = read_arm_urdf(urdf, xacro)
    arm, added = with_palm(root, arm_of_urdf(root, flange=flange))
    notes += [*arm.notes, *added]
    if len(arm.joints) < _POSE_FREEDOMS:
        notes += snap_right_angles(root)
    likely = likely_tool_axes(root, arm, urdf)
    notes += complete_masses(root, urdf, leave=(*arm.hands, *arm.rods), mass_kg=mass_kg)
    id_ = identifier_of(arm.name, prefix="arm")
    robots = project / "scenes" / "robots"
    robots.mkdir(parents=True, exist_ok=True)
    notes += copy_named_files(root, urdf, robots)
    if is_decomposed:
        notes += decompose(root, robots)
    link = arm.flange
    mount, assumed = add_tool_frame(root, arm, tool_axis)
    arm = replace(arm, flange=mount, notes=(*notes, *assumed))
    ET.indent(root)
    (robots / f"{id_}.urdf").write_text(ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    home = tuple(0.5 * (joint.lower + joint.upper) for joint in arm.joints)
    file = robots / f"{id_}.yaml"
    draft = robot_text(arm, id_=id_, urdf=f"{id_}.urdf", home=home, held_kg=_DRAFT_PAYLOAD_KG)
    file.write_text(draft, encoding="utf-8")
    try:
        robot = load_robot(file, base=Pose(), label=f"scenes/robots/{id_}.yaml", project=project)
    except DocumentError as error:
        # The drafted files are not there any more when the message is read.
        first = error.findings[0]
        message = first.message.removeprefix(f"{shown(f'{id_}.urdf')} ")
        raise DefinitionError(
            f"{urdf.name} {message}" if message.startswith("has ") else f"{urdf.name}: {message}", hint=first.hint
        ) from error
    return DraftedRobot(arm=arm, robot=robot, file=file, likely_tool_axes=likely, flange=link)


def identifier_of(name: str, *, prefix: str) -> str:
    """Identifier from a name of a URDF.

    Args:
        name: The name.
        prefix: What precedes a name that begins with no letter.
    """
    found = re.sub(r"[^A-Za-z0-9_.-]+", "_", name).strip("_.-").lower()
    return found if found[:1].isalpha() else f"{prefix}_{found}"
