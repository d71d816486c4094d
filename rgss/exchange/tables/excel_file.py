"""Excel: a workbook with a sheet of stakeholder requirements and one of system requirements."""

from __future__ import annotations

import io
import warnings
import zipfile
import zlib
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from rgss.documents import LONGEST_EXCEL_TEXT, starts_like_a_formula, without_clock
from rgss.errors import DefinitionError, DocumentError
from rgss.exchange.attributes import ATTRIBUTES, Form, Part
from rgss.exchange.content import Content, Row
from rgss.exchange.files import LARGEST_FILE_BYTES, problem, read_bytes
from rgss.exchange.foreign_names import ForeignNames
from rgss.exchange.tables.cell_comments import cell_comments, cell_links
from rgss.exchange.tables.foreign_rows import ForeignRows, ForeignTable
from rgss.exchange.tables.formatted_cells import FormattedCell, SheetReader, escaped_text
from rgss.exchange.tables.heads import (
    MOST_COLUMNS,
    MOST_ROWS,
    PARTS,
    Heads,
    columns_of,
    columns_of_both,
    found_heads,
    table_content,
)
from rgss.exchange.xml_guard import require_plain_xml
from rgss.findings import Finding, Severity, shown

_MOST_MEMBERS = 1_000
_WIDE, _NARROW = 60.0, 18.0


def excel_bytes(content: Content) -> bytes:
    """Write requirements as a workbook, one sheet for each part and one row for each requirement.

    Texts are text cells, also if they look like formulas; the same content gives the same bytes.

    Raises:
        DefinitionError: The package openpyxl is not installed, or a text is longer than a cell holds.
    """
    _require_openpyxl()
    from openpyxl import Workbook

    # Checked before the workbook is created, which must not be left incomplete.
    for row in content.rows:
        long = next((name for name, cell in row.cells.items() if len(cell) > LONGEST_EXCEL_TEXT), None)
        if row.part in PARTS and long is not None:
            raise DefinitionError(f"{row.id}: {long} is longer than a cell of Excel holds", hint="export csv or reqif")
    workbook = Workbook(write_only=True)
    for part in PARTS:
        _write_sheet(workbook.create_sheet(part.value), part, [row for row in content.rows if row.part is part])
    file = io.BytesIO()
    workbook.save(file)
    return without_clock(file.getvalue())


def read_excel(path: Path, foreign: ForeignTable | None = None) -> Content:
    """Read requirements from a workbook; the columns of a sheet may be in any order.

    Exponents and indices get their plain form; struck-out text is omitted and reported.

    Args:
        path: The file, with the sheets ``stakeholder`` and ``system``.
        foreign: What is known of a workbook of another tool, whose first sheet is read if it has neither; None for one
            of rgss.

    Raises:
        DefinitionError: The package openpyxl is not installed.
        DocumentError: The file is not a workbook, would unpack to too much, or has other sheets or columns,
            or merged cells.
    """
    _require_openpyxl()
    from openpyxl import load_workbook

    file = str(path)
    content = read_bytes(path)
    _require_harmless(content, file)
    read = _Reading(file=file, names=None if foreign is None else foreign.names)
    taken = None if foreign is None else ForeignRows(foreign)
    rows: list[Row] = []
    try:
        with warnings.catch_warnings():
            # openpyxl warns of unknown formatting, which is not read here.
            warnings.simplefilter("ignore")
            workbook = load_workbook(io.BytesIO(content), read_only=True, rich_text=True)
            sheets = _sheets(file, workbook, is_foreign=foreign is not None)
            for name, part in sheets.items():
                sheet = SheetReader(workbook, name)
                found = list(_rows(read, sheet, name, part))
                written = {(row.line, row.columns[key]): text for row in found for key, text in row.cells.items()}
                rows += found if taken is None else (each for row in found for each in taken.element(file, row))
                read.losses += _beside_text(file, content, sheet.path, name, written)
    except DocumentError:
        raise
    except Exception:  # noqa: BLE001, RUF100 - a damaged workbook breaks openpyxl in many ways
        message = "is not a workbook that can be read: it is damaged, or lacks parts that a workbook has"
        raise DocumentError([problem(file, "syntax", message, hint="save it again as .xlsx")]) from None
    notes = [f"the sheet {name!r} is not imported" for name in workbook.sheetnames if name not in sheets]
    if taken is not None:
        notes += taken.notes()
        read.losses += taken.losses
    return table_content(file, rows, read.findings, notes, read.losses, read.heads)


