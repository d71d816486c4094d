"""The columns of tables of requirements, and their rows as elements."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from rgss.errors import DocumentError
from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.content import Content, Row
from rgss.exchange.files import problem, refusal_of
from rgss.findings import Finding, shown

PART = "part"
"""The column with the part of a row, in a table of both parts."""

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


def found_columns(file: str, heads: Sequence[str], wanted: Sequence[str], *, where: str = "") -> Mapping[str, int]:
    """The number of each column, from 1; a table may have them in any order.

    Args:
        file: The file's name.
        heads: The cells of the first row.
        wanted: The columns that the table must have.
        where: Name of the sheet as the prefix of messages.

    Raises:
        DocumentError: A column is missing, duplicate or unknown.
    """
    names = [head.strip().lower() for head in heads]
    while names and not names[-1]:
        names.pop()
    if len(names) > MOST_COLUMNS:
        raise DocumentError([problem(file, "size", f"{where}more than {MOST_COLUMNS} columns")])
    findings: list[Finding] = []
    missing = [name for name in wanted if name not in names]
    if missing:
        what = "column" if len(missing) == 1 else "columns"
        message = f"{where}{what} {', '.join(map(repr, missing))} missing from the first row"
        findings.append(problem(file, "column", message, hint="an export has every column"))
    for number, name in enumerate(names, start=1):
        if name not in wanted:
            hint = f"columns: {', '.join(wanted)}"
            message = f"{where}unknown column {shown(heads[number - 1])}"
            findings.append(problem(file, "column", message, column=number, hint=hint))
        elif name in names[: number - 1]:
            message = f"{where}duplicate column {name!r}"
            findings.append(problem(file, "column", message, column=number, hint="keep one"))
    if findings:
        raise DocumentError(findings)
    return {name: number for number, name in enumerate(names, start=1)}


def table_content(
    file: str,
    rows: Iterable[Row],
    findings: Sequence[Finding],
    notes: Sequence[str] = (),
    losses: Sequence[Finding] = (),
) -> Content:
    """The rows of tables as the content of a file.

    Raises:
        DocumentError: There are findings.
    """
    listed = tuple(rows)
    if findings:
        raise refusal_of(findings)
    return Content(rows=listed, whole=frozenset(PARTS), notes=tuple(notes), losses=tuple(losses), file=file)
