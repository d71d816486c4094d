"""Reasons why a store cannot be opened, which SQLite does not explain: it reports the same error for each of them."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

_LOGS = (("-wal", "its log"), ("-shm", "the index of its log"))

_LONGEST_PATH = 480
"""Bytes: SQLite's limit of 512, without the ending of a log and what the name of an incomplete store has more."""


class Refusal(NamedTuple):
    """Reason why the user may not use a store.

    Attributes:
        problem: The file and what it does not permit, as a phrase that follows "cannot be used:".
        hint: How to resolve it.
    """

    problem: str
    hint: str


def refusal_of(path: Path) -> Refusal | None:
    """A path that is too long, or the first file of a store that the user may not read or write; None if none is.

    Args:
        path: The file.
    """
    if len(os.fsencode(os.path.realpath(path))) > _LONGEST_PATH:
        problem = f"its path has more than {_LONGEST_PATH} bytes, too many for SQLite"
        return Refusal(problem, "move the project to a folder with a shorter path")
    folder = path.parent
    if not _may(folder, os.X_OK):
        return Refusal(f"its folder {folder.name} may not be entered{_owner(folder)}", _hint_for(folder))
    logs = [(path.with_name(f"{path.name}{ending}"), f"{what} {path.name}{ending}") for ending, what in _LOGS]
    present = [(place, what) for place, what in ((path, "it"), *logs) if place.exists()]
    for mode, denied, places in (
        (os.R_OK, "read", present),
        (os.W_OK, "written", [*present, (folder, f"its folder {folder.name}")]),
    ):
        for place, what in places:
            if _may(place, mode):
                continue
            if _is_read_only(place) and mode == os.W_OK:
                return Refusal(f"{what} is on a read-only file system", "use a copy of the project that can be written")
            return Refusal(f"{what} may not be {denied}{_owner(place)}", _hint_for(place, is_log=place in dict(logs)))
    return None


def _may(place: Path, mode: int) -> bool:
    return os.access(place, mode, effective_ids=os.access in os.supports_effective_ids)


def _is_read_only(place: Path) -> bool:
    with suppress(OSError):
        return bool(os.statvfs(place).f_flag & os.ST_RDONLY)
    return False


def _owner(place: Path) -> str:
    """The owner of a file as a phrase, where that is another user; empty otherwise."""
    owner = _other_owner(place)
    return f" and belongs to {owner}" if owner else ""


def _hint_for(place: Path, *, is_log: bool = False) -> str:
    owner = _other_owner(place)
    hint = f"{owner or 'you'} can change its permissions"
    if is_log and owner:
        hint += ", or remove it by 'rgss evidence' when no sweep is running"
    return f"{hint}; do not delete it, since it may have what was stored last" if is_log else hint


def _other_owner(place: Path) -> str:
    """The owner of a file, where that is another user; empty otherwise."""
    with suppress(OSError):
        owner = place.stat().st_uid
        if owner != os.geteuid():
            with suppress(KeyError):
                return f"user {place.owner()}"
            return f"user {owner}"
    return ""
