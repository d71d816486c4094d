"""A robot file drafted from a URDF, with copies of the files that the URDF names."""

from __future__ import annotations

import re
import shutil
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from rgss.documents import content_digest
from rgss.errors import DefinitionError
from rgss.scenes import Pose, Robot, load_robot
from rgss.studies.robot_project.arm_of_urdf import UrdfArm, arm_of_urdf
from rgss.studies.robot_project.robot_text import robot_text

_PACKAGE = "package://"
_LARGEST_URDF_BYTES = 1024 * 1024
_LARGEST_MESH_BYTES = 256 * 1024 * 1024
_DRAFT_PAYLOAD_KG = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DraftedRobot:
    """A robot with the limits of its URDF.

    Attributes:
        arm: The arm in the URDF.
        robot: The robot.
        file: The robot file.
    """

    arm: UrdfArm
    robot: Robot
    file: Path


def drafted_robot(urdf: Path, project: Path, *, flange: str | None = None) -> DraftedRobot:
    """Draft a robot file from a URDF, at home in the middle of its ranges.

    Args:
        urdf: The URDF.
        project: The folder in whose ``scenes/robots`` the files are put.
        flange: The link that carries the gripper; found if None.

    Raises:
        DefinitionError: There is no arm in the URDF, or a file that it names is missing.
        DocumentError: The description is wrong.
    """
    text, root = _read(urdf)
    arm = arm_of_urdf(root, flange=flange)
    id_ = _identifier(arm.name)
    robots = project / "scenes" / "robots"
    robots.mkdir(parents=True, exist_ok=True)
    (robots / f"{id_}.urdf").write_text(_with_copied_files(text, root, urdf, robots), encoding="utf-8")
    home = tuple(0.5 * (joint.lower + joint.upper) for joint in arm.joints)
    file = robots / f"{id_}.yaml"
    draft = robot_text(arm, id_=id_, urdf=f"{id_}.urdf", home=home, payload_kg=_DRAFT_PAYLOAD_KG)
    file.write_text(draft, encoding="utf-8")
    robot = load_robot(file, base=Pose(), label=f"scenes/robots/{id_}.yaml", project=project)
    return DraftedRobot(arm=arm, robot=robot, file=file)


def _read(urdf: Path) -> tuple[str, ET.Element]:
    hint = "name a URDF; a xacro is expanded with the tool of that name first"
    try:
        content = urdf.read_bytes()[: _LARGEST_URDF_BYTES + 1]
        text = content.decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise DefinitionError(f"{urdf} cannot be read: {error}", hint=hint) from error
    if len(content) > _LARGEST_URDF_BYTES or "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise DefinitionError(f"{urdf} is larger than 1 MiB or declares a document type", hint=hint)
    try:
        root = ET.fromstring(text)  # noqa: S314 - entities and document types are refused above
    except ET.ParseError as error:
        raise DefinitionError(f"{urdf} is not XML: {error}", hint=hint) from error
    if root.tag != "robot" or root.find("link") is None:
        raise DefinitionError(f"{urdf} is not a URDF: it has no robot with links", hint=hint)
    return text, root


def _with_copied_files(text: str, root: ET.Element, urdf: Path, robots: Path) -> str:
    """Copy the files that a URDF names beside it, and give their names as they are there."""
    names = {one.get("filename", "") for tag in ("mesh", "texture") for one in root.iter(tag)}
    for name in sorted(names - {""}):
        source = _source(name, urdf)
        if source is None:
            raise DefinitionError(
                f"the file {name} of {urdf.name} is not there",
                hint="put it where the URDF names it, relative to the URDF or in a folder of the package's name above",
            )
        if content_digest(source, largest_bytes=_LARGEST_MESH_BYTES) is None:
            raise DefinitionError(
                f"the file {name} is larger than {_LARGEST_MESH_BYTES // 1024**2} MiB", hint="simplify it"
            )
        rest = PurePosixPath(name.removeprefix("file://").removeprefix(_PACKAGE))
        inside = not rest.is_absolute() and ".." not in rest.parts
        kept = rest if inside else PurePosixPath("meshes") / rest.name
        (robots / kept).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, robots / kept)
        text = text.replace(f'"{name}"', f'"{kept}"').replace(f"'{name}'", f'"{kept}"')
    return text


def _source(name: str, urdf: Path) -> Path | None:
    """The file that a name means, seen from a URDF."""
    rest = name.removeprefix("file://")
    if not name.startswith(_PACKAGE):
        found = urdf.parent / rest
        return found if found.is_file() else None
    package, _, below = name.removeprefix(_PACKAGE).partition("/")
    for folder in urdf.resolve().parents:
        for candidate in ((folder / below,) if folder.name == package else ()) + (folder / package / below,):
            if candidate.is_file():
                return candidate
    return None


def _identifier(name: str) -> str:
    found = re.sub(r"[^A-Za-z0-9_.-]+", "_", name).strip("_.-").lower()
    return found if found[:1].isalpha() else f"arm_{found}"
