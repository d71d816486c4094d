"""Report of what an import changes, as text and as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.exchange import Content, ElementChange, FileChange

_LONGEST = 70
_CONTEXT = 15


def print_report(changes: Sequence[ElementChange], foreign: Content) -> None:
    """Print each change by id, attribute by attribute, and what of the file is not imported."""
    for change in changes:
        print(f"{change.kind.value} {change.part.value} {_safe(change.id)}")
        for each in change.attributes:
            old, new = _excerpts(each.old, each.new)
            if each.attribute.name == "id":
                continue
            before = f"{old} -> " if change.kind.value == "changed" else ""
            print(f"  {each.attribute.name}: {before}{new}")
    print_notes(foreign)
    for loss in foreign.losses:
        print(loss)


def print_notes(foreign: Content) -> None:
    """Print what of the file has no counterpart here."""
    for note in foreign.notes:
        print(f"note: {_safe(note)}")


def report_as_json(
    changes: Sequence[ElementChange], foreign: Content, files: Sequence[FileChange], *, applied: bool
) -> dict[str, Any]:
    """The changes in full, as plain data."""
    return {
        "applied": applied,
        "files": [file.name for file in files if file.new is not None],
        "removed_files": [file.name for file in files if file.new is None],
        "changes": [
            {
                "kind": change.kind.value,
                "part": change.part.value,
                "id": change.id,
                "attributes": [
                    {"name": each.attribute.name, "old": each.old, "new": each.new} for each in change.attributes
                ],
            }
            for change in changes
        ],
        "elements": len(foreign.rows),
        "notes": list(foreign.notes),
        "losses": [{"file": loss.file, "line": loss.line, "message": loss.message} for loss in foreign.losses],
    }


def _excerpts(old: str, new: str) -> tuple[str, str]:
    """Both texts, cut to where they differ."""
    shared = next(
        (at for at, pair in enumerate(zip(old, new, strict=False)) if pair[0] != pair[1]), min(len(old), len(new))
    )
    start = 0 if max(len(old), len(new)) <= _LONGEST else max(0, shared - _CONTEXT)
    return _excerpt(old, start), _excerpt(new, start)


def _excerpt(text: str, start: int) -> str:
    if not text:
        return "(empty)"
    cut = text[start : start + _LONGEST]
    before, after = "…" if start else "", "…" if start + _LONGEST < len(text) else ""
    return f"'{before}{_safe(cut)}{after}'"


def _safe(text: str) -> str:
    """Text from a file with terminal control characters escaped; line breaks are shown as ⏎."""
    return "".join(each if each.isprintable() else "⏎" if each == "\n" else "�" for each in text)
