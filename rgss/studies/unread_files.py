"""Files of a project that nothing reads: misspelt names, wrong endings, wrong folders."""

from __future__ import annotations

import difflib
import errno
import os
import re
import stat
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from rgss.documents import DATA_FOLDERS, LARGEST_FILE_BYTES, open_regular, read_document
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity, shown
from rgss.studies.project_folders import REQUIREMENT_PARTS, REQUIREMENTS, SINGLE_FILES, named_sets
from rgss.studies.schemas import document_kind

_ENDINGS = (".yaml", ".yml")
# Top-level keys by which a kind of document is recognised.
_KIND_OF_KEY: Mapping[str, str] = {
    "study": "study",
    "parameters": "design-space",
    "components": "catalogue",
    "bodies": "scene",
    "joints": "robot",
    "azimuths": "gripper",
    "excitation": "excitation",
    "steps": "task",
    "measures": "measures",
    "rules": "rules",
    "reviews": "reviews",
    "verifications": "verifications",
    "blocks": "architecture",
    "behaviours": "architecture",
}
_FOLDER_OF_KIND: Mapping[str, str] = {
    "study": "studies",
    "design-space": "designs",
    "catalogue": "designs",
    "scene": "scenes",
    "robot": "scenes",
    "gripper": "scenes",
    "task": "scenes",
    "excitation": "scenes",
}
_KINDS: Mapping[Callable[[int], bool], str] = {
    stat.S_ISDIR: "a folder",
    stat.S_ISFIFO: "a pipe",
    stat.S_ISSOCK: "a socket",
    stat.S_ISCHR: "a device",
    stat.S_ISBLK: "a device",
}
_MESH = re.compile(r"filename\s*=\s*[\"'](?:package://)?([^\"']+)[\"']")


def unread_findings(project: Path) -> tuple[Finding, ...]:
    """Files and folders of a project that look like its sources, and that nothing reads.

    A document of the right kind in the right folder that no study names is only noted.
    """
    unreadable = list(_unreadable(project))
    known = {finding.file for finding in unreadable}
    others = (*_of_requirements(project), *_of_other_folders(project), *_beside_folders(project))
    findings = [*unreadable, *(finding for finding in others if finding.file not in known)]
    return tuple(sorted(findings))


def _of_requirements(project: Path) -> Iterator[Finding]:
    default, sets = project / REQUIREMENTS, named_sets(project)
    complete = all(_data(study) is not None for study in _documents(project / "studies") if study.suffix == ".yaml")
    for path in _documents(default):
        folder = project / next((name for name in sets if path.is_relative_to(project / name)), REQUIREMENTS)
        if _is_read(folder, path):
            continue  # `rgss.requirements` reads it, or reports why not
        above = default / path.relative_to(default).parts[0]
        meant = _meant(project, folder, path)
        if folder == default and _is_set(above, path) and meant.count("/") < 2:
            if complete:  # else the study that cannot be read may well name it
                hint = f"name its folder in a study: 'requirements: {above.relative_to(project).as_posix()}'"
                yield _finding(path.relative_to(project).as_posix(), Severity.WARNING, "nothing reads this file", hint)
        else:
            yield _unread(project, path, meant)


def _is_read(folder: Path, path: Path) -> bool:
    """True if a document is one of a set of requirements, by its location."""
    first, *rest = path.relative_to(folder).parts
    is_part = first in REQUIREMENT_PARTS and bool(rest) and (folder / first).is_dir()
    return is_part or (not rest and path.suffix == ".yaml" and path.stem in (*REQUIREMENT_PARTS, *SINGLE_FILES))


def _is_set(above: Path, path: Path) -> bool:
    """True if a document lies in a folder that would be a set of requirements if a study named it."""
    return above.is_dir() and above != path and above.name not in REQUIREMENT_PARTS and _is_read(above, path)


