"""CSV (RFC 4180): one table of stakeholder and system requirements."""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

from rgss.documents import neutralised, restored
from rgss.errors import DocumentError
from rgss.exchange.attributes import Part
from rgss.exchange.content import Content, Row
from rgss.exchange.files import problem, read_bytes
from rgss.exchange.foreign_names import PART
from rgss.exchange.tables.foreign_rows import ForeignRows, ForeignTable
from rgss.exchange.tables.heads import (
    MOST_ROWS,
    PARTS,
    Heads,
    columns_of,
    columns_of_both,
    found_heads,
    table_content,
)
from rgss.findings import Finding, shown

_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_DIVIDERS = (",", ";", "\t")
_STATED_DIVIDER = re.compile(r'"?sep=([,;\t])"?\r?\n', re.IGNORECASE)
"""First line that states the separator to Excel."""
_QUOTED = re.compile(r'"(?:[^"]|"")*"')
_LONGEST_HEADS = 100_000
_WRONG: Mapping[str, str] = MappingProxyType(
    {
        "unexpected end of data": "a cell that begins with a quotation mark has no closing one",
        "expected after": "a quotation mark within a quoted cell must be doubled",
        "field larger": f"a cell must have at most {csv.field_size_limit()} characters",
        "new-line": "a line break within a cell needs quotation marks around the cell",
        "NUL": "a cell must not hold the character U+0000",
    }
)
"""Description of a problem, by a phrase in the message of the reader of the standard library."""


def csv_text(content: Content) -> str:
    """Write requirements as CSV, one row each.

    A text that a spreadsheet might evaluate as a formula gets a leading apostrophe, which `read_csv` removes.
    """
    heads = columns_of_both()
    out = io.StringIO(newline="")
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow(heads)
    for row in content.rows:
        if row.part in PARTS:
            cells = {**row.cells, PART: row.part.value}
            writer.writerow([neutralised(cells.get(name, "")) for name in heads])
    return out.getvalue()


def read_csv(path: Path, foreign: ForeignTable | None = None) -> Content:
    """Read requirements from CSV; the columns may be in any order.

    Args:
        path: The file, in UTF-8 or UTF-16, with commas, semicolons or tabs as separators.
        foreign: What is known of a table of another tool; None for one of rgss, which has every column.

    Raises:
        DocumentError: The file cannot be read, is not in its encoding or not CSV, or has other columns.
    """
    file = str(path)
    content = read_bytes(path)
    is_utf16 = content.startswith(_UTF16)
    try:
        # As Excel saves a "Unicode text".
        text = content.decode("utf-16" if is_utf16 else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        hint = "save it as CSV UTF-8"
        raise DocumentError(
            [problem(file, "encoding", f"is not UTF-{16 if is_utf16 else 8}", line=line, hint=hint)]
        ) from None
    stated = _STATED_DIVIDER.match(text)
    divider = stated[1] if stated else _divider(text)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=divider, strict=True)
    try:
        if stated:
            next(reader)
        first_row = [restored(head) for head in next(reader, [])]
        heads = found_heads(file, first_row, columns_of_both(), None if foreign is None else foreign.names)
        findings: list[Finding] = []
        taken = None if foreign is None else ForeignRows(foreign)
        rows = list(_rows(file, reader, heads, taken, findings))
    except csv.Error as error:
        message = next((said for sign, said in _WRONG.items() if sign in str(error)), "its quotation marks are wrong")
        raise DocumentError([problem(file, "syntax", f"not CSV: {message}", line=reader.line_num)]) from None
    if taken is None:
        return table_content(file, rows, findings, heads=[heads])
    return table_content(file, rows, findings, tuple(taken.notes()), taken.losses, [heads])


def _divider(text: str) -> str:
    """The separator of the first row, whose quoted cells may contain others."""
    first = _QUOTED.sub("", text[:_LONGEST_HEADS]).partition("\n")[0]
    return max(_DIVIDERS, key=first.count)


def _rows(
    file: str, reader: Iterator[list[str]], heads: Heads, taken: ForeignRows | None, findings: list[Finding]
) -> Iterator[Row]:
    line = getattr(reader, "line_num", 1) + 1
    for count, cells in enumerate(reader):
        here, line = line, getattr(reader, "line_num", 1) + 1
        if count >= MOST_ROWS:
            findings.append(problem(file, "size", f"more than {MOST_ROWS} rows", line=here))
            return
        if not any(cell.strip() for cell in cells):
            continue
        if len(cells) < heads.width or any(cell.strip() for cell in cells[heads.width :]):
            message = f"{heads.width} cells are expected, {len(cells)} found"
            findings.append(problem(file, "row", message, line=here))
            continue
        named = {name: restored(cells[number - 1]) for name, number in heads.columns.items()}
        if taken is not None:
            yield from taken.element(file, Row(part=None, cells=named, line=here, columns=heads.columns))
        else:
            yield from _row(file, named, heads.columns, here, findings)


def _row(
    file: str, named: dict[str, str], columns: Mapping[str, int], line: int, findings: list[Finding]
) -> Iterator[Row]:
    word = named.pop(PART).strip().lower()
    if word not in [part.value for part in PARTS]:
        message = f"part: {shown(word)} is not one of {', '.join(part.value for part in PARTS)}"
        findings.append(problem(file, "value", message, line=line, column=columns[PART]))
        return
    part = Part(word)
    own = columns_of(part)
    for name, cell in named.items():
        if name not in own and cell.strip():
            message = f"{named['id'].strip()}: a {part.value} requirement has no {name!r}"
            findings.append(problem(file, "value", message, line=line, column=columns[name], hint="empty the cell"))
    yield Row(part=part, cells={name: named[name] for name in own}, line=line, columns=columns)
