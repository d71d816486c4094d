"""Meshes and textures of a URDF, resolved inside the project and digested by content.

The content of a mesh is an input of every trial. A collision mesh is simulated as convex shapes; a visual mesh is not
simulated.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from xml.parsers import expat

from rgss.documents import FilePlace, content_digest, place_of
from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity, shown
from rgss.scenes.convex_shapes import convex_element
from rgss.scenes.document import CollisionShapes
from rgss.scenes.mesh_shapes import shapes_of_mesh
from rgss.scenes.robot import RobotFile

LARGEST_MESH_BYTES = 256 * 1024 * 1024

_PACKAGE = "package://"
_NAMING = ("mesh", "texture")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Named:
    """Element that references a file.

    Attributes:
        tag: ``mesh`` or ``texture``.
        name: The file's name as the URDF has it; None if the element has none.
        line: Line of the element, from 1.
        column: Column of the element, from 1.
    """

    tag: str
    name: str | None
    line: int
    column: int


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedFiles:
    """Files referenced by a URDF.

    Attributes:
        files: The files with their digests, in the order of the names.
        paths: Path of each file by name.
        findings: Every problem found.
    """

    files: tuple[RobotFile, ...]
    paths: Mapping[str, Path]
    findings: tuple[Finding, ...]


def files_of(text: str, path: Path, *, project: Path, label: str) -> NamedFiles:
    """Resolve and digest the files referenced by a URDF.

    Args:
        text: The URDF, which is well-formed.
        path: Its file; references are relative to its folder.
        project: The folder that must contain all referenced files.
        label: The URDF's name in messages.

    """
    found: dict[str, RobotFile] = {}
    paths: dict[str, Path] = {}
    findings: list[Finding] = []
    for named in _named_files(text):

        def report(problem: str, hint: str, place: _Named = named) -> None:
            findings.append(
                Finding(
                    file=label,
                    line=place.line,
                    column=place.column,
                    rule="scene.mesh",
                    severity=Severity.ERROR,
                    message=problem,
                    hint=hint,
                )
            )

        if not named.name:
            report(f"<{named.tag}> names no file", 'write filename="..."')
            continue
        what = f"the {named.tag} {shown(named.name)}"
        target, problem, hint = _target(named.name, path, project)
        if target is None:
            report(f"{what} {problem}", hint)
            continue
        try:
            digest = content_digest(target, largest_bytes=LARGEST_MESH_BYTES)
        except OSError as error:
            report(f"{what} cannot be read: {error.strerror}", "")
            continue
        if digest is None:
            report(f"{what} is larger than {LARGEST_MESH_BYTES // 1024**2} MiB", "simplify it")
            continue
        found[named.name] = RobotFile(name=named.name, sha256=digest)
        paths[named.name] = target
    files = tuple(found[name] for name in sorted(found))
    return NamedFiles(files=files, paths=paths, findings=tuple(findings))


def embed_collision_meshes(root: ET.Element, named: NamedFiles, how: CollisionShapes) -> Iterable[tuple[str, str]]:
    """Replace collision meshes by convex shapes.

    Args:
        root: The URDF; modified in place.
        named: The referenced files, all of them found.
        how: Kind of the convex approximation.

    Yields:
        Problem of a mesh, and a hint.
    """
    digests = {file.name: file.sha256 for file in named.files}
    for link in root.findall("link"):
        for collision in link.findall("collision"):
            mesh = collision.find("geometry/mesh")
            if mesh is None:
                continue
            name = mesh.get("filename", "")
            x, y, z = (float(word) for word in mesh.get("scale", "1 1 1").split())
            try:
                shapes = shapes_of_mesh(named.paths[name], sha256=digests[name], scale=(x, y, z), how=how)
            except DefinitionError as error:
                yield f"the collision mesh {shown(name)} of {shown(link.get('name', ''))}: {error.message}", error.hint
                continue
            at = list(link).index(collision)
            link.remove(collision)
            for vertices in reversed(shapes):
                shape = copy.deepcopy(collision)
                geometry = shape.find("geometry")
                if geometry is not None:
                    geometry.clear()
                    geometry.append(convex_element(vertices))
                link.insert(at, shape)


def without_meshes(text: str) -> str:
    """URDF in which the visual meshes of each link are replaced by its collision shapes.

    Args:
        text: The URDF; returned unchanged if no visual shape is a mesh.
    """
    root = ET.fromstring(text)  # noqa: S314 - entities and document types were refused on reading
    changed = False
    for link in root.findall("link"):
        meshes = [visual for visual in link.findall("visual") if visual.find("geometry/mesh") is not None]
        for visual in meshes:
            link.remove(visual)
            changed = True
        if meshes and link.find("visual") is None:
            for collision in link.findall("collision"):
                seen = copy.deepcopy(collision)
                seen.tag = "visual"
                link.append(seen)
    return ET.tostring(root, encoding="unicode") if changed else text


def _named_files(text: str) -> Iterable[_Named]:
    """Elements of a URDF that reference a file, with their positions, which ElementTree does not store."""
    found: list[_Named] = []
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        if tag in _NAMING:
            found.append(
                _Named(
                    tag=tag,
                    name=attributes.get("filename"),
                    line=parser.CurrentLineNumber,
                    column=parser.CurrentColumnNumber + 1,
                )
            )

    parser.StartElementHandler = start
    parser.Parse(text.encode("utf-8"))
    return found


def _target(name: str, path: Path, project: Path) -> tuple[Path | None, str, str]:
    """File of a reference, or None with the problem and its hint."""
    hint = "name it relative to the URDF, or as package://FOLDER/FILE with a folder of the project"
    scheme, separator, _ = name.partition("://")
    if separator and scheme != "package":
        return None, f"is named by {shown(scheme + '://')}, which is not a path inside the project", hint
    rest = name.removeprefix(_PACKAGE)
    if not separator and (PurePosixPath(rest).is_absolute() or "\\" in rest or rest[1:2] == ":"):
        return None, "is not a relative path", hint
    missing = False
    for candidate in _package_candidates(rest, path, project) if separator else (path.parent / rest,):
        place = place_of(candidate, project)
        if place is FilePlace.INSIDE:
            return candidate, "", ""
        if place is FilePlace.OUTSIDE:
            return (
                None,
                "leads out of the project",
                "copy it into the project; symbolic links to files outside are not followed",
            )
        missing = True
    return None, "is not there" if missing else "is not a path inside the project", hint


def _package_candidates(rest: str, path: Path, project: Path) -> Iterator[Path]:
    """Candidate paths of a ``package://`` name, nearest first: the folders from the URDF's up to the project's."""
    package, _, below = rest.partition("/")
    if not package or not below or package in (".", ".."):
        return
    top = project.resolve()
    folder = path.parent.resolve()
    for candidate in (folder, *folder.parents):
        if candidate.name == package:
            yield candidate / below
        yield candidate / package / below
        if candidate == top:
            return