def _meant(project: Path, folder: Path, path: Path) -> str:
    """The name that a file of requirements should have; empty if that is anybody's guess."""
    place = folder.relative_to(project).as_posix()
    within = path.relative_to(folder)
    first = within.parts[0] if len(within.parts) > 1 else _stem(within.name)
    near = difflib.get_close_matches(first.lower(), (*REQUIREMENT_PARTS, *SINGLE_FILES), n=1, cutoff=0.6)
    name = near[0] if near else ""
    if not name:
        kind = _kind(path)
        if kind in _FOLDER_OF_KIND:
            return f"{_FOLDER_OF_KIND[kind]}/{_stem(path.name)}.yaml"
        name = kind
    if not name:
        return ""
    if name in REQUIREMENT_PARTS and (folder / name).is_dir():
        return f"{place}/{name}/{_stem(within.name)}.yaml"
    return f"{place}/{name}.yaml"


def _of_other_folders(project: Path) -> Iterator[Finding]:
    named, complete = _named(project)
    for folder in DATA_FOLDERS:
        if folder == REQUIREMENTS:
            continue
        for path in _documents(project / folder):
            kind = _kind(path)
            home = _FOLDER_OF_KIND.get(kind, REQUIREMENTS if kind else "")
            if path.resolve() in named or (folder == "studies" == home and path.suffix == ".yaml"):
                continue
            if path.suffix == ".yaml" and _data(path) is None:
                continue  # of unknown kind; its reader reports what is wrong with it
            if home == folder and path.suffix == ".yaml":
                if not complete:
                    continue  # what cannot be read may well name it
                label = path.relative_to(project).as_posix()
                yield _finding(label, Severity.INFO, f"is a {kind} that no study names", "name it in a study")
            elif home == folder:
                yield _unread(project, path, f"{folder}/{_stem(path.name)}.yaml")
            elif home == REQUIREMENTS:
                yield _unread(project, path, f"{REQUIREMENTS}/{kind}.yaml")
            else:
                yield _unread(project, path, f"{home}/{_stem(path.name)}.yaml" if home else "")


def _unreadable(project: Path) -> Iterator[Finding]:
    """Paths named like a document without readable content: a device, a pipe, a link to nothing."""
    for folder in DATA_FOLDERS:
        for path in sorted(_named_as_documents(project / folder)):
            what = _irregularity(path) or _unopened(path)
            if what:
                label = path.relative_to(project).as_posix()
                hint = "put a YAML file in its place, or remove it"
                yield _finding(label, Severity.WARNING, f"nothing reads this: {what}", hint)


def _irregularity(path: Path) -> str:
    """Kind of a path that is not a file; empty for a file."""
    try:
        mode = path.stat().st_mode
    except OSError as error:
        if path.is_symlink() and error.errno in (errno.ENOENT, errno.ELOOP):
            return "it is a link to what is not there" if error.errno == errno.ENOENT else "it is a circle of links"
        return f"it cannot be read: {error.strerror}"
    return next((f"it is {name}, not a file" for kind, name in _KINDS.items() if kind(mode)), "")


def _unopened(path: Path) -> str:
    """Reason that the content of a file cannot be read; empty if it can."""
    try:
        with open_regular(path) as file:
            too_large = os.fstat(file.fileno()).st_size > LARGEST_FILE_BYTES
    except OSError as error:
        return f"it cannot be read: {error.strerror}"
    return f"it is larger than the {LARGEST_FILE_BYTES // 1024**2} MiB that are read" if too_large else ""