@dataclass(slots=True, kw_only=True)
class _Reading:
    """A workbook while it is read, with what is found in it."""

    file: str
    names: ForeignNames | None
    findings: list[Finding] = field(default_factory=list)
    losses: list[Finding] = field(default_factory=list)
    heads: list[Heads] = field(default_factory=list)


def _sheets(file: str, workbook: Any, *, is_foreign: bool) -> Mapping[str, Part | None]:
    """The sheets to read, with the part of their elements; None if a column or the project states it.

    Of a workbook of another tool this is the first sheet with cells that is not hidden.

    Raises:
        DocumentError: A sheet is missing.
    """
    names = workbook.sheetnames
    own: dict[str, Part | None] = {part.value: part for part in PARTS if part.value in names}
    missing = [part.value for part in PARTS if part.value not in own]
    if is_foreign and names:
        shown_sheets = [sheet.title for sheet in workbook.worksheets if sheet.sheet_state == "visible"]
        return own or {(shown_sheets or names)[0]: None}
    if missing:
        message = f"there is no sheet {' and no sheet '.join(map(repr, missing))}"
        raise DocumentError([problem(file, "sheet", message, hint=f"sheets: {', '.join(names)}")])
    return own


def _require_openpyxl() -> None:
    try:
        import openpyxl  # noqa: F401
    except ImportError as error:
        raise DefinitionError(
            "an Excel file needs the package openpyxl, which is not installed", hint="pip install 'rgss[exchange]'"
        ) from error


def _require_harmless(content: bytes, file: str) -> None:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = archive.infolist()
            if len(members) > _MOST_MEMBERS or sum(member.file_size for member in members) > LARGEST_FILE_BYTES:
                limit = LARGEST_FILE_BYTES // (1024 * 1024)
                raise DocumentError([problem(file, "size", f"would unpack to more than {limit} MiB, and is refused")])
            for member in members:
                if member.filename.endswith((".xml", ".rels")):
                    require_plain_xml(archive.read(member), f"{file} ({member.filename})")
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, ValueError, OSError):
        raise DocumentError([problem(file, "syntax", "is not an Excel file (.xlsx), or a damaged one")]) from None


def _rows(read: _Reading, sheet: SheetReader, name: str, part: Part | None) -> Iterator[Row]:
    file, where = read.file, f"sheet {name!r}: "
    wanted = columns_of_both() if part is None else columns_of(part)
    columns: Mapping[str, int] | None = None
    numbers: list[int] = []
    count = 0
    for number, cells in sheet.rows():
        # A row that the file omits is empty; the first one has the names of the columns, in whatever formatting.
        if columns is None:
            read.heads.append(found_heads(file, _heads(cells) if number == 1 else [], wanted, read.names, where=where))
            columns = read.heads[-1].columns
        if number > 1:
            for row in _row(read, cells, where, Row(part=part, cells={}, line=number, columns=columns)):
                count += 1
                if count > MOST_ROWS:
                    read.findings.append(problem(file, "size", f"{where}more than {MOST_ROWS} rows", line=number))
                    return
                yield row
            numbers.append(number)
    if columns is None:
        columns = found_heads(file, [], wanted, read.names, where=where).columns
    read.findings += _merged(file, sheet, columns, numbers, where)


def _heads(cells: list[FormattedCell]) -> list[str]:
    texts = {cell.column: cell.unformatted() for cell in cells if cell.column <= MOST_COLUMNS + 1}
    return [texts.get(column, "") for column in range(1, max(texts, default=0) + 1)]


