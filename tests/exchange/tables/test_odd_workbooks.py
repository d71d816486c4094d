"""Workbooks as they are found: numbers with a format, hidden sheets, formatting far below the table."""

from __future__ import annotations

from dataclasses import replace

import openpyxl
import pytest
from openpyxl.styles import Font

from rgss.errors import DocumentError
from rgss.exchange import ForeignNames, Part
from rgss.exchange.tables import ForeignTable, excel_bytes, read_excel
from rgss.exchange.tables.number_formats import number_text

NAMES = ForeignNames(attributes={"No": "id", "Limit": "threshold"})


@pytest.fixture
def book():
    made = openpyxl.Workbook()
    made.active.append(["No", "Text", "Limit"])
    made.active.append([7, "The gripper shall hold a cup.", 0.7])
    return made


@pytest.fixture
def read(tmp_path):
    """Read a workbook of another tool."""

    def call(made):
        path = tmp_path / "t.xlsx"
        made.save(path)
        return read_excel(path, ForeignTable(names=NAMES, part=Part.SYSTEM)).rows

    return call


@pytest.mark.parametrize(
    ("value", "number_format", "text"),
    [
        (7, "0000", "0007"),
        (-7, "000", "-007"),
        (7, '"REQ-"0000', "REQ-0007"),
        (0.7, r'0.0\ "kg"', "0.7 kg"),
        (0.123, '0.0" kg"', "0.123 kg"),
        (0.95, "0%", "95%"),
        (0.075, "0%", "7.5%"),
        (1500.5, "#,##0.00\\ [$€-407]", "1500.5 €"),
        (5, "_(* #,##0_)", "5"),
        (12, "[Red]0", "12"),
        (12, '[>5]0" big";0', "12"),
        (-3, '0" up";0" down"', "-3"),
        (0, '0;-0;"none"', "0"),
        (12, "00-00", "12"),
        (0.5, "# ?/?", "0.5"),
        (1e22, '0" kg"', "1e+22"),
        (3.5, "General", "3.5"),
    ],
)
def test_a_number_has_the_text_that_its_format_shows(value, number_format, text):
    assert number_text(value, number_format) == text


def test_ids_and_limits_are_read_as_a_workbook_shows_them(book, read):
    book.active["A2"].number_format = '"REQ-"0000'
    book.active["C2"].number_format = '0.0" kg"'
    (row,) = read(book)
    assert (row.id, row.cells["threshold"]) == ("REQ-0007", "0.7 kg")


def test_a_hidden_first_sheet_is_not_that_of_the_requirements(book, read):
    book.active["A2"] = "REQ-7"
    lists = book.create_sheet("Lists", 0)
    lists.append(["high", "low"])
    lists.sheet_state = "veryHidden"
    assert [row.id for row in read(book)] == ["REQ-7"]


def test_formatting_below_the_table_is_no_row(book, read):
    book.active["A2"] = "REQ-7"
    book.active.cell(1_048_576, 3).font = Font(bold=True)
    assert [row.id for row in read(book)] == ["REQ-7"]


def test_rows_with_content_are_limited_in_number(book, read, monkeypatch):
    monkeypatch.setattr("rgss.exchange.tables.excel_file.MOST_ROWS", 1)
    assert len(read(book)) == 1
    book.active.append([8, "The gripper shall hold a plate.", 1])
    with pytest.raises(DocumentError, match="more than 1 rows"):
        read(book)


def test_characters_that_xml_excludes_are_kept(project, tmp_path):
    first, *others = project.content.rows
    odd = replace(first, cells={**first.cells, "rationale": "a\ufffe\uffff\ufdd0b _xFFFE_"})
    path = tmp_path / "t.xlsx"
    path.write_bytes(excel_bytes(replace(project.content, rows=(odd, *others))))
    assert next(row for row in read_excel(path).rows if row.id == odd.id).cells == odd.cells
