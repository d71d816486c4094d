"""Tables of requirements, written and read, with the csv module and openpyxl as judges."""

from __future__ import annotations

import csv
import io
import re
import sys
import zipfile

import openpyxl
import pytest

from rgss.errors import DefinitionError
from rgss.exchange import ForeignNames, tables
from rgss.exchange.content import Content, Row
from rgss.exchange.tables import ForeignTable, csv_text, excel_bytes, read_csv, read_excel


@pytest.fixture
def written(project, tmp_path):
    """Both tables of the project as files."""
    (tmp_path / "t.csv").write_text(csv_text(project.content), encoding="utf-8-sig", newline="")
    (tmp_path / "t.xlsx").write_bytes(excel_bytes(project.content))
    return tmp_path


def changed_book(path, change):
    book = openpyxl.load_workbook(path)
    change(book)
    book.save(path)
    return path


def rewritten(path, *, old, new):
    """The workbook with one of its parts changed."""
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content.replace(old, new))
    return path


def test_an_empty_cell_is_the_default_whatever_the_element_had(project, written, refused):
    """The result follows from the file and the options alone, so that the same import twice changes nothing."""
    path = written / "t.csv"
    text = path.read_text(encoding="utf-8-sig")
    assert text.count(",low,draft,") == 1
    path.write_text(text.replace(",low,draft,", ",low,,"), encoding="utf-8", newline="")

    (line,) = refused(project.compare, read_csv(path), defaults={"owner": "me"})
    assert line.endswith("SYS-2: status: is missing (fill it in, or give --default status=…) [exchange.value]")
    (change,) = project.compare(read_csv(path), defaults={"status": "approved"})
    assert [(each.old, each.new) for each in change.attributes] == [("draft", "approved")]
    assert project.compare(read_csv(path), defaults={"status": "draft"}) == ()


def test_an_attribute_with_a_default_is_emptied_by_an_empty_default(project, written):
    path = written / "t.csv"
    text = path.read_text(encoding="utf-8-sig")
    path.write_text(text.replace("STK-1,BLK-gripper", ",BLK-gripper"), encoding="utf-8", newline="")

    assert [change.id for change in project.compare(read_csv(path), defaults={"traces": "STK-1"})] == ["SYS-1"]
    (change,) = project.compare(read_csv(path), defaults={"traces": ""})
    assert [(each.attribute.name, each.new) for each in change.attributes] == [("traces", "")]


def test_another_reader_finds_every_requirement_in_the_csv(project):
    rows = list(csv.DictReader(io.StringIO(csv_text(project.content))))
    assert [(row["part"], row["id"]) for row in rows] == [
        ("stakeholder", "STK-1"),
        ("stakeholder", "STK-2"),
        ("system", "SYS-1"),
        ("system", "SYS-2"),
    ]
    assert rows[3]["derived_from"] == "STK-2; SYS-1"
    assert [rows[2][name] for name in ("measure", "statistic", "comparison", "threshold")] == [
        "t_e",
        "value",
        "<=",
        "25 s",
    ]
    assert rows[1]["rationale"] == "Coffee gets cold.\n\nSee the report; page 2 \\ 3.  Two  blanks."


def test_no_cell_of_the_csv_is_a_formula(project):
    cells = [cell for row in csv.reader(io.StringIO(csv_text(project.content))) for cell in row]
    assert not [cell for cell in cells if cell.startswith(("=", "+", "-", "@", "\t", "\r"))]
    assert "'@The rest of the time is for the arm." in cells


def test_no_cell_of_the_workbook_is_a_formula(project, written):
    book = openpyxl.load_workbook(written / "t.xlsx")
    assert book.sheetnames == ["stakeholder", "system"]
    cells = [cell for sheet in book for row in sheet.iter_rows() for cell in row if cell.value is not None]
    assert {cell.data_type for cell in cells} == {"s"}
    assert all(cell.quotePrefix for cell in cells if cell.value.startswith(("=", "@")))
    assert book["stakeholder"]["E2"].value.startswith("=HYPERLINK(")
    assert [cell.value for cell in book["system"]["A"]] == ["id", "SYS-1", "SYS-2"]


def test_what_is_written_reads_back_as_no_change(project, written):
    assert project.compare(read_csv(written / "t.csv")) == ()
    assert project.compare(read_excel(written / "t.xlsx")) == ()
    assert excel_bytes(project.content) == excel_bytes(project.content)


def test_texts_with_apostrophes_and_formulas_come_back(tmp_path):
    cells = {"id": "A", "text": "'=1", "rationale": "''+1", "source": "'tis", "owner": "-1"}
    content = Content(rows=(Row(part=next(iter(tables.heads.PARTS)), cells=cells),))
    (tmp_path / "t.csv").write_text(csv_text(content), encoding="utf-8", newline="")
    (row,) = read_csv(tmp_path / "t.csv").rows
    assert {name: row.cells[name] for name in cells} == cells