def _beside_folders(project: Path) -> Iterator[Finding]:
    """Folders whose names are nearly those of the project's, and documents that lie beside the folders."""
    try:
        beside = sorted(path for path in project.iterdir() if not path.name.startswith("."))
    except OSError:
        return
    for path in beside:
        if path.is_dir() and path.name not in DATA_FOLDERS:
            near = difflib.get_close_matches(path.name.lower(), DATA_FOLDERS, n=1, cutoff=0.8)
            first = next(iter(_documents(path)), None) if near else None
            if first is not None:
                yield _unread(project, first, f"{near[0]}/{first.relative_to(path).as_posix()}")
        elif path.suffix.lower() in _ENDINGS and path.stem.lower() in (*REQUIREMENT_PARTS, *SINGLE_FILES):
            yield _unread(project, path, f"{REQUIREMENTS}/{path.stem.lower()}.yaml")


def _documents(folder: Path) -> Iterator[Path]:
    """Paths that look like a document: by their ending, in any capitals, or with another one behind it."""
    yield from sorted(path for path in _named_as_documents(folder) if path.is_file())


def _named_as_documents(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*"):
        name = path.name.lower()
        if not name.startswith(".") and name.endswith((*_ENDINGS, ".yaml.txt", ".yml.txt")):
            yield path


def _stem(name: str) -> str:
    return re.split(r"\.ya?ml", name, maxsplit=1, flags=re.IGNORECASE)[0]


def _kind(path: Path) -> str:
    """The kind of a document by its content; empty if it has none."""
    data = _data(path)
    keys = data if isinstance(data, dict) else {}
    kind = next((kind for key, kind in _KIND_OF_KEY.items() if key in keys), "")
    if not kind and isinstance(listed := keys.get("requirements"), list):
        entries = [each for each in listed if isinstance(each, dict)]
        kind = "system" if any("group" in each for each in entries) else "stakeholder" if entries else ""
    return kind


def _named(project: Path) -> tuple[set[Path], bool]:
    """Every file that the studies name, and those that these name in turn; and whether all could be read."""
    pending = [path for path in _documents(project / "studies") if path.suffix == ".yaml"]
    named: set[Path] = set()
    complete = True
    while pending:
        path = pending.pop()
        complete = complete and (path.suffix.lower() not in _ENDINGS or _data(path) is not None)
        for text in _texts_of(path):
            for base in (project, path.parent):
                target = _file(base, text)
                if target is not None and target not in named:
                    named.add(target)
                    pending.append(target)
    return named, complete


def _texts_of(path: Path) -> Iterator[str]:
    if path.suffix.lower() in _ENDINGS:
        yield from _strings(_data(path))
    elif path.suffix.lower() in (".urdf", ".xacro"):
        try:
            if path.stat().st_size <= LARGEST_FILE_BYTES:
                yield from _MESH.findall(path.read_text(encoding="utf-8", errors="replace"))
        except OSError:
            return


def _file(base: Path, text: str) -> Path | None:
    # A name of a file is one short line; anything else is prose.
    if not text or len(text) > 255 or "\n" in text or not PurePosixPath(text).suffix:
        return None
    try:
        target = (base / text).resolve()
        return target if target.is_file() else None
    except (OSError, ValueError):
        return None


def _data(path: Path) -> Any:
    try:
        return read_document(path, label=path.name).data
    except DocumentError:
        return None


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, (dict, list)):
        for each in value.values() if isinstance(value, dict) else value:
            yield from _strings(each)


def _unread(project: Path, path: Path, meant: str) -> Finding:
    label = path.relative_to(project).as_posix()
    hint = f"is it meant to be {shown(meant)}?" if meant else _places(label)
    return _finding(label, Severity.WARNING, "nothing reads this file", hint)


def _places(label: str) -> str:
    if label.startswith(f"{REQUIREMENTS}/"):
        parts = ", ".join(document_kind(name).id for name in (*REQUIREMENT_PARTS, *SINGLE_FILES))
        return f"{REQUIREMENTS}/ has {parts}, each with the ending .yaml"
    return "name it in a study, or remove it"


def _finding(label: str, severity: Severity, message: str, hint: str) -> Finding:
    return Finding(file=label, line=1, column=1, rule="document.unread", severity=severity, message=message, hint=hint)
