"""The columns of tables of requirements, and their rows as elements."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rgss.errors import DocumentError
from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.content import Content, Row
from rgss.exchange.files import problem, refusal_of
from rgss.exchange.foreign_names import PART, ForeignNames, attribute_name, likely_attribute, option_for
from rgss.findings import Finding, shown

PARTS = (Part.STAKEHOLDER, Part.SYSTEM)
"""Parts that have a table; the architecture has none."""

MOST_ROWS, MOST_COLUMNS = 100_000, 100


def columns_of(part: Part) -> tuple[str, ...]:
    """The columns of a table of one part."""
    return tuple(attribute.name for attribute in ATTRIBUTES[part])


def columns_of_both() -> tuple[str, ...]:
    """The columns of one table of stakeholder and system requirements."""
    stakeholder, (first, *system) = columns_of(Part.STAKEHOLDER), columns_of(Part.SYSTEM)
    return (PART, first, *(name for name in stakeholder if name not in (first, *system)), *system)


@dataclass(frozen=True, slots=True, kw_only=True)
class Heads:
    """The first row of a table.

    Attributes:
        columns: The number of the column of each attribute, from 1.
        width: Number of columns of the table.
        is_whole: True if the table has a column for every attribute, so that it is one of rgss.
        names: The heads as the file has them.
        notes: Columns that are not imported.
    """

    columns: Mapping[str, int]
    width: int
    is_whole: bool
    names: tuple[str, ...]
    notes: tuple[str, ...]


def found_heads(
    file: str, heads: Sequence[str], wanted: Sequence[str], names: ForeignNames | None = None, *, where: str = ""
) -> Heads:
    """The columns of a table, in any order.

    Args:
        file: The file's name.
        heads: The cells of the first row.
        wanted: The columns of a table of rgss.
        names: The mapped names of a table of another tool, which may have fewer columns and others; None for one of
            rgss.
        where: Name of the sheet as the prefix of messages.

    Raises:
        DocumentError: A column is missing, duplicate or unknown.
    """
    present = list(heads)
    while present and not present[-1].strip():
        present.pop()
    if len(present) > MOST_COLUMNS:
        raise DocumentError([problem(file, "size", f"{where}more than {MOST_COLUMNS} columns")])
    columns, notes = (
        (_own_columns(file, present, wanted, where), ())
        if names is None
        else _foreign_columns(file, present, wanted, names, where)
    )
    return Heads(
        columns=columns,
        width=len(present),
        is_whole=columns.keys() >= set(wanted),
        names=tuple(present),
        notes=tuple(f"{where}{note}" for note in notes),
    )


def _own_columns(file: str, heads: Sequence[str], wanted: Sequence[str], where: str) -> Mapping[str, int]:
    names = [head.strip().lower() for head in heads]
    findings: list[Finding] = []
    missing = [name for name in wanted if name not in names]
    if missing:
        what = "column" if len(missing) == 1 else "columns"
        message = f"{where}{what} {', '.join(map(repr, missing))} missing from the first row"
        hint = "an export has every column; for a table of another tool give --map or --as"
        findings.append(problem(file, "column", message, hint=hint))
    for number, name in enumerate(names, start=1):
        if name not in wanted:
            message = f"{where}unknown column {shown(heads[number - 1])}"
            hint = f"for a table of another tool give {option_for(heads[number - 1], wanted)}"
            findings.append(problem(file, "column", message, column=number, hint=hint))
        elif name in names[: number - 1]:
            message = f"{where}duplicate column {name!r}"
            findings.append(problem(file, "column", message, column=number, hint="keep one"))
    if findings:
        raise DocumentError(findings)
    return {name: number for number, name in enumerate(names, start=1)}


def _foreign_columns(
    file: str, heads: Sequence[str], wanted: Sequence[str], names: ForeignNames, where: str
) -> tuple[Mapping[str, int], Sequence[str]]:
    columns: dict[str, int] = {}
    notes: list[str] = []
    findings: list[Finding] = []
    mapped = {target for head in heads if (target := names.target(head))}
    for number, head in enumerate(heads, start=1):
        target = names.target(head)
        name = attribute_name(head) if target is None else target
        if name in wanted and name not in columns and (target is not None or name not in mapped):
            columns[name] = number
        elif name in columns and target is not None:
            message = f"{where}the columns {shown(heads[columns[name] - 1])} and {shown(head)} are both the {name}"
            findings.append(problem(file, "column", message, column=number, hint="map one of them"))
        elif name in wanted:
            notes.append(f"the column {shown(head)} is not imported: another one is the {name}")
        elif name and target is not None:
            notes.append(f"the column {shown(head)} is not imported: there is no {name!r} in this table")
        elif name:
            how = f"{option_for(head, wanted)} takes it"
            notes.append(f"the column {shown(head)} is not imported: rgss has none of that name ({how})")
    if "id" not in columns:
        likely = [head for head in heads if likely_attribute(head, wanted) == "id"]
        hint = f"give {option_for(likely[0] if likely else 'NAME', ['id'] if not likely else wanted)}"
        findings.append(problem(file, "column", f"{where}no column has the ids", hint=hint))
    if findings:
        raise DocumentError(findings)
    return columns, notes


def table_content(
    file: str,
    rows: Iterable[Row],
    findings: Sequence[Finding],
    notes: Sequence[str] = (),
    losses: Sequence[Finding] = (),
    heads: Sequence[Heads] = (),
) -> Content:
    """The rows of tables as the content of a file.

    Args:
        file: The file's name.
        rows: The rows.
        findings: What makes the file unusable.
        notes: Content that is not imported, besides that of the heads.
        losses: Content of elements that is not imported.
        heads: The first row of each table.

    Raises:
        DocumentError: There are findings.
    """
    listed = tuple(rows)
    if findings:
        raise refusal_of(findings)
    return Content(
        rows=listed,
        whole=frozenset(PARTS if all(each.is_whole for each in heads) else ()),
        notes=(*notes, *(note for each in heads for note in each.notes)),
        losses=tuple(losses),
        names=tuple(name for each in heads for name in each.names),
        file=file,
    )