def test_other_orders_dividers_and_byte_order_marks_are_read(project, tmp_path):
    rows = list(csv.reader(io.StringIO(csv_text(project.content))))
    out = io.StringIO(newline="")
    csv.writer(out, delimiter=";").writerows([[*row[::-1]] for row in rows])
    (tmp_path / "t.csv").write_text(out.getvalue() + ";;;\r\n\r\n", encoding="utf-8-sig", newline="")
    assert project.compare(read_csv(tmp_path / "t.csv")) == ()


@pytest.mark.parametrize("divider", [";", "\t", ","])
@pytest.mark.parametrize("first", ["", "sep={}\r\n", '"sep={}"\n'])
def test_a_separator_may_be_stated_or_stand_beside_others_in_quoted_heads(project, tmp_path, divider, first):
    """Excel reads and writes the line that states it."""
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=divider, lineterminator="\r\n")
    heads, *rows = csv.reader(io.StringIO(csv_text(project.content)))
    writer.writerow([*heads, "Notes; remarks, and\tmore" + ",;" * 40])
    writer.writerows([*row, ""] for row in rows)
    path = tmp_path / "t.csv"
    path.write_text(first.format(divider) + out.getvalue(), encoding="utf-8", newline="")
    assert project.compare(read_csv(path, ForeignTable(names=ForeignNames()))) == ()


def test_numbers_truth_values_and_other_sheets_of_a_workbook(project, written):
    def change(book):
        book["system"]["P2"] = 25
        book.create_sheet("notes")["A1"] = "mine"

    foreign = read_excel(changed_book(written / "t.xlsx", change))
    assert foreign.notes == ("the sheet 'notes' is not imported",)
    (found,) = project.compare(foreign)
    assert [(each.attribute.name, each.old, each.new) for each in found.attributes] == [("threshold", "25 s", "25")]


def test_markup_stays_text(project, written):
    foreign = read_excel(written / "t.xlsx")
    assert foreign.rows[0].cells["rationale"] == '=HYPERLINK("http://example.org"; "Guests <b>want</b> & get it")'


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        (b"status", b"state", "column 'status' missing from the first row"),
        (b"part,id", b"id,id", "column 'part' missing from the first row"),
        (b",text,", b",extra,", "column 'text' missing from the first row"),
        (
            b"stakeholder,STK-2",
            b"stakeholder,STK-1",
            "t.csv:3:2: error: 'STK-1' is already in line 2 \\[exchange.duplicate\\]",
        ),
        (b"medium", b"urgent", "STK-2: priority: 'urgent' is not one of 'high', 'medium' or 'low'"),
        (b"stakeholder,STK-2", b"user,STK-2", "part: 'user' is not one of stakeholder, system"),
        (b"system,SYS-2,,gripper", b"system,SYS-2,design,gripper", "SYS-2: a system requirement has no 'kind'"),
        (b"system,SYS-2,,gripper", b"system,SYS-2,gripper", "24 cells are expected, 23 found"),
        (b"SYS-2", b"", "an element without an id"),
        (b"BLK-arm; SEQ-lift", b"BLK-leg", "SYS-1: satisfied_by: unknown element 'BLK-leg'"),
        (b",SYS-1,The gripper", b",SYS-9,The gripper", "SYS-2: parent: unknown element 'SYS-9'"),
        (b"25 s,", b"fast,", "SYS-1: threshold: "),
        (b"<=", b"~", "SYS-1: comparison: '~' is not one of"),
        (b"Simulation", b"Simu\x07lation", "SYS-1: facility: a control character is not text"),
        (b"Simulation", b"Simu\xfclation", "t.csv:\\d+:1: error: is not UTF-8 \\(save it as CSV UTF-8\\)"),
        (b'"When', b'"When" ', "not CSV: a quotation mark within a quoted cell must be doubled"),
        (b"gripper engineer", b'"gripper engineer', "not CSV: a cell that begins with a quotation mark has no closing"),
        (b"Catalogue", b"C" * 140_000, "not CSV: a cell must have at most 131072 characters"),
        (b"Catalogue", b"Cata\rlogue", "not CSV: |cells are expected"),
    ],
)
def test_a_csv_that_is_wrong_is_one_line_each(project, tmp_path, refused, old, new, complaint):
    content = csv_text(project.content).encode("utf-8")
    assert old in content
    path = tmp_path / "t.csv"
    path.write_bytes(content.replace(old, new, 1))
    lines = refused(lambda: project.compare(read_csv(path)))
    assert re.search(complaint, lines[0]), lines
    assert all(line.startswith(f"{path}:") and "\n" not in line for line in lines)


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_a_unicode_text_of_excel_is_read(project, tmp_path, refused, encoding):
    path = tmp_path / "t.csv"
    path.write_bytes(("\ufeff" + csv_text(project.content)).encode(encoding))
    assert project.compare(read_csv(path)) == ()
    path.write_bytes(path.read_bytes()[:-1])
    (line,) = refused(read_csv, path)
    assert "is not UTF-16 (save it as CSV UTF-8)" in line


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda book: book["system"].delete_cols(3), "sheet 'system': column 'parent' missing from the first row"),
        (lambda book: book.remove(book["system"]), "there is no sheet 'system' (sheets: stakeholder)"),
        (lambda book: book["system"].delete_rows(1, 9), "sheet 'system': columns 'id', 'group', "),
        (lambda book: setattr(book["system"]["D2"], "value", "=1+1"), "row 2: the cell holds a formula, not a text"),
        (lambda book: setattr(book["system"]["A3"], "value", "SYS-1"), "'SYS-1' is already in line 2"),
        (lambda book: setattr(book["system"]["A1"], "value", "name"), "sheet 'system': column 'id' missing"),
    ],
)
def test_a_workbook_that_is_wrong_is_one_line_each(project, written, refused, change, complaint):
    path = changed_book(written / "t.xlsx", change)
    lines = refused(lambda: project.compare(read_excel(path)))
    assert complaint in lines[0]
    assert all(line.startswith(f"{path}:") and "\n" not in line for line in lines)


