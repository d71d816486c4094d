"""Grippers whose mechanism is a URDF: one driven joint, mimic joints, and two pads."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from rgss.documents import Document
from rgss.errors import DocumentError
from rgss.findings import Finding, shown
from rgss.scenes.findings import Location, named_file_findings, not_positive, too_slow
from rgss.scenes.gripper import GripperDrive, GripperFile, GripperGeometry
from rgss.scenes.hands.linkage_document import LinkageGripperDocument
from rgss.scenes.hands.linkage_pads import DrivenRange, PadError, linkage_of
from rgss.scenes.hands.linkage_shape import linkage_geometry
from rgss.scenes.hands.linkage_urdf import driven_joints, links_of, mechanism_problems, palm_of, prune
from rgss.scenes.linkage import Linkage, LinkageLink, LinkageMotion, motion_of
from rgss.scenes.looks import looks_of
from rgss.scenes.pose import Pose
from rgss.scenes.shapes import Box, Cylinder
from rgss.scenes.urdf_file import UrdfError, number_problems, parse_urdf
from rgss.scenes.urdf_meshes import embed_collision_meshes, files_of

_LEAST_ON_PAD_M = 1.0e-4


class LinkageGripper:
    """The kind ``linkage``."""

    name = "linkage"
    model = LinkageGripperDocument
    document = "linkage-gripper"
    title = "Linkage gripper"
    own_key = "pads"

    def read(self, entry: LinkageGripperDocument, document: Document, *, path: Path, project: Path) -> GripperFile:
        """Gripper described by a file and its URDF.

        Args:
            entry: The content of the file.
            document: The file, for positions.
            path: The file; the URDF is relative to its folder.
            project: The folder that must contain all referenced files.

        Raises:
            DocumentError: The file or its URDF is invalid; with every problem in it.
        """
        findings = list(_own_findings(entry, document))
        findings += named_file_findings(
            document, entry.description, ("description",), folder=path.parent, project=project
        )
        if findings:
            raise DocumentError(sorted(findings))
        linkage = _read_linkage(entry, document, path=path, project=project)
        motion = motion_of(linkage)
        file = _gripper_file(entry, motion)
        findings = list(_limit_findings(entry, document, motion))
        if findings:
            raise DocumentError(sorted(findings))
        return file


def _own_findings(entry: LinkageGripperDocument, document: Document) -> Iterable[Finding]:
    optional: dict[Location, float | None] = {
        ("grasp_from_tip",): entry.grasp_from_tip,
        ("friction",): entry.friction,
        ("force",): entry.force,
        ("speed",): entry.speed,
        ("firm_grasp", "finger_force"): None if entry.firm_grasp is None else entry.firm_grasp.finger_force,
    }
    given = [(location, value) for location, value in optional.items() if value is not None]
    yield from not_positive(document, given)
    yield from too_slow(document, (item for item in given if item[0] == ("speed",)))


def _limit_findings(entry: LinkageGripperDocument, document: Document, motion: LinkageMotion) -> Iterable[Finding]:
    force_n, speed_m_s = pad_limits(motion)
    length_m = min(pad.size_m[2] for pad in motion.linkage.pads)
    if entry.grasp_from_tip is not None and entry.grasp_from_tip > length_m - _LEAST_ON_PAD_M:
        message = f"the grasp centre must lie on the pads, which are {length_m * 1e3:.4g} mm long"
        yield document.finding("scene.grasp-depth", message, ("grasp_from_tip",), hint="give less than that")
    if entry.force is not None and entry.force > force_n * (1 + 1e-9):
        message = f"the driven joint presses with {force_n:.4g} N on each pad, less than the force of {entry.force:g} N"
        yield document.finding("scene.linkage-force", message, ("force",), hint="leave 'force' out, or lower it")
    if entry.speed is not None and entry.speed > speed_m_s * (1 + 1e-9):
        message = f"the driven joint moves each pad at {speed_m_s:.4g} m/s, less than the speed of {entry.speed:g} m/s"
        yield document.finding("scene.linkage-speed", message, ("speed",), hint="leave 'speed' out, or lower it")


def pad_limits(motion: LinkageMotion) -> tuple[float, float]:
    """Force in N and speed in m/s of each pad that are available over the whole stroke.

    By virtual work the effort τ of the driven joint balances the force F of both pads, with the pad travel J per travel
    of the joint: τ = 2 J F. The force is least where J is greatest, the speed where J is least.
    """
    linkage = motion.linkage
    values = linkage.effort / (2 * motion.greatest_transmission), linkage.speed * motion.least_transmission
    # Rounding removes the noise of the tabulated kinematics.
    force_n, speed_m_s = (float(f"{value:.9g}") for value in values)
    return force_n, speed_m_s


def driven_range(root: ET.Element, links: Sequence[LinkageLink]) -> DrivenRange:
    """Driven joint of a gripper with its limits.

    Args:
        root: The gripper's part of a URDF, without problems.
        links: Its links.
    """
    (driven,) = driven_joints(root)
    joint = next(joint for joint in root.findall("joint") if joint.get("name") == driven)
    limit, child = joint.find("limit"), joint.find("child")
    values = {} if limit is None else limit.attrib
    name = "" if child is None else child.get("link", "")
    return DrivenRange(
        link=[link.name for link in links].index(name),
        lower=float(values.get("lower", "0")),
        upper=float(values.get("upper", "0")),
        effort=float(values.get("effort", "0")),
        speed=float(values.get("velocity", "0")),
    )


def _gripper_file(entry: LinkageGripperDocument, motion: LinkageMotion) -> GripperFile:
    linkage = motion.linkage
    one, other = linkage.pads
    depth, width, length = (min(a, b) for a, b in zip(one.size_m, other.size_m, strict=True))
    x, y, _ = linkage.pad_poses(linkage.opened)[0].rotate((1.0, 0.0, 0.0))
    azimuths = tuple(_azimuth(sign * x, sign * y) for sign in (1.0, -1.0))
    rough = GripperGeometry(
        id=entry.gripper,
        azimuths_rad=azimuths,
        base=Cylinder(radius_m=_palm_radius_m(linkage, width), height_m=length),
        finger=Box(size_m=(depth, width, length)),
        largest_opening_m=motion.largest_opening_m,
        stroke_m=motion.stroke_m,
        grasp_depth_m=2 * length - (length / 2 if entry.grasp_from_tip is None else entry.grasp_from_tip),
        linkage=linkage,
    )
    force_n, speed_m_s = pad_limits(motion)
    settings: dict[str, float | str] = {
        "gripper.base.mass": linkage.palm_mass_kg,
        "gripper.finger.mass": linkage.moved_mass_kg / len(linkage.pads),
        "gripper.finger.speed": entry.speed or speed_m_s,
        "gripper.finger.force": entry.force or force_n,
    }
    if entry.friction is not None:
        settings["gripper.finger.friction"] = entry.friction
    name = entry.mounting or ""
    return GripperFile(
        mountings={name: linkage_geometry(rough, linkage, motion.driven_at(motion.stroke_m / 2))},
        mounting=name,
        drive=GripperDrive(firm_force_n=None if entry.firm_grasp is None else entry.firm_grasp.finger_force),
        settings=settings,
    )


def _read_linkage(entry: LinkageGripperDocument, document: Document, *, path: Path, project: Path) -> Linkage:
    name, urdf = entry.description, path.parent / entry.description
    try:
        _, root = parse_urdf(urdf)
    except UrdfError as error:
        problem = document.finding("scene.linkage", f"{shown(name)} {error.problem}", ("description",), hint=error.hint)
        raise DocumentError([problem]) from None
    palm = palm_of(root, entry)
    problems: list[tuple[str, Location, str]] = list(number_problems(root))
    if palm in {link.get("name", "") for link in root.findall("link")}:
        prune(root, palm)
        problems += mechanism_problems(root, entry)
    else:
        problems.append((f"has no link {palm!r}", ("palm",), "name the link that the flange carries"))
    found = [
        document.finding("scene.linkage", f"{shown(name)} {problem}", location, hint=hint)
        for problem, location, hint in problems
    ]
    named = files_of(ET.tostring(root, encoding="unicode"), urdf, project=project, label=name)
    found += named.findings
    looks = looks_of(root, named.paths)
    if not found:
        found += [
            document.finding("scene.mesh", problem, ("description",), hint=hint)
            for problem, hint in embed_collision_meshes(root, named, entry.collision)
        ]
    if found:
        raise DocumentError(sorted(found))
    try:
        return replace(_linkage(root, entry, palm), looks=looks)
    except PadError as error:
        message, location, hint = error.problem
        problem = document.finding("scene.linkage", f"{shown(name)} {message}", location, hint=hint)
        raise DocumentError([problem]) from None


def _linkage(root: ET.Element, entry: LinkageGripperDocument, palm: str) -> Linkage:
    mount = Pose.from_roll_pitch_yaw(entry.mount.at, (entry.mount.roll, entry.mount.pitch, entry.mount.yaw))
    links = links_of(root, palm, mount)
    names = [link.name for link in links]
    return linkage_of(links, (names.index(entry.pads[0]), names.index(entry.pads[1])), driven_range(root, links))


def _palm_radius_m(linkage: Linkage, least_m: float) -> float:
    """Radius of the palm about the tool axis."""
    poses = linkage.link_poses(linkage.opened)
    found = [least_m]
    for index in linkage.palm_links:
        (x, y, _), hulls = poses[index].position_m, linkage.links[index].hulls_m
        turned = (poses[index].rotate(corner) for hull in hulls for corner in hull)
        found += [math.hypot(x + dx, y + dy) for dx, dy, _ in turned]
    return max(found)


def _azimuth(x: float, y: float) -> float:
    """Azimuth in the plane of the flange, rounded to remove the noise of a chain of transforms."""
    return round(math.atan2(y, x), 9) + 0.0
