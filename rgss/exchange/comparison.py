"""Changes that a file of another tool would make in a project."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from rgss.documents import validated
from rgss.exchange.attributes import ATTRIBUTES, MODELS, Attribute, Form, Part
from rgss.exchange.cells import CellError, cells_of, entry_of, ids_in
from rgss.exchange.content import Content, Row, as_written
from rgss.exchange.files import problem, refusal_of
from rgss.exchange.foreign_names import choice_hint, likely_attribute, option_for
from rgss.findings import Finding, shown

_CONTROL = frozenset(map(chr, (*range(9), 11, 12, *range(14, 32), 127)))


class ChangeKind(str, Enum):
    """Kind of a change of an element."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class AttributeChange:
    """One attribute before and after.

    Attributes:
        attribute: The attribute.
        old: Its present value as one text; empty if it is open.
        new: Its new value.
    """

    attribute: Attribute
    old: str
    new: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ElementChange:
    """One element before and after.

    Attributes:
        kind: Kind of the change.
        part: Its part.
        id: Its id.
        attributes: The attributes that differ; all attributes of an added element.
        entry: The resulting entry of the YAML file; empty if it is removed.
    """

    kind: ChangeKind
    part: Part
    id: str
    attributes: tuple[AttributeChange, ...]
    entry: Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportDefaults:
    """Defaults for elements whose part or attributes a file does not state.

    Attributes:
        part: The part of such elements.
        defaults: Attributes of new elements, and of others whose cell in the file is empty, by name.
    """

    part: Part | None
    defaults: Mapping[str, str]


def compare(own: Content, foreign: Content, assumed: ImportDefaults) -> tuple[ElementChange, ...]:
    """Changes by a file: changed and added elements in the file's order, then removed ones.

    Ids of one attribute are unordered: another order is not a change.

    Args:
        own: The project.
        foreign: The file.
        assumed: The defaults.

    Raises:
        DocumentError: The file has a duplicate or a missing id, an invalid or a missing attribute, or
            names an unknown element; with every such problem.
    """
    known = {row.id: row for row in own.rows}
    findings: list[Finding] = []
    changes: list[ElementChange] = []
    seen: dict[str, int] = {}
    for row in foreign.rows:
        if not row.id:
            findings.append(_at(foreign, row, "id", "missing", "an element without an id"))
        elif row.id in seen:
            findings.append(_at(foreign, row, "id", "duplicate", f"{row.id!r} is already in line {seen[row.id]}"))
        else:
            seen[row.id] = row.line
            found = _change(known.get(row.id), foreign, row, assumed)
            if isinstance(found, ElementChange):
                changes.append(found)
            else:
                findings += found
    gone = [row for row in own.rows if row.part in foreign.whole and row.id not in seen]
    changes += [_removal(row) for row in gone]
    findings += _dangling(known.keys() | seen.keys(), foreign)
    if findings:
        # What was lost of an element may be why it lacks something.
        lines = {finding.line for finding in findings}
        raise refusal_of([*findings, *(loss for loss in foreign.losses if loss.line in lines)])
    return tuple(change for change in changes if change.kind is not ChangeKind.CHANGED or change.attributes)


def not_as_planned(
    changes: Sequence[ElementChange], before: Content, after: Content, *, remove: bool
) -> tuple[str, ...]:
    """Ids of elements that differ from the planned changes after these have been written.

    Args:
        changes: The planned changes; other elements must be unchanged.
        before: The project before.
        after: The project afterwards.
        remove: True if elements were to be removed.
    """
    cells = {row.id: row.cells for row in after.rows}
    planned = {change.id for change in changes}
    wrong = [change.id for change in changes if not _is_done(change, cells.get(change.id), remove=remove)]
    wrong += [row.id for row in before.rows if row.id not in planned and cells.get(row.id) != row.cells]
    known = planned | {row.id for row in before.rows}
    return (*wrong, *(name for name in cells if name not in known))


def _is_done(change: ElementChange, cells: Mapping[str, str] | None, *, remove: bool) -> bool:
    if change.kind is ChangeKind.REMOVED:
        return not remove or cells is None
    if cells is None:
        return False
    return not any(_differs(each.attribute, each.new, cells[each.attribute.name]) for each in change.attributes)


