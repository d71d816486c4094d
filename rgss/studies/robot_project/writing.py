"""Writing of a new project round an arm."""

from __future__ import annotations

import re
import shutil
import tempfile
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path, PurePosixPath

from rgss.documents import content_digest
from rgss.errors import DefinitionError
from rgss.scenes import Pose, load_gripper, load_robot
from rgss.studies.robot_project.arm_of_urdf import UrdfArm, arm_of_urdf
from rgss.studies.robot_project.fitting import fitted, payload_at_reach_kg
from rgss.studies.robot_project.layout import scene_text
from rgss.studies.robot_project.robot_text import robot_text
from rgss.studies.scaffolding import scaffold_texts
from rgss.studies.schema_headers import cannot_write

_PACKAGE = "package://"
_LARGEST_URDF_BYTES = 1024 * 1024
_LARGEST_MESH_BYTES = 256 * 1024 * 1024


def write_robot_project(urdf: Path, folder: Path, *, flange: str | None = None) -> tuple[str, ...]:
    """Write a new project round the arm of a URDF into a folder, which is made if it is not there.

    The URDF and the meshes that it names are copied. The robot file has the URDF's limits; the tables are scaled to
    the arm's reach.

    Args:
        urdf: The URDF.
        folder: The folder; nothing in it is overwritten.
        flange: The link that carries the gripper; found where None.

    Returns:
        The names of the files that were written, relative to the folder.

    Raises:
        DefinitionError: The URDF has no arm that the task can be fitted to, or a file is there already.
        DocumentError: The description is wrong.
    """
    text, root = _read(urdf)
    arm = arm_of_urdf(root, flange=flange)
    with tempfile.TemporaryDirectory() as scratch:
        project = Path(scratch) / "project"
        _write_files(project, urdf, text, root, arm)
        names = tuple(sorted(path.relative_to(project).as_posix() for path in project.rglob("*") if path.is_file()))
        try:
            for name in names:
                if (folder / name).exists() or (folder / name).is_symlink():
                    raise DefinitionError(
                        f"{folder / name} is there already, and nothing is overwritten", hint="name a new folder"
                    )
            for name in names:
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(project / name, folder / name)
        except (OSError, ValueError) as error:
            raise cannot_write(folder, error) from error
    return names


def _write_files(project: Path, urdf: Path, source: str, root: ET.Element, arm: UrdfArm) -> None:
    id_ = _identifier(arm.name)
    robots = project / "scenes" / "robots"
    texts = scaffold_texts()
    (old,) = (PurePosixPath(name).stem for name in texts if re.fullmatch(r"scenes/robots/[^/]+\.yaml", name))
    for name, content in texts.items():
        if name.startswith("scenes/robots/") or name == "scenes/kitchen.yaml":
            continue
        path = project / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(_renamed(content, old, id_, arm.name), encoding="utf-8", newline="\n")
    robots.mkdir(parents=True, exist_ok=True)
    (robots / f"{id_}.urdf").write_text(_with_copied_files(source, root, urdf, robots), encoding="utf-8")
    start = tuple(min(max(0.5 * (joint.lower + joint.upper), joint.lower), joint.upper) for joint in arm.joints)
    robot_file = robots / f"{id_}.yaml"
    robot_file.write_text(robot_text(arm, id_=id_, urdf=f"{id_}.urdf", home=start, payload_kg=1.0), encoding="utf-8")
    robot = load_robot(robot_file, base=Pose(), label=f"scenes/robots/{id_}.yaml", project=project)
    geometries = [load_gripper(path) for path in sorted((project / "scenes" / "grippers").glob("*.yaml"))]
    cell = fitted(project, robot, f"{id_}.yaml", geometries)
    payload_kg = payload_at_reach_kg(robot)
    ranges = zip(arm.joints, cell.lower, cell.upper, strict=True)
    narrowed = replace(arm, joints=tuple(replace(joint, lower=low, upper=high) for joint, low, high in ranges))
    text = robot_text(narrowed, id_=id_, urdf=f"{id_}.urdf", home=cell.home, payload_kg=payload_kg)
    robot_file.write_text(text, encoding="utf-8")
    (project / "scenes" / "kitchen.yaml").write_text(scene_text(cell.layout, robot=f"{id_}.yaml"), encoding="utf-8")


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
        raise DefinitionError(f"{urdf} is no URDF: it has no robot with links", hint=hint)
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


def _renamed(text: str, old: str, id_: str, name: str) -> str:
    """A file of the scaffold with the arm's name in the place of the scaffold's."""
    text = text.replace(f"scenes/robots/{old}.yaml", f"scenes/robots/{id_}.yaml")
    component = rf"id: {re.escape(old)}\n( *)role: manipulator\n *name: .*\n *manufacturer: .*\n"
    return re.sub(component, lambda found: _component(found[1], id_, name), text)


def _component(indent: str, id_: str, name: str) -> str:
    lines = ("role: manipulator", f"name: {name}", "manufacturer: not stated")
    return f"id: {id_}\n" + "".join(f"{indent}{line}\n" for line in lines)
