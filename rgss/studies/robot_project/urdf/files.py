"""Copies of the files that a URDF names, found as robot packages lay them out."""

from __future__ import annotations

import re
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from rgss.documents import content_digest
from rgss.errors import DefinitionError
from rgss.scenes import is_empty_mesh
from rgss.studies.robot_project.urdf.packages import FOLDERS_UP, package_folders
from rgss.studies.robot_project.urdf.reading import Note

_SCHEME = re.compile(r"^(package|model|file)://")
_LARGEST_MESH_BYTES = 256 * 1024 * 1024
_LARGEST_EMPTY_MESH_BYTES = 4096
_READ = frozenset({".stl", ".obj", ".dae", ".ply"})


def copy_named_files(root: ET.Element, urdf: Path, robots: Path) -> list[Note]:
    """Copy the files that a URDF names beside its copy, and give their names as they are there.

    What is only looked at, a visual mesh or a texture, takes part in no simulation: it is left out where it is missing.

    Args:
        root: The URDF; it is changed.
        urdf: Its file.
        robots: The folder of the copy.

    Returns:
        What was assumed.

    Raises:
        DefinitionError: A collision mesh is missing, too large, or not a mesh.
    """
    notes = [*_leave_out_missing_looks(root, urdf), *_leave_out_empty_meshes(root, urdf)]
    _drop_undefined_materials(root)
    for element in (one for tag in ("mesh", "texture") for one in root.iter(tag)):
        name = element.get("filename", "").strip()
        source = find_named_file(name, urdf)
        if source is None:
            raise DefinitionError(
                f"the file {name} of {urdf.name} is not there",
                hint="put it where the URDF names it, relative to the URDF or in a folder of the package's name above",
            )
        if content_digest(source, largest_bytes=_LARGEST_MESH_BYTES) is None:
            raise DefinitionError(
                f"the file {name} is larger than {_LARGEST_MESH_BYTES // 1024**2} MiB", hint="simplify it"
            )
        rest = PurePosixPath(_SCHEME.sub("", name).replace("\\", "/"))
        inside = not rest.is_absolute() and ".." not in rest.parts
        kept = rest if inside else PurePosixPath("meshes") / rest.name
        (robots / kept).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, robots / kept)
        element.set("filename", kept.as_posix())
    return notes


def find_named_file(name: str, urdf: Path) -> Path | None:
    """The file that a name means, seen from a URDF; None where it is not there.

    A package is a folder above the URDF, or in such a folder, that has its name or a package file that states it. Where
    there is none, the package is taken to be the one that the URDF is in, as with copies under another name.

    Args:
        name: The name: a path relative to the URDF, or one with ``package://``, ``model://`` or ``file://``.
        urdf: The URDF.
    """
    rest = _SCHEME.sub("", name.strip()).replace("\\", "/")
    if not rest:
        return None
    scheme = name.strip().partition("://")[0]
    candidates = [urdf.parent / rest] if scheme not in ("package", "model") else _in_package(rest, urdf.resolve())
    return next((found for path in candidates if (found := _file(path)) is not None), None)


def _in_package(rest: str, urdf: Path) -> Iterator[Path]:
    package, _, below = rest.partition("/")
    yield from (folder / below for folder in package_folders(package, urdf))
    # The package goes by another name here: what follows its name, or a part of that, is looked for above the URDF.
    parts = PurePosixPath(rest).parts
    for folder in list(urdf.parents)[:FOLDERS_UP]:
        for skipped in range(len(parts) - 1):
            yield folder / PurePosixPath(*parts[skipped:])


def _file(path: Path) -> Path | None:
    """A file, also where the case of its name differs, as on the systems of some who wrote URDFs."""
    try:
        if path.is_file():
            return path
        return next((one for one in path.parent.iterdir() if one.name.lower() == path.name.lower()), None)
    except OSError:
        return None


def _leave_out_missing_looks(root: ET.Element, urdf: Path) -> Iterator[Note]:
    gone = []
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            mesh = visual.find("geometry/mesh")
            name = "" if mesh is None else mesh.get("filename", "")
            if mesh is not None and find_named_file(name, urdf) is None:
                link.remove(visual)
                gone.append(name)
    for material in root.iter("material"):
        for texture in material.findall("texture"):
            name = texture.get("filename", "")
            if find_named_file(name, urdf) is None:
                material.remove(texture)
                gone.append(name)
    if gone:
        yield Note(
            about="description",
            rationale=f"{len(gone)} visual meshes and textures are not there and left out, {gone[0] or 'nameless'} the"
            " first; they take part in no simulation.",
        )


def _leave_out_empty_meshes(root: ET.Element, urdf: Path) -> Iterator[Note]:
    """Remove meshes without a face, and visual meshes that are not what their names say.

    Raises:
        DefinitionError: A collision mesh is not a mesh.
    """
    empty, broken = [], []
    for link in root.findall("link"):
        for shape in link.findall("visual") + link.findall("collision"):
            mesh = shape.find("geometry/mesh")
            source = None if mesh is None else find_named_file(mesh.get("filename", ""), urdf)
            if (
                source is None
                or source.suffix.lower() not in _READ
                or source.stat().st_size > _LARGEST_EMPTY_MESH_BYTES
            ):
                continue
            try:
                if is_empty_mesh(source):
                    link.remove(shape)
                    empty.append(link.get("name", ""))
            except DefinitionError as error:
                if shape.tag == "collision":
                    raise
                link.remove(shape)
                broken.append(error.message)
    if empty:
        names = ", ".join(dict.fromkeys(empty))
        yield Note(about="description", rationale=f"Meshes without a single face are left out, of {names}.")
    if broken:
        rationale = f"{len(broken)} visual meshes are left out: {broken[0]}; they take part in no simulation."
        yield Note(about="description", rationale=rationale)


def _drop_undefined_materials(root: ET.Element) -> None:
    """Remove colours without numbers and materials without a definition, of which parsers report each."""
    for material in root.iter("material"):
        for colour in material.findall("color"):
            if not colour.get("rgba", "").strip():
                material.remove(colour)
    for material in root.findall("material"):
        if len(material) == 0:
            root.remove(material)
    defined = {material.get("name") for material in root.iter("material") if len(material)}
    for visual in root.iter("visual"):
        for material in visual.findall("material"):
            if len(material) == 0 and material.get("name") not in defined:
                visual.remove(material)