def _row(read: _Reading, cells: list[FormattedCell], sheet: str, row: Row) -> Iterator[Row]:
    where = f"{sheet}row {row.line}"
    wanted = set(row.columns.values())
    held = {cell.column: cell for cell in cells if cell.value is not None and cell.column in wanted}
    lost = {column: loss for column, cell in held.items() if (loss := cell.text().losses)}
    texts = {column: _text(read.file, cell, where, row.line, read.findings) for column, cell in held.items()}
    named = row.columns["id"]
    if named in lost and not texts[named].strip():
        message = f"{where}: {held[named].unformatted().strip()} is struck out, and the row is omitted"
        read.losses.append(_loss(read.file, message, row.line, named))
        return
    for name, column in row.columns.items():
        for phrase in lost.get(column, ()):
            message = f"{texts.get(named, '').strip()}: {name}: {phrase}"
            read.losses.append(_loss(read.file, message, row.line, column))
    if any(text.strip() for text in texts.values()):
        yield replace(row, cells={name: texts.get(column, "") for name, column in row.columns.items()})


def _loss(file: str, message: str, line: int, column: int) -> Finding:
    return problem(file, "loss", message, line=line, column=column, severity=Severity.WARNING)


def _text(file: str, cell: FormattedCell, where: str, line: int, findings: list[Finding]) -> str:
    text = cell.text()
    if cell.kind in ("f", "e", "d") and not text.losses:
        what = {"f": "a formula", "e": "an error", "d": "a date"}[cell.kind]
        message = f"{where}: the cell holds {what}, not a text"
        findings.append(problem(file, "value", message, line=line, column=cell.column, hint="write it as text"))
        return ""
    return text.text


def _merged(
    file: str, sheet: SheetReader, columns: Mapping[str, int], numbers: list[int], where: str
) -> Iterator[Finding]:
    """Merged cells of several rows or attributes, of which only the first has the text."""
    for first_row, first_column, last_row, last_column in sheet.merged:
        rows = numbers[bisect_left(numbers, first_row) : bisect_right(numbers, last_row)]
        names = [name for name, column in columns.items() if first_column <= column <= last_column]
        if rows and names and len(rows) * len(names) > 1:
            what = " and ".join(map(repr, names))
            lines = f"row {rows[0]}" if len(rows) == 1 else f"rows {rows[0]} to {rows[-1]}"
            message = f"{where}{lines}: the cells of {what} are merged, and only the first has the text"
            hint = "unmerge them, and fill in each"
            yield problem(file, "merged", message, line=rows[0], column=first_column, hint=hint)


def _beside_text(
    file: str, content: bytes, path: str, sheet: str, written: Mapping[tuple[int, int], str]
) -> Iterator[Finding]:
    """A loss for each comment of a cell, and for each link whose address its text does not have."""
    from openpyxl.utils.cell import coordinate_to_tuple

    for cell, text in cell_comments(content, path):
        line, column = coordinate_to_tuple(cell)
        message = f"sheet {sheet!r}: the comment on cell {cell} is not imported: {shown(text)}"
        yield _loss(file, message, line, column)
    for cell, target in cell_links(content, path):
        line, column = coordinate_to_tuple(cell)
        if target.removeprefix("mailto:") not in written.get((line, column), ""):
            message = f"sheet {sheet!r}: the link of cell {cell} is not imported: {shown(target)}"
            yield _loss(file, message, line, column)


def _write_sheet(sheet: Any, part: Part, rows: list[Row]) -> None:
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.styles import Alignment, Font
    from openpyxl.utils import get_column_letter

    attributes = ATTRIBUTES[part]
    for index, attribute in enumerate(attributes, start=1):
        wide = attribute.form is Form.PROSE
        sheet.column_dimensions[get_column_letter(index)].width = _WIDE if wide else _NARROW
    sheet.freeze_panes = "B2"
    aligned, bold = Alignment(vertical="top", wrap_text=True), Font(bold=True)

    def made(text: str) -> Any:
        cell = WriteOnlyCell(sheet, escaped_text(text))
        cell.data_type = "s"  # openpyxl takes what begins with = for a formula
        # Excel then keeps it as text even after the cell is edited.
        cell.quotePrefix = starts_like_a_formula(text)
        cell.alignment = aligned
        return cell

    heads = [made(attribute.name) for attribute in attributes]
    for head in heads:
        head.font = bold
    sheet.append(heads)
    for row in rows:
        cells = [row.cells[attribute.name] for attribute in attributes]
        sheet.append([made(text) if text else None for text in cells])
