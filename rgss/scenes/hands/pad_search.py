"""Search for the pads of a gripper in its URDF: the two links that close on an object along the tool axis."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rgss.errors import DefinitionError
from rgss.scenes.document import CollisionShapes
from rgss.scenes.hands.finger_azimuths import finger_azimuths_deg
from rgss.scenes.hands.linkage_document import LinkageGripperDocument
from rgss.scenes.hands.linkage_gripper import driven_range
from rgss.scenes.hands.linkage_pads import PadError, linkage_of, without_pads
from rgss.scenes.hands.linkage_urdf import links_of, mechanism_problems, palm_of, prune
from rgss.scenes.linkage import Linkage
from rgss.scenes.pose import Pose
from rgss.scenes.urdf_file import UrdfError, number_problems, parse_urdf
from rgss.scenes.urdf_meshes import embed_collision_meshes, files_of

_PADS = 2
_SAME_OPENING_M = 1.0e-3
_BEFORE_M = 1.0e-5


class MechanismError(DefinitionError):
    """A URDF that is no mechanism with one driven joint, whatever the shapes of its links."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundPads:
    """Pads of a gripper.

    Attributes:
        links: The two links.
        mount: Pose of the palm at the flange, one of those that were tried.
    """

    links: tuple[str, str]
    mount: Pose


def find_pads(urdf: Path, *, palm: str | None, project: Path, mounts: Sequence[Pose]) -> FoundPads:
    """Find the pads of a gripper: of the mounts, the one with the pads farthest from the flange.

    Of several pairs of links that close on the tool axis, the pair with the least opening touches an object first; of
    equal ones (such as a finger and its tip), the pair with the largest faces is taken, but no face behind another of
    the same fingers.

    Args:
        urdf: The URDF.
        palm: Its link at the flange; the base of the URDF if None.
        project: The folder that contains all files that it names.
        mounts: Poses of the palm at the flange to try.

    Raises:
        MechanismError: The URDF is not a mechanism with one driven joint.
        DefinitionError: No two of its links close on an object.
    """
    root, name = _mechanism(urdf, palm, project)
    reached: list[tuple[float, Pose, list[Linkage]]] = []
    problems: list[PadError] = []
    for mount in mounts:
        found = list(_closing_pairs(root, name, mount, problems))
        if found:
            reached.append((max(_depth_m(linkage) for linkage in found), mount, found))
    if not reached:
        _refuse_several_fingers(root, name, mounts, urdf.name)
        message, hint = "has no two links that close on an object", "a pad is a link with a flat face"
        if problems:
            # Links are in topological order: the last pair is that of the fingertips. About another axis than that of
            # the tool, no pair approaches.
            nearest = [problem for problem in problems if problem.approach] or problems
            message, _, hint = nearest[-1].problem
        raise DefinitionError(f"{urdf.name} {message}", hint=hint)
    _, mount, found = max(reached, key=lambda one: one[0])
    least_m = min(linkage.opening_m(linkage.opened) for linkage in found)
    inner = [linkage for linkage in found if linkage.opening_m(linkage.opened) < least_m + _SAME_OPENING_M]
    foremost = [one for one in inner if not any(_is_before(other, one) for other in inner)]
    one, other = max(foremost, key=_face_m2).pads
    return FoundPads(links=(inner[0].links[one.link].name, inner[0].links[other.link].name), mount=mount)


def _refuse_several_fingers(root: ET.Element, palm: str, mounts: Sequence[Pose], shown: str) -> None:
    """Refuse a mechanism of three or more fingers that slide towards an axis, as it has no pair of pads.

    Raises:
        DefinitionError: It is one; with its azimuths as `kind: fingers` has them.
    """
    azimuths: tuple[int, ...] = ()
    for mount in mounts:
        links = links_of(root, palm, mount)
        found = finger_azimuths_deg(without_pads(links, driven_range(root, links)))
        azimuths = max(azimuths, found, key=len)
    if len(azimuths) > _PADS:
        listed = ", ".join(f"{azimuth} deg" for azimuth in azimuths)
        raise DefinitionError(
            f"{shown} has {len(azimuths)} fingers that slide towards its axis, and a linkage has two pads that face "
            "each other",
            hint=f"state it by its sizes in a gripper file (kind: fingers, azimuths: [{listed}])",
        )


def _mechanism(urdf: Path, palm: str | None, project: Path) -> tuple[ET.Element, str]:
    """Palm and descendants of a URDF with convex collision shapes, and the name of the palm.

    Raises:
        MechanismError: It is not a mechanism with one driven joint.
    """
    try:
        _, root = parse_urdf(urdf)
    except UrdfError as error:
        raise MechanismError(f"{urdf.name} {error.problem}", hint=error.hint) from None
    entry = LinkageGripperDocument(
        gripper="gripper", kind="linkage", description=urdf.name, palm=palm, pads=("one", "other")
    )
    name = palm_of(root, entry)
    if not name:
        raise MechanismError(f"{urdf.name} has a joint that carries its palm", hint="a gripper begins at its palm")
    prune(root, name)
    shaped = [link.get("name", "") for link in root.findall("link") if link.find("collision") is not None]
    if len(shaped) < _PADS:
        raise MechanismError(
            f"{urdf.name} has no two links with a collision shape below {name!r}",
            hint="a gripper has two fingers with collision shapes",
        )
    entry = entry.model_copy(update={"pads": tuple(shaped[-_PADS:])})
    problems = [(problem, hint) for problem, _, hint in (*number_problems(root), *mechanism_problems(root, entry))]
    named = files_of(ET.tostring(root, encoding="unicode"), urdf, project=project, label=urdf.name)
    problems += [(finding.message, finding.hint) for finding in named.findings]
    if not problems:
        problems += embed_collision_meshes(root, named, CollisionShapes.HULL)
    if problems:
        problem, hint = problems[0]
        raise MechanismError(f"{urdf.name} {problem}", hint=hint)
    return root, name


def _closing_pairs(root: ET.Element, palm: str, mount: Pose, problems: list[PadError]) -> Iterator[Linkage]:
    """Mechanism with each pair of pads that closes on an object beyond the flange; the problems of other pairs."""
    links = links_of(root, palm, mount)
    driven = driven_range(root, links)
    moved = [index for index, link in enumerate(links) if link.hulls_m and index > 0]
    for one, other in itertools.combinations(moved, _PADS):
        try:
            linkage = linkage_of(links, (one, other), driven)
        except PadError as error:
            problems.append(error)
            continue
        if _depth_m(linkage) > 0.0:
            yield linkage


def _is_before(one: Linkage, other: Linkage) -> bool:
    """True if the pads of a pair are before those of another pair that is fixed relative to them."""
    closer_m = other.opening_m(other.opened) - one.opening_m(one.opened)
    return one.finger_parts == other.finger_parts and closer_m > _BEFORE_M


def _depth_m(linkage: Linkage) -> float:
    return linkage.depth_m((linkage.opened + linkage.closed) / 2)


def _face_m2(linkage: Linkage) -> float:
    return min(pad.size_m[1] * pad.size_m[2] for pad in linkage.pads)
