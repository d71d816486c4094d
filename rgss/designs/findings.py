"""Common findings of design files about ids, values and names."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence

from rgss.designs.parameters import is_si, si_unit
from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding


class DesignFileReader:
    """Reader of a design file that collects its findings, so that one error does not hide others."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._findings: list[Finding] = []

    def _report(self, rule: str, message: str, *location: str | int, hint: str = "", at_key: bool = False) -> None:
        self._findings.append(self._document.finding(f"design.{rule}", message, location, hint=hint, at_key=at_key))


def duplicate_findings(
    document: Document, section: Sequence[str | int], entries: Iterable[object], key: str = "id"
) -> Iterator[Finding]:
    """A finding at each entry of a list with the key of an earlier entry.

    Args:
        document: The file.
        section: Location of the list.
        entries: The entries.
        key: The key that must be unique.
    """
    first: dict[str, int] = {}
    for index, entry in enumerate(entries):
        value = getattr(entry, key)
        if value in first:
            place = (*section, first[value], key)
            message = f"{key} {value!r} is already in line {document.values[place][0]}"
            hint = f"use a unique {key}"
            yield document.finding("design.duplicate-id", message, (*section, index, key), hint=hint)
        first.setdefault(value, index)


def dotted_findings(
    document: Document, location: Sequence[str | int], name: str, *, at_key: bool = False
) -> Iterator[Finding]:
    """A finding if a name has a dot, which would make ``component.<role>.<property>`` ambiguous."""
    if "." in name:
        hint = f"write {name.replace('.', '_')}"
        yield document.finding("design.dotted-id", f"{name!r} has a dot", location, hint=hint, at_key=at_key)


def unit_findings(document: Document, location: Sequence[str | int], name: str, unit: str) -> Iterator[Finding]:
    """A finding if a unit is not SI."""
    try:
        if not is_si(unit):
            message = f"{name}: the unit must be SI, got {unit!r}"
            yield document.finding("design.unit", message, location, hint=f"write {si_unit(unit)}")
    except QuantityError as error:
        yield document.finding("design.unit", f"{name}: {error.message}", location, hint=error.hint)


def near_hint(name: str, known: Iterable[str], what: str) -> str:
    """Hint for an unknown name: the nearest known name, or the list of known names."""
    names = sorted(set(known))
    near = difflib.get_close_matches(name, names, n=1)
    if near:
        return f"did you mean {near[0]!r}?"
    return f"{what}: {', '.join(names)}" if names else f"there are no {what}"


def value_hint(value: str, known: Iterable[str], what: str, *, others: Iterable[str] = ()) -> str:
    """Hint for an unknown value: the nearest known value, case-insensitive, or the list of known values.

    Args:
        value: The value.
        known: The listed values.
        what: Their name in messages.
        others: Further values, proposed if they are near, but not listed.
    """
    listed = set(known)
    near = difflib.get_close_matches(value.lower(), sorted({*listed, *others}), n=1)
    return near_hint(value, near or listed, what)
