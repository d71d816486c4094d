"""A gripper file drafted from a URDF: that of a gripper, or of an arm with its hand."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rgss.errors import DefinitionError, DocumentError
from rgss.scenes import FoundPads, GripperGeometry, Pose, carried_by, find_pads, load_gripper_file, origin_of
from rgss.studies.robot_project.cup_size import cups_of, grasp_from_tip_m
from rgss.studies.robot_project.draft import DraftedRobot, identifier_of
from rgss.studies.robot_project.fingers_of_urdf import complete_fingers
from rgss.studies.robot_project.layout import Cup
from rgss.studies.robot_project.tool_axis import TOOL_AXES
from rgss.studies.robot_project.urdf import NO_ARGUMENTS, Note, copy_named_files, decompose, read_arm_urdf

_LARGEST_SPEED_M_S, _LARGEST_FORCE_N = 0.05, 20.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedGripper:
    """A gripper with the limits of its URDF.

    Attributes:
        id: Its id.
        geometry: Its shape.
        force_n: Largest force of one pad that the project demands, at most that of the driven joint.
        cups: Cups that it can grasp, the largest first; smaller ones leave more room to its links.
        notes: What was assumed about it.
    """

    id: str
    geometry: GripperGeometry
    force_n: float
    cups: tuple[Cup, ...]
    notes: tuple[Note, ...]


def drafted_hand(urdf: Path, project: Path, drafted: DraftedRobot, *, is_decomposed: bool = False) -> DraftedGripper:
    """Draft the gripper file of the hand that an arm's own URDF has.

    Args:
        urdf: The URDF of the arm.
        project: The folder of the project, with the drafted robot.
        drafted: The arm.
        is_decomposed: True to divide concave collision meshes of the hand into convex parts.

    Raises:
        DefinitionError: The arm has no hand, or the hand is no mechanism that can be simulated.
    """
    copy = drafted.file.parent / f"{drafted.robot.id}.urdf"
    root = ET.parse(copy).getroot()  # noqa: S314 - written by this package
    joints = {
        child.get("link", ""): joint for joint in root.findall("joint") if (child := joint.find("child")) is not None
    }
    hands = [name for name in drafted.arm.hands if joints[name].get("type") == "fixed"]
    if len(hands) != 1:
        found = ", ".join(drafted.arm.hands) or "nothing"
        raise DefinitionError(
            f"{urdf.name} has no hand at {drafted.flange}: one link that is fixed to it and carries the fingers is "
            f"expected, found {found}",
            hint="name the link that carries the hand with --flange, or give the URDF of a gripper alone",
        )
    (palm,) = hands
    notes = []
    if others := [name for name in drafted.arm.hands if name != palm]:
        rationale = f"{', '.join(others)} of the URDF, beside the palm, {'are' if len(others) > 1 else 'is'} left out."
        notes.append(Note(about="description", rationale=rationale))
    if is_decomposed:
        notes += decompose(root, copy.parent, only=carried_by(root, [palm]))
        copy.write_text(ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    mount = Pose() if drafted.arm.flange == drafted.flange else origin_of(joints[drafted.arm.flange])
    pose = origin_of(joints[palm]).relative_to(mount)
    return _drafted(
        copy, project, id_=identifier_of(palm, prefix="hand"), palm=palm, mounts=[pose], notes=notes, shown=urdf.name
    )


def drafted_gripper(
    urdf: Path, project: Path, xacro: Mapping[str, str] = NO_ARGUMENTS, *, is_decomposed: bool = False
) -> DraftedGripper:
    """Draft the gripper file of a URDF that describes a gripper alone, and copy the files that it names.

    The gripper is mounted at the base of its URDF, along the axis on which its pads are.

    Args:
        urdf: The URDF.
        project: The folder of the project.
        xacro: Arguments, if the URDF is a xacro.
        is_decomposed: True to divide concave collision meshes into convex parts.

    Raises:
        MechanismError: It is no mechanism with one driven joint.
        DefinitionError: The URDF is wrong, a file that it names is missing, or no two of its links are pads.
    """
    root, notes = read_arm_urdf(urdf, xacro)
    grippers = project / "scenes" / "grippers"
    grippers.mkdir(parents=True, exist_ok=True)
    notes += copy_named_files(root, urdf, grippers)
    id_ = identifier_of(root.get("name", ""), prefix="gripper")
    copy = grippers / f"{id_}.urdf"
    mounts = [_turned_from(axis) for axis in TOOL_AXES]
    if is_decomposed:
        # To divide a palm can take ten minutes: first the fingers, whose pads may be none all the same.
        fingers = decompose(root, grippers, only=_moved_links(root))
        _write(root, copy)
        complete_fingers(copy, None)
        _found_pads(copy, None, project, mounts, shown=urdf.name)
        notes += [*fingers, *decompose(root, grippers)]
    _write(root, copy)
    return _drafted(copy, project, id_=id_, palm=None, mounts=mounts, notes=notes, shown=urdf.name)


def _drafted(
    copy: Path,
    project: Path,
    *,
    id_: str,
    palm: str | None,
    mounts: Sequence[Pose],
    notes: Sequence[Note],
    shown: str,
) -> DraftedGripper:
    grippers = project / "scenes" / "grippers"
    grippers.mkdir(parents=True, exist_ok=True)
    notes = [*notes, *complete_fingers(copy, palm)]
    try:
        pads = _found_pads(copy, palm, project, mounts, shown=shown)
        file = grippers / f"{id_}.yaml"
        description = copy.name if copy.parent == grippers else f"../robots/{copy.name}"
        lines = [
            "# The mechanism of a gripper in its URDF: one joint is driven, the others follow it.",
            f"gripper: {id_}",
            "kind: linkage",
            f"description: {description}",
            *([] if palm is None else [f"palm: {palm}"]),
            f"pads: [{', '.join(pads.links)}]",
            *_mount_lines(pads.mount),
        ]
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        read = load_gripper_file(file, project=project)
    except DocumentError as error:
        first = error.findings[0]
        raise DefinitionError(first.message, hint=first.hint) from error
    speed_m_s, force_n = (float(read.settings[f"gripper.finger.{name}"]) for name in ("speed", "force"))
    assumed = [*notes]
    if speed_m_s > _LARGEST_SPEED_M_S:
        lines.append(f"speed: {_LARGEST_SPEED_M_S * 1e3:g} mm/s")
        rationale = f"The driven joint moves the pads at {speed_m_s:.3g} m/s; they close slower, and push no object."
        assumed.append(Note(about="speed", rationale=rationale))
    from_tip_m = grasp_from_tip_m(read.geometry)
    if from_tip_m is not None:
        lines.append(f"grasp_from_tip: {from_tip_m * 1e3:g} mm")
        rationale = (
            "Objects are held near the ends of the pads, where they have room above the table and below the links."
        )
        assumed.append(Note(about="grasp_from_tip", rationale=rationale))
    if assumed:
        lines.append("assumptions:")
        for note in assumed:
            lines += [f"  - about: {note.about}", f"    rationale: {json.dumps(note.rationale, ensure_ascii=False)}"]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    geometry = load_gripper_file(file, project=project).geometry
    return DraftedGripper(
        id=id_,
        geometry=geometry,
        force_n=_rounded_down(min(force_n, _LARGEST_FORCE_N)),
        cups=cups_of(geometry),
        notes=tuple(assumed),
    )


def _found_pads(copy: Path, palm: str | None, project: Path, mounts: Sequence[Pose], *, shown: str) -> FoundPads:
    try:
        return find_pads(copy, palm=palm, project=project, mounts=mounts)
    except DefinitionError as error:
        message = error.message.removeprefix(copy.name).lstrip()
        raise type(error)(f"{shown} {message}", hint=error.hint) from error


def _moved_links(root: ET.Element) -> set[str]:
    joints = [joint for joint in root.findall("joint") if joint.get("type") != "fixed"]
    children = [child.get("link", "") for joint in joints if (child := joint.find("child")) is not None]
    return carried_by(root, children)


def _write(root: ET.Element, copy: Path) -> None:
    ET.indent(root)
    copy.write_text(ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")


def _mount_lines(mount: Pose) -> Sequence[str]:
    """The pose of a palm, without what is zero."""
    roll, pitch, yaw = (round(math.degrees(angle), 9) + 0.0 for angle in mount.roll_pitch_yaw_rad())
    at = [round(1e3 * value, 6) + 0.0 for value in mount.position_m]
    entries = [] if not any(at) else [f"at: [{', '.join(f'{value:.9g} mm' for value in at)}]"]
    entries += [
        f"{name}: {angle:.12g} deg" for name, angle in (("roll", roll), ("pitch", pitch), ("yaw", yaw)) if angle
    ]
    return [f"mount: {{{', '.join(entries)}}}"] if entries else []


def _turned_from(axis: str) -> Pose:
    """Pose of a palm whose axis lies along the z axis of the flange."""
    roll, pitch, yaw = (float(word) for word in TOOL_AXES[axis].split())
    return Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (roll, pitch, yaw)).inverse()


def _rounded_down(value: float) -> float:
    """A number rounded down to two significant digits."""
    scale = 10.0 ** (1 - math.floor(math.log10(value)))
    return math.floor(value * scale + 1e-9) / scale
