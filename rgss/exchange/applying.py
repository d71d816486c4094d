"""Transactional changes of the YAML files of a project: checked, and all or none."""

from __future__ import annotations

import codecs
import errno
import os
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from rgss.documents import AppendEntry, Edit, RemoveEntry, RemoveKey, SetKey, edited, unwritable, write_output
from rgss.errors import DefinitionError
from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.comparison import ChangeKind, ElementChange
from rgss.exchange.content import part_of
from rgss.exchange.files import read_bytes
from rgss.exchange.journal import journal_of
from rgss.exchange.project_copy import copy_of_folders
from rgss.requirements import RequirementSet
from rgss.studies import REQUIREMENT_PARTS

_KEYS: Mapping[Part, str] = {
    Part.STAKEHOLDER: "requirements",
    Part.SYSTEM: "requirements",
    Part.BLOCK: "blocks",
    Part.BEHAVIOUR: "behaviours",
}
_GROUPS: Mapping[Part, str] = {
    Part.STAKEHOLDER: "kind",
    Part.SYSTEM: "group",
    Part.BLOCK: "level",
    Part.BEHAVIOUR: "kind",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class FileChange:
    """One file before and after.

    Attributes:
        name: Its name, relative to the project.
        old: Its present content.
        new: Its new content; None if the file is to be removed because it would be empty.
    """

    name: str
    old: bytes
    new: bytes | None


def planned(
    folder: Path,
    requirements: RequirementSet,
    changes: Sequence[ElementChange],
    *,
    remove: bool,
    contents: Mapping[str, bytes] | None = None,
) -> tuple[FileChange, ...]:
    """Files after the changes; nothing is written.

    A new element is inserted after the last one of its kind, in the same file. A file that loses its last element is
    removed, unless it is the last one of its folder.

    Args:
        folder: The project.
        requirements: Its present requirements.
        changes: The changes.
        remove: True to apply removals too.
        contents: The content of each file before the requirements were read from it, by its name, from `contents_of`;
            None stands for the present one.

    Raises:
        DefinitionError: There is no file for a new element, a file has changed since the requirements were read, or one
            that loses its last element is reached by a link or has another name.
        DocumentError: A file can no longer be read.
    """
    edits: dict[str, list[Edit]] = {}
    homes = _homes(requirements)
    for change in changes:
        if change.kind is ChangeKind.ADDED:
            home = _home(homes, change)
            edits.setdefault(home, []).append(AppendEntry(key=_KEYS[change.part], entry=dict(change.entry)))
            continue
        place = requirements.places[change.id]
        here = edits.setdefault(place.document.label, [])
        if change.kind is ChangeKind.CHANGED:
            here += _key_edits(requirements, change)
        elif remove:
            *around, index = place.location
            here.append(RemoveEntry(location=tuple(around), index=int(index)))
    emptied = _emptied(requirements, edits)
    for name in sorted(emptied):
        _require_one_name(folder, name)
    found = []
    for name, each in sorted(edits.items()):
        if each:
            old = _unchanged(folder, name, None if contents is None else contents.get(name))
            found.append(FileChange(name=name, old=old, new=None if name in emptied else _edited(old, each)))
    return tuple(found)


def rehearsed(
    folder: Path, files: Sequence[FileChange], check: Callable[[Path], object], *, folders: Sequence[str]
) -> None:
    """Check the changes in a copy of the project.

    Args:
        folder: The project.
        files: The changes.
        check: Function that loads the project in a folder, and raises its errors.
        folders: The folders of the project that loading needs.

    Raises:
        DefinitionError: The copy cannot be written.
    """
    with tempfile.TemporaryDirectory(prefix="rgss-import-") as name:
        copy = Path(name)
        copy_of_folders(folder, copy, folders)
        for file in files:
            if file.new is None:
                (copy / file.name).unlink()
            else:
                (copy / file.name).write_bytes(file.new)
        check(copy)


def written(folder: Path, files: Sequence[FileChange]) -> None:
    """Write the changes, within `importing`; if one file cannot be written, those before it are restored.

    What is written when the process is killed is undone by `undone`.

    Raises:
        DefinitionError: A file cannot be written, or has changed in the meantime.
    """
    for file in files:
        _unchanged(folder, file.name, file.old)
    if not files:
        return
    with journal_of(folder, {file.name: (file.old, file.new) for file in files}):
        # What is removed loses its permissions, also if it is restored.
        for file in sorted(files, key=lambda each: each.new is None):
            if file.new is None:
                _removed(folder / file.name)
            else:
                write_output(folder / file.name, file.new, replace_source=True)


def _unchanged(folder: Path, name: str, content: bytes | None) -> bytes:
    """The content of a file, which is still what it was; None stands for whatever it is."""
    present = read_bytes(folder / name)
    if content is not None and present != content:
        raise DefinitionError(f"{name} has changed in the meantime", hint="import again")
    return present


def _removed(path: Path) -> None:
    try:
        if not os.access(path, os.W_OK):
            # Removal needs write access only to the folder, but the file itself is write-protected.
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        path.unlink()
    except OSError as error:
        raise unwritable(path, error) from error


def _emptied(requirements: RequirementSet, edits: Mapping[str, Sequence[Edit]]) -> set[str]:
    """Files that the changes leave empty, except the last one of a folder."""
    held = Counter(place.document.label for place in requirements.places.values())
    gone = {
        name
        for name, each in edits.items()
        if len(each) == held[name] and all(isinstance(edit, RemoveEntry) for edit in each)
    }
    kept = {_folder_of(name) for name in held if name not in gone}
    return {name for name in gone if _folder_of(name) in kept}


def _require_one_name(folder: Path, name: str) -> None:
    """Require that a file that is to be removed is the project's alone.

    Raises:
        DefinitionError: A link leads to it, or it has another name, under which it would remain.
    """
    path = folder / name
    actual = path.resolve()
    if actual != folder.resolve() / name or path.stat().st_nlink > 1:
        what = f"leads to {actual}" if actual != folder.resolve() / name else "has another name"
        message = f"{name} would lose its last element, and is not removed, since it {what}"
        raise DefinitionError(message, hint="remove it by hand, and import again")


def _folder_of(name: str) -> str:
    """Folder of a file's part, such as ``requirements/system``; the file itself if it is the whole part.

    Of a set of its own this is ``requirements/NAME/system``.
    """
    folders = PurePosixPath(name).parts
    return "/".join(folders[: 2 if folders[1] in REQUIREMENT_PARTS else 3])


def _edited(old: bytes, edits: Sequence[Edit]) -> bytes:
    mark = codecs.BOM_UTF8 if old.startswith(codecs.BOM_UTF8) else b""
    return mark + edited(old.removeprefix(mark).decode("utf-8"), edits).encode("utf-8")


def _key_edits(requirements: RequirementSet, change: ElementChange) -> Iterator[Edit]:
    place = requirements.places[change.id]
    held = place.document.data
    for key in place.location:
        held = held[key]
    order = tuple(dict.fromkeys(attribute.path[0] for attribute in ATTRIBUTES[change.part]))
    touched = dict.fromkeys(each.attribute.path for each in change.attributes)
    gone = {path[0] for path in touched if path[0] not in change.entry}
    for key in dict.fromkeys(path[0] for path in touched):
        if key in gone:
            if key in held:
                yield RemoveKey(location=place.location, key=key)
            continue
        value = change.entry[key]
        inner = [path[1] for path in touched if path[0] == key and len(path) > 1]
        if inner and held.get(key) is not None:
            for name in inner:
                if name in value:
                    yield SetKey(location=(*place.location, key), key=name, value=value[name], before=tuple(value))
                elif name in held[key]:
                    yield RemoveKey(location=(*place.location, key), key=name)
        else:
            before = tuple(name for name in order[: order.index(key)] if name not in gone)
            yield SetKey(location=place.location, key=key, value=value, before=before)


def _homes(requirements: RequirementSet) -> dict[tuple[Part, str], str]:
    """The file of the last element of each part and group, and of each part."""
    homes: dict[tuple[Part, str], str] = {}
    for element in requirements.elements:
        part, label = part_of(element), requirements.places[element.id].document.label
        homes[part, getattr(element, _GROUPS[part]).value] = homes[part, ""] = label
    # One file may contain both blocks and behaviours.
    for part, other in ((Part.BLOCK, Part.BEHAVIOUR), (Part.BEHAVIOUR, Part.BLOCK)):
        if (other, "") in homes:
            homes.setdefault((part, ""), homes[other, ""])
    return homes


def _home(homes: Mapping[tuple[Part, str], str], change: ElementChange) -> str:
    """The file in which a new element is inserted."""
    home = homes.get((change.part, change.entry[_GROUPS[change.part]]), homes.get((change.part, "")))
    if home is None:
        raise DefinitionError(f"there is no file for {change.id!r}", hint="create one by hand with one such element")
    return home
