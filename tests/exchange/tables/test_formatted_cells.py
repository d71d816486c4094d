"""Formatting of cells that changes their meaning, in workbooks that openpyxl writes."""

from __future__ import annotations

import re
import zipfile
from dataclasses import replace

import openpyxl
import pytest
from lxml import etree
from openpyxl.cell.rich_text import CellRichText, TextBlock
from openpyxl.cell.text import InlineFont
from openpyxl.comments import Comment
from openpyxl.styles import Font

from rgss.exchange.reqif.prose import from_xhtml
from rgss.exchange.tables import excel_bytes, read_excel


def struck(text):
    return TextBlock(InlineFont(strike=True), text)


def shifted(text, how):
    return TextBlock(InlineFont(vertAlign=how), text)


@pytest.fixture
def read(project, tmp_path):
    """Read the project's workbook after a change of its sheet of system requirements."""

    def call(change, *, is_shared=False):
        path = tmp_path / "t.xlsx"
        path.write_bytes(excel_bytes(project.content))
        book = openpyxl.load_workbook(path)
        change(book["system"])
        book.save(path)
        if is_shared:
            with_shared_strings(path)
        return read_excel(path)

    return call


def column_of(sheet, name):
    return next(cell.column for cell in sheet[1] if cell.value == name)


def set_text(value):
    def change(sheet):
        sheet.cell(2, column_of(sheet, "text")).value = value

    return change


def with_shared_strings(path):
    """The workbook with its texts in the table that Excel writes; openpyxl writes them into the cells."""
    texts = []

    def shared(match):
        texts.append(match[2])
        return f'{match[1]} t="s"><v>{len(texts) - 1}</v></c>'

    main, office = "http://schemas.openxmlformats.org/spreadsheetml/2006/main", "officeDocument"
    kind = "application/vnd.openxmlformats-officedocument.spreadsheetml.sharedStrings+xml"
    relation = f"http://schemas.openxmlformats.org/{office}/2006/relationships/sharedStrings"
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name).decode("utf-8") for name in archive.namelist()}
    for name in [name for name in parts if name.startswith("xl/worksheets/")]:
        parts[name] = re.sub(r'(<c [^>]*?) t="inlineStr"><is>(.*?)</is></c>', shared, parts[name])
    parts["xl/sharedStrings.xml"] = f'<sst xmlns="{main}">{"".join(f"<si>{text}</si>" for text in texts)}</sst>'
    override = f'<Override PartName="/xl/sharedStrings.xml" ContentType="{kind}"/></Types>'
    parts["[Content_Types].xml"] = parts["[Content_Types].xml"].replace("</Types>", override)
    relations = f'<Relationship Id="rIdS" Type="{relation}" Target="sharedStrings.xml"/></Relationships>'
    parts["xl/_rels/workbook.xml.rels"] = parts["xl/_rels/workbook.xml.rels"].replace("</Relationships>", relations)
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in parts.items():
            archive.writestr(name, text)
    assert len(texts) > 30


@pytest.mark.parametrize(
    ("pieces", "markup"),
    [
        (["10", shifted("3", "superscript"), " N"], "10<sup>3</sup> N"),
        (["10", shifted("-", "superscript"), shifted("3", "superscript"), " m"], "10<sup>-3</sup> m"),
        (["10", shifted("3 ", "superscript"), "N"], "10<sup>3</sup> N"),
        (["F", shifted("N,Z", "subscript"), " of 3 N"], "F<sub>N,Z</sub> of 3 N"),
        (["H", shifted("2", "subscript"), "O"], "H<sub>2</sub>O"),
        (["1", shifted("st", "superscript"), " joint"], "1<sup>st</sup> joint"),
        (["at ", struck("5"), "6 s"], "at <del>5</del>6 s"),
        (["103 N.", struck(" The robot shall fly.")], "103 N.<s> The robot shall fly.</s>"),
        (["at ", struck("5 s"), " rest"], "at <s>5 s</s> rest"),
        ([struck("old"), " new"], "<s>old</s> new"),
        ([TextBlock(InlineFont(b=True), "The"), " arm"], "<b>The</b> arm"),
    ],
)
@pytest.mark.parametrize("is_shared", [False, True])
def test_formatting_means_in_a_cell_what_it_means_in_reqif(read, pieces, markup, is_shared):
    content = read(set_text(CellRichText(pieces)), is_shared=is_shared)

    node = etree.fromstring(f'<THE-VALUE><div xmlns="http://www.w3.org/1999/xhtml">{markup}</div></THE-VALUE>')
    oracle = from_xhtml(node, exact=False)
    row = next(row for row in content.rows if row.id == "SYS-1")
    assert row.cells["text"] == oracle.text
    assert [loss.message for loss in content.losses] == [f"SYS-1: text: {loss}" for loss in oracle.losses]