def test_a_zip_bomb_is_refused_before_it_unpacks(tmp_path, refused):
    path = tmp_path / "bomb.xlsx"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/workbook.xml", b"0" * (80 * 1024 * 1024))
    assert path.stat().st_size < 200_000
    assert "would unpack to more than 64 MiB" in refused(read_excel, path)[0]


def test_entities_in_a_workbook_are_refused(written, refused):
    bomb = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]>'
    path = rewritten(written / "t.xlsx", old=b"<workbook ", new=bomb + b"<workbook ")
    assert "has a document type" in refused(read_excel, path)[0]


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"id,text\n1,2\n"])
def test_what_is_no_workbook(tmp_path, refused, content):
    (tmp_path / "t.xlsx").write_bytes(content)
    assert "is not an Excel file" in refused(read_excel, tmp_path / "t.xlsx")[0]


def test_a_zip_that_is_no_workbook(tmp_path, refused):
    with zipfile.ZipFile(tmp_path / "t.xlsx", "w") as archive:
        archive.writestr("a.txt", "a")
    assert "is not a workbook that can be read" in refused(read_excel, tmp_path / "t.xlsx")[0]


def test_a_sheet_may_lie_about_its_size(project, written):
    rewritten(written / "t.xlsx", old=b"<sheetData", new=b'<dimension ref="A1:XFD1048576"/><sheetData')
    assert project.compare(read_excel(written / "t.xlsx")) == ()


def test_files_that_are_not_there(tmp_path, refused):
    assert "cannot be read: No such file" in refused(read_csv, tmp_path / "none.csv")[0]
    assert "is a folder, not a file" in refused(read_excel, tmp_path)[0]


def test_a_text_longer_than_a_cell_is_not_cut():
    part = next(iter(tables.heads.PARTS))
    row = Row(
        part=part, cells={name: "x" * 40_000 if name == "text" else "A" for name in tables.heads.columns_of(part)}
    )
    with pytest.raises(DefinitionError, match="A: text is longer than a cell of Excel holds"):
        excel_bytes(Content(rows=(row,)))


def test_openpyxl_is_asked_for_in_one_line(monkeypatch, project):
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(DefinitionError, match=r"needs the package openpyxl.*pip install 'rgss\[exchange\]'"):
        excel_bytes(project.content)


def test_columns_that_are_too_many_are_named(project, tmp_path, refused):
    text = csv_text(project.content)
    (tmp_path / "t.csv").write_text(text.replace("\r\n", ",text,mine\r\n", 1), encoding="utf-8", newline="")
    twice, unknown = refused(read_csv, tmp_path / "t.csv")
    assert "duplicate column 'text' (keep one) [exchange.column]" in twice
    assert "unknown column 'mine' (for a table of another tool give --map 'mine=…')" in unknown


def test_what_a_foreign_file_holds_does_not_steer_a_terminal(project, tmp_path, refused):
    text = csv_text(project.content).replace("STK-2", "STK-2\x1b[31m", 1)
    (tmp_path / "t.csv").write_text(text, encoding="utf-8", newline="")
    lines = refused(lambda: project.compare(read_csv(tmp_path / "t.csv")))
    assert "STK-2\ufffd[31m: id: " in lines[0]


def test_of_very_many_problems_the_first_are_shown(project, tmp_path, refused):
    lines = csv_text(project.content).splitlines(keepends=True)
    wrong = lines[1].replace("high", "urgent")
    many = [wrong.replace("STK-1", f"STK-{number}", 1) for number in range(1100)]
    (tmp_path / "t.csv").write_text("".join([lines[0], *many]), encoding="utf-8", newline="")
    found = refused(lambda: project.compare(read_csv(tmp_path / "t.csv")))
    assert len(found) == 1001
    assert "more than 1000 problems; the first 1000 are shown (correct these first) [exchange.many]" in found[0]
    (tmp_path / "t.csv").write_text("a," * 200_000, encoding="utf-8")
    assert "more than 100 columns" in refused(read_csv, tmp_path / "t.csv")[0]
