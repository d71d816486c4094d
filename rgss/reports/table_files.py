"""Tables as Markdown, as CSV and as an Excel file."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from typing import Any

from rgss.documents import LONGEST_EXCEL_TEXT, neutralised, printable, starts_like_a_formula, without_clock
from rgss.errors import DefinitionError
from rgss.reports.tables import Cell, Table, cell_text

_MARKDOWN = re.compile(r"([\\`*_\[\]<>|~&])")
_WIDE_HEADS = frozenset({"text", "evidence", "success criterion", "not covered", "what is counted", "is satisfied by"})
_WIDE, _NARROW, _MARK, _LONG_HEAD = 60.0, 18.0, 5.0, 12


def to_markdown(tables: Sequence[Table], *, title: str) -> str:
    """Write tables as one Markdown document with escaped cells."""
    parts = [f"# {_markdown(title)}\n"]
    for table in tables:
        parts.append(f"## {_markdown(table.title)}\n")
        if table.note:
            parts.append(f"{_markdown(table.note)}\n")
        if table.rows:
            lines = ["| " + " | ".join(_markdown(head) for head in table.heads) + " |", "|---" * len(table.heads) + "|"]
            lines += ["| " + " | ".join(_markdown(cell_text(cell)) for cell in row) + " |" for row in table.rows]
            parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)


def to_csv(table: Table) -> str:
    """Write a table as CSV (RFC 4180); text that looks like a formula gets a leading apostrophe."""
    out = io.StringIO(newline="")
    writer = csv.writer(out, lineterminator="\r\n")
    writer.writerow([neutralised(printable(head)) for head in table.heads])
    writer.writerows([_csv_cell(cell) for cell in row] for row in table.rows)
    return out.getvalue()


def to_excel(tables: Sequence[Table]) -> bytes:
    """Write tables as an Excel file, one sheet each; the same tables give the same bytes.

    Texts are text cells, also if they look like formulas; the header row is frozen.

    Raises:
        DefinitionError: The package ``openpyxl`` is not installed.
    """
    try:
        from openpyxl import Workbook
    except ImportError as error:
        raise DefinitionError(
            "an Excel file needs the package openpyxl, which is not installed", hint="pip install openpyxl"
        ) from error
    workbook = Workbook(write_only=True)
    for table in tables:
        _write_sheet(workbook.create_sheet(table.name[:31]), table)
    file = io.BytesIO()
    workbook.save(file)
    return without_clock(file.getvalue())


def _markdown(text: str) -> str:
    return _MARKDOWN.sub(r"\\\1", " ".join(printable(text).split()))


def _csv_cell(cell: Cell) -> Cell:
    return neutralised(printable(cell)) if isinstance(cell, str) else cell


def _write_sheet(sheet: Any, table: Table) -> None:
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.styles import Alignment, Font, PatternFill
    from openpyxl.utils import get_column_letter

    first_marks = table.marks_from
    for index, head in enumerate(table.heads):
        marks = first_marks is not None and index >= first_marks
        width = _MARK if marks else _WIDE if head in _WIDE_HEADS else _NARROW
        sheet.column_dimensions[get_column_letter(index + 1)].width = width
    sheet.freeze_panes = "B2" if first_marks is None else f"{get_column_letter(first_marks + 1)}2"
    top, wrapped = Alignment(vertical="top"), Alignment(vertical="top", wrap_text=True)
    fill, bold = PatternFill("solid", fgColor="FFDDE6F0"), Font(bold=True)

    def made(cell: Cell, alignment: Any, *, head: bool = False) -> Any:
        if cell is None:
            return None
        text = cell if not isinstance(cell, str) else _excel_text(cell)
        written = WriteOnlyCell(sheet, text)
        if isinstance(text, str):
            written.data_type = "s"  # openpyxl takes what begins with = for a formula
            # Excel then keeps it a text also when somebody edits the cell.
            written.quotePrefix = starts_like_a_formula(text)
        written.alignment = alignment
        if head:
            written.font, written.fill = bold, fill
        return written

    upright = Alignment(vertical="bottom", text_rotation=90)
    sheet.append(
        [
            made(head, upright if first_marks is not None and index >= first_marks else top, head=True)
            for index, head in enumerate(table.heads)
        ]
    )
    for row in table.rows:
        sheet.append(
            [made(cell, wrapped if table.heads[index] in _WIDE_HEADS else top) for index, cell in enumerate(row)]
        )
    if table.rows:
        sheet.auto_filter.ref = f"A1:{get_column_letter(len(table.heads))}{len(table.rows) + 1}"


def _excel_text(text: str) -> str:
    whole = printable(text)
    if len(whole) <= LONGEST_EXCEL_TEXT:
        return whole
    mark = " … (cut: longer than a cell holds)"
    return whole[: LONGEST_EXCEL_TEXT - len(mark)] + mark