def test_a_cell_that_is_struck_out_is_omitted_and_reported(read):
    def change(sheet):
        sheet.cell(2, column_of(sheet, "rationale")).font = Font(strike=True)

    content = read(change)
    (loss,) = content.losses
    assert next(row for row in content.rows if row.id == "SYS-1").cells["rationale"] == ""
    assert loss.message == "SYS-1: rationale: the struck-out text 'Two tasks serve one order.' is omitted"
    assert loss.line == 2


def test_a_text_that_only_had_struck_out_content_says_so_where_it_is_missing(project, read, refused):
    why, missing = refused(lambda: project.compare(read(set_text(CellRichText([struck("The arm shall stop.")])))))
    assert "SYS-1: text: is missing" in missing
    assert "SYS-1: text: the struck-out text 'The arm shall stop.' is omitted" in why


def test_a_struck_out_row_is_omitted_and_reported(project, read):
    def change(sheet):
        for cell in sheet[3]:
            cell.font = Font(strike=True)

    content = read(change)
    assert [loss.message for loss in content.losses] == [
        "sheet 'system': row 3: SYS-2 is struck out, and the row is omitted"
    ]
    assert [(change.kind.value, change.id) for change in project.compare(content)] == [("removed", "SYS-2")]


def test_the_formatting_of_the_first_row_has_no_meaning(project, read):
    def change(sheet):
        for cell in sheet[1]:
            cell.font = Font(strike=True)

    assert project.compare(read(change)) == ()


@pytest.mark.parametrize(
    ("cells", "message"),
    [
        ("{source}2:{source}3", "rows 2 to 3: the cells of 'source' are merged, and only the first has the text"),
        ("{source}2:{after}2", "row 2: the cells of 'source' and 'derived_from' are merged, and only the first"),
    ],
)
def test_merged_cells_are_refused_by_name(project, read, refused, cells, message):
    def change(sheet):
        number = column_of(sheet, "source")
        letters = {"source": sheet.cell(1, number).column_letter, "after": sheet.cell(1, number + 1).column_letter}
        sheet.merge_cells(cells.format(**letters))

    (line,) = refused(lambda: project.compare(read(change)))
    assert message in line
    assert line.endswith("(unmerge them, and fill in each) [exchange.merged]")


def test_merged_cells_beside_the_requirements_have_no_meaning(project, read):
    assert project.compare(read(lambda sheet: sheet.merge_cells("AA2:AC3"))) == ()


def test_a_comment_on_a_cell_is_reported_as_lost(read):
    def change(sheet):
        sheet.cell(2, column_of(sheet, "text")).comment = Comment("please change\nto 0.9 kg", "A reviewer")

    foreign = read(change)

    (loss,) = foreign.losses
    assert loss.message.startswith("sheet 'system': the comment on cell ")
    assert loss.message.endswith(" is not imported: 'please change to 0.9 kg'")
    assert (loss.line, loss.severity.value) == (2, "warning")


def test_a_link_on_a_cell_is_reported_as_lost_unless_its_text_is_the_address(read):
    def change(sheet):
        sheet.cell(2, column_of(sheet, "text")).hyperlink = "https://example.org/spec#4"
        source = sheet.cell(2, column_of(sheet, "source"))
        source.value = source.hyperlink = "https://example.org/norm"

    (loss,) = read(change).losses
    assert loss.message.startswith("sheet 'system': the link of cell ")
    assert loss.message.endswith("is not imported: 'https://example.org/spec#4'")


def test_a_sheet_without_comments_loses_nothing(read):
    assert read(lambda _: None).losses == ()


@pytest.mark.parametrize("is_shared", [False, True])
@pytest.mark.parametrize(
    ("stored", "text"),
    [
        ("One_x000D_\nTwo", "One\r\nTwo"),
        ("max_xDE41_min", "max_xDE41_min"),
        ("max_x_min", "max_x_min"),
        (CellRichText("One", TextBlock(InlineFont(b=True), "_x0041_")), "OneA"),
    ],
)
def test_characters_that_a_cell_escapes_are_read(read, stored, text, is_shared):
    row = next(row for row in read(set_text(stored), is_shared=is_shared).rows if row.id == "SYS-1")
    assert row.cells["text"] == text


def test_a_text_that_looks_escaped_comes_back(project, tmp_path):
    texts = ("max_x000D_min", "One\r\nTwo", "_x005F_x0041_", "_x_x0041_", "max005F_b")
    content = project.content
    (first, *_), last = content.rows[2:], content.rows[:2]
    for text in texts:
        path = tmp_path / "t.xlsx"
        path.write_bytes(
            excel_bytes(replace(content, rows=(*last, replace(first, cells={**first.cells, "text": text}))))
        )
        assert next(row for row in read_excel(path).rows if row.id == "SYS-1").cells["text"] == text