def _change(own: Row | None, foreign: Content, row: Row, assumed: ImportDefaults) -> ElementChange | list[Finding]:
    part = row.part or (own.part if own is not None else assumed.part)
    if part is None:
        hint = "give --as stakeholder or --as system"
        return [_at(foreign, row, "id", "part", f"the new element {row.id!r} has no part", hint)]
    if own is not None and own.part is not part:
        here = own.part.value if own.part is not None else ""
        return [_at(foreign, row, "id", "part", f"{row.id!r} is of part {here!r} in the project, not {part.value!r}")]
    names = {attribute.name for attribute in ATTRIBUTES[part]}
    base: Mapping[str, str] = own.cells if own is not None else _for_new(assumed, names)
    # An empty cell says that an element has the default, whatever it has here: the result follows from the file alone.
    stated = {
        name: cell if cell.strip() else assumed.defaults.get(name, cell)
        for name, cell in row.cells.items()
        if name in names
    }
    cells = {**base, **stated}
    entry, findings = _entry(part, cells, foreign, row)
    if findings:
        return findings
    element, problems = validated(entry, MODELS[part])
    if element is None:
        return [_value_problem(part, foreign, row, location, message) for location, message in problems]
    after = cells_of(part, as_written(element, entry))
    before = own.cells if own is not None else dict.fromkeys(after, "")
    return ElementChange(
        kind=ChangeKind.ADDED if own is None else ChangeKind.CHANGED,
        part=part,
        id=row.id,
        attributes=tuple(
            AttributeChange(attribute=each, old=before[each.name], new=after[each.name])
            for each in ATTRIBUTES[part]
            if _differs(each, before[each.name], after[each.name])
        ),
        entry=as_written(element, entry, exclude_defaults=True),
    )


def _for_new(assumed: ImportDefaults, names: set[str]) -> dict[str, str]:
    return {name: value for name, value in assumed.defaults.items() if name in names}


def _entry(part: Part, cells: Mapping[str, str], foreign: Content, row: Row) -> tuple[dict[str, Any], list[Finding]]:
    findings = []
    sound = dict(cells)
    for attribute in ATTRIBUTES[part]:
        cell = cells.get(attribute.name, "")
        try:
            if not _CONTROL.isdisjoint(cell):
                raise CellError("a control character is not text")
            entry_of(part, {attribute.name: cell})
        except CellError as error:
            findings.append(_at(foreign, row, attribute.name, "value", f"{row.id}: {attribute.name}: {error}"))
            del sound[attribute.name]
    return entry_of(part, sound), findings


def _removal(row: Row) -> ElementChange:
    if row.part is None:
        raise ValueError("an element of the project has a part")
    return ElementChange(kind=ChangeKind.REMOVED, part=row.part, id=row.id, attributes=(), entry={})


def _differs(attribute: Attribute, old: str, new: str) -> bool:
    return set(ids_in(old)) != set(ids_in(new)) if attribute.form is Form.LINKS else old != new


def _dangling(known: set[str], foreign: Content) -> Iterator[Finding]:
    """Unknown ids that a file names; measures are checked when the result is loaded."""
    named = [each for attributes in ATTRIBUTES.values() for each in attributes if each.holds_ids]
    names = {each.name for each in named if each.name != "measure"}
    for row in foreign.rows:
        for name in sorted(names & row.cells.keys()):
            for other in ids_in(row.cells[name]):
                if other not in known:
                    message = f"{row.id}: {name}: unknown element {shown(other)}"
                    yield _at(foreign, row, name, "unknown-id", message, "correct the id, or add the element")


def _value_problem(part: Part, foreign: Content, row: Row, location: Sequence[str | int], message: str) -> Finding:
    keys = tuple(key for key in location if isinstance(key, str))
    name = next((each.name for each in ATTRIBUTES[part] if each.path == keys[: len(each.path)]), "id")
    if name == "id" and keys and keys[0] != "id":
        name = next((each.name for each in ATTRIBUTES[part] if each.path[0] == keys[0]), "id")
    hint = ""
    if message == "is missing":
        hint = _ways_to_fill(foreign, row, name)
    elif name == "id" and not row.id[:1].isalpha():
        hint = "give --id-prefix, such as --id-prefix SYS-"
    elif keys and (attribute := next((each for each in ATTRIBUTES[part] if each.name == name), None)) is not None:
        hint = choice_hint(attribute, row.cells.get(name, ""))
    label = f"{row.id}: {name}" if keys else row.id
    return _at(foreign, row, name, "value", f"{label}: {message}", hint)


def _ways_to_fill(foreign: Content, row: Row, name: str) -> str:
    ways = ["fill it in"]
    likely = next((each for each in foreign.names if likely_attribute(each) == name), None)
    if likely is not None and name not in row.cells:
        ways.append(f"give {option_for(likely)}")
    return ", or ".join([*ways, f"give --default {name}=…"])


def _at(foreign: Content, row: Row, name: str, rule: str, message: str, hint: str = "") -> Finding:
    column = row.columns.get(name, 1)
    return problem(row.file or foreign.file, rule, message, line=row.line, column=column, hint=hint)
