"""Tables as Markdown, CSV and Excel: what they hold is text, and the same tables give the same bytes."""

from __future__ import annotations

import builtins
import csv
import io
import zipfile
from datetime import datetime

import pytest
from openpyxl import load_workbook

from rgss.documents.spreadsheet_cells import LONGEST_EXCEL_TEXT
from rgss.errors import DefinitionError
from rgss.reports.table_files import to_csv, to_excel, to_markdown
from rgss.reports.tables import Table, cell_text, chosen_table

HOSTILE = ["=1+1", "@x", "-2", "a|b", "<b>&", "`x`", "[a](b)", 'say "hi", please', "two\nlines", "🤖 𝔘", "a\\b", "*_~"]


@pytest.fixture
def table() -> Table:
    return Table(
        name="hostile",
        title="Hostile | texts",
        heads=("id", "text", "=A1"),
        rows=[(f"r{index}", text, None) for index, text in enumerate(HOSTILE)] + [("numbers", "x", -1.5)],
        note="A note with <tags>.",
    )


def test_csv_gives_every_text_back_but_for_the_apostrophe(table):
    heads, *rows = csv.reader(io.StringIO(to_csv(table), newline=""))

    assert heads == ["id", "text", "'=A1"]
    assert [row[1] for row in rows[:-1]] == [f"'{text}" if text[0] in "=@-" else text for text in HOSTILE]
    assert rows[-1] == ["numbers", "x", "-1.5"]
    assert to_csv(table).count("\r\n") == len(HOSTILE) + 2


def test_excel_holds_texts_as_texts(table):
    workbook = load_workbook(io.BytesIO(to_excel([table])))
    sheet = workbook["hostile"]

    assert [sheet.cell(row=row + 2, column=2).value for row in range(len(HOSTILE))] == HOSTILE
    assert {sheet.cell(row=row + 2, column=2).data_type for row in range(len(HOSTILE))} == {"s"}
    quoted = [sheet.cell(row=row + 2, column=2).quotePrefix for row in range(len(HOSTILE))]
    assert quoted == [text[0] in "=@-" for text in HOSTILE]
    assert (sheet["C1"].value, sheet["C1"].data_type, sheet["C2"].value) == ("=A1", "s", None)
    assert sheet.cell(row=len(HOSTILE) + 2, column=3).value == -1.5
    assert (sheet.freeze_panes, sheet.auto_filter.ref) == ("B2", f"A1:C{len(HOSTILE) + 2}")
    assert sheet.column_dimensions["B"].width == 60
    with zipfile.ZipFile(io.BytesIO(to_excel([table]))) as archive:
        assert b"<f>" not in archive.read("xl/worksheets/sheet1.xml")


def test_columns_of_marks_are_narrow_and_stay_beside_the_texts():
    rows = [("r", "t", "x", None), ("s", "t", None, "x")]
    marks = Table(name="m", title="M", heads=("id", "text", "a", "b"), rows=rows, marks_from=2)
    sheet = load_workbook(io.BytesIO(to_excel([marks])))["m"]

    assert sheet.freeze_panes == "C2"
    assert (sheet.column_dimensions["C"].width, sheet["C1"].alignment.textRotation) == (5, 90)


def test_an_excel_file_does_not_say_when_it_was_made(table):
    content = to_excel([table])
    workbook = load_workbook(io.BytesIO(content))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        times = {entry.date_time for entry in archive.infolist()}

    assert times == {(1980, 1, 1, 0, 0, 0)}
    assert workbook.properties.created == workbook.properties.modified == datetime(1980, 1, 1)
    assert to_excel([table]) == content


def test_a_text_longer_than_a_cell_says_that_it_is_cut():
    long = Table(name="long", title="", heads=("text",), rows=[("a" * LONGEST_EXCEL_TEXT,), ("a" * 40_000,)])
    sheet = load_workbook(io.BytesIO(to_excel([long])))["long"]

    assert sheet["A2"].value == "a" * LONGEST_EXCEL_TEXT
    assert len(sheet["A3"].value) == LONGEST_EXCEL_TEXT
    assert sheet["A3"].value.endswith("a … (cut: longer than a cell holds)")


def test_markdown_shows_what_it_holds_as_text(table):
    text = to_markdown([table], title="T <i>")
    lines = text.splitlines()

    assert lines[0] == "# T \\<i\\>"
    assert "## Hostile \\| texts" in lines
    assert "| r3 | a\\|b |  |" in lines
    assert "| r4 | \\<b\\>\\& |  |" in lines
    assert "| r6 | \\[a\\](b) |  |" in lines
    assert "| r8 | two lines |  |" in lines
    assert "| numbers | x | -1.5 |" in lines
    assert {line.replace("\\|", "").count("|") for line in lines if line.startswith("|")} == {4}


def test_a_table_without_rows_is_its_note():
    assert to_markdown([Table(name="g", title="Gaps", heads=("id",), rows=[], note="None.")], title="T") == (
        "# T\n\n## Gaps\n\nNone.\n"
    )


def test_without_openpyxl_one_line_says_what_to_do(table, monkeypatch):
    without(monkeypatch, "openpyxl")
    with pytest.raises(DefinitionError) as caught:
        to_excel([table])

    assert str(caught.value) == (
        "an Excel file needs the package openpyxl, which is not installed (pip install openpyxl)"
    )


def test_cells_as_text():
    assert [cell_text(cell) for cell in (None, "a", 3, 0.1)] == ["", "a", "3", "0.1"]


def test_a_table_that_is_not_there(table):
    assert chosen_table((table,), "hostile") == chosen_table((table,), "") == (table,)
    with pytest.raises(DefinitionError) as caught:
        chosen_table((table,), "matrix")
    assert str(caught.value) == "unknown table 'matrix' (tables: hostile)"


def without(monkeypatch, package: str) -> None:
    """Make a package one that is not installed."""
    original = builtins.__import__

    def refuse(name, *arguments, **options):
        if name.split(".")[0] == package:
            raise ImportError(name)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", refuse)
