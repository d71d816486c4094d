"""Cells of a sheet of a workbook with the formatting that changes their meaning.

A sheet is read row by row, since one that openpyxl loads as a whole needs memory for each cell that a merged range
states. Its interface for that omits the formatting within inline texts and the merged ranges; its parser has both.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from rgss.exchange.plain_forms import PlainText, omitted, shifted_text
from rgss.exchange.tables.number_formats import number_text

_ESCAPED = re.compile("_x(?![dD][89a-fA-F])([0-9a-fA-F]{4})_")
# The x and not the underline before it: openpyxl removes each "x005F_" that it reads.
_TO_ESCAPE = re.compile("[\r\ufdd0-\ufdef\ufffe\uffff]|x(?=005F_)|(?<=_)x(?=[0-9a-fA-F]{4}_)")


def unescaped_text(text: str) -> str:
    """The text of a cell, in whose XML characters may be escaped as ``_x000D_`` (ECMA-376, ST_Xstring)."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def escaped_text(text: str) -> str:
    """A text as the XML of a cell has it, from which `unescaped_text` gives the same text."""
    return _TO_ESCAPE.sub(lambda found: f"_x{ord(found[0]):04X}_", text)


@dataclass(frozen=True, slots=True, kw_only=True)
class FormattedCell:
    """One cell.

    Attributes:
        column: The number of its column.
        value: Its value; a list of formatted pieces if only parts of its text are formatted.
        kind: Its type, by the letter of openpyxl.
        number_format: The format in which a number is shown, in the notation of Excel.
        is_struck: True if its style strikes it out.
    """

    column: int
    value: Any
    kind: str
    number_format: str
    is_struck: bool

    def text(self) -> PlainText:
        """The text of the cell, without what is struck out."""
        if self.value is None:
            return PlainText(text="", losses=())
        if isinstance(self.value, list):
            return self._text_of_pieces()
        plain = self._plain()
        loss = omitted(plain) if self.is_struck else ""
        return PlainText(text="" if loss else plain, losses=(loss,) if loss else ())

    def unformatted(self) -> str:
        """All of the text, as it is written."""
        value = self.value
        return "".join(map(str, value)) if isinstance(value, list) else "" if value is None else str(value)

    def _plain(self) -> str:
        if isinstance(self.value, bool):
            return str(self.value).lower()
        if isinstance(self.value, int | float):
            return number_text(self.value, self.number_format)
        return unescaped_text(str(self.value))

    def _text_of_pieces(self) -> PlainText:
        text, losses = "", []
        for (is_struck, shift), pieces in groupby(self.value, self._formatting):
            said = unescaped_text("".join(map(str, pieces)))
            if is_struck:
                losses.append(omitted(said))
                continue
            if shift and said.strip():
                core = shifted_text(said.strip(), raised=shift == "superscript")
                said = said.replace(said.strip(), core)
            # What is struck out leaves one of the blanks around it.
            text += said.lstrip(" ") if losses and text[-1:] in ("", " ") else said
        found = tuple(loss for loss in losses if loss)
        return PlainText(text=text.rstrip(" ") if found else text, losses=found)

    def _formatting(self, piece: Any) -> tuple[bool, str]:
        """Strike-through of a piece, and its shift; a piece without a font has that of the cell."""
        font = getattr(piece, "font", None)
        return (self.is_struck, "") if font is None else (bool(font.strike), font.vertAlign or "")


class SheetReader:
    """Reader of the rows of a sheet."""

    def __init__(self, workbook: Any, name: str) -> None:
        """Create a reader.

        Args:
            workbook: The workbook, of openpyxl, read only and with rich text.
            name: The name of the sheet.
        """
        from openpyxl.styles.numbers import BUILTIN_FORMATS, BUILTIN_FORMATS_MAX_SIZE

        self._workbook, self._sheet = workbook, workbook[name]
        fonts, styles = workbook._fonts, workbook._cell_styles  # noqa: SLF001 - a cell's own ``font`` reads these
        formats = dict(enumerate(workbook._number_formats, start=BUILTIN_FORMATS_MAX_SIZE)) | BUILTIN_FORMATS  # noqa: SLF001 - the same
        self._formats = [formats.get(style.numFmtId, "General") for style in styles]
        self._struck = {
            number for number, style in enumerate(styles) if style.fontId < len(fonts) and fonts[style.fontId].strike
        }
        self.path: str = self._sheet._worksheet_path  # noqa: SLF001 - its member of the archive
        """Its path in the workbook."""
        self.merged: list[tuple[int, int, int, int]] = []
        """First row, first column, last row and last column of each merged range, once all rows are read."""

    def rows(self) -> Iterator[tuple[int, list[FormattedCell]]]:
        """Number and cells of each row that the file states, in its order."""
        from openpyxl.worksheet._reader import WorkSheetParser

        workbook = self._workbook
        with self._sheet._get_source() as source:  # noqa: SLF001 - as openpyxl iterates over a sheet
            parser = WorkSheetParser(
                source,
                self._sheet._shared_strings,  # noqa: SLF001
                epoch=workbook.epoch,
                date_formats=workbook._date_formats,  # noqa: SLF001
                timedelta_formats=workbook._timedelta_formats,  # noqa: SLF001
                rich_text=True,
            )
            for number, cells in parser.parse():
                yield number, [self._cell(cell) for cell in cells]
        ranges = parser.merged_cells.mergeCell if parser.merged_cells is not None else ()
        self.merged = [(each.min_row, each.min_col, each.max_row, each.max_col) for each in ranges]

    def _cell(self, cell: dict[str, Any]) -> FormattedCell:
        return FormattedCell(
            column=cell["column"],
            value=cell["value"],
            kind=cell["data_type"],
            number_format=self._formats[cell["style_id"]],
            is_struck=cell["style_id"] in self._struck,
        )
