"""Tables whose columns another tool has named."""

from __future__ import annotations

from dataclasses import replace

import openpyxl
import pytest

from rgss.exchange import ForeignNames, Part, with_values_mapped
from rgss.exchange.tables import ForeignTable, csv_text, read_csv, read_excel

HEADS = ["ID", "Heading", "Object Text", "Rationale", "Type", "Prio", "Derived From", "Changed"]
ROWS = (
    ["SYS-1", "", "The task shall end within 30 s.", "", "Requirement", "", "STK-2", "yesterday"],
    ["SYS-9", "", "The gripper shall hold 3 kg.", "Heavy.", "Requirement", "1", "STK-1, STK-2", ""],
    ["SYS-8", "Grip", "", "", "Heading", "", "", ""],
    ["SYS-7", "", "See the drawing.", "", "Info", "", "", ""],
    ["", "", "A line without an id", "", "", "", "", ""],
)
MAPPED = {"Object Text": "text", "Prio": "priority", "Type": "part", "Changed": ""}
VALUES = {"part": {"Requirement": "system"}, "priority": {"1": "high", "2": "low"}}
NAMES = ForeignNames(attributes=MAPPED, values=VALUES)
DEFAULTS = {"group": "gripper", "source": "DOORS", "status": "draft", "owner": "me", "rationale": "Unknown."}
DEFAULTS |= {"verification": "test", "facility": "Bench", "phase": "qualification", "success": "It holds."}


@pytest.fixture(params=["csv", "xlsx"])
def table(tmp_path, request):
    """Function that reads rows from a file of each format."""

    def read(rows=ROWS, heads=HEADS, *, names=NAMES, **known):
        path = tmp_path / f"t.{request.param}"
        if request.param == "csv":
            lines = [";".join(f'"{cell}"' for cell in row) for row in (heads, *rows)]
            path.write_text("\n".join(lines), encoding="utf-8")
        else:
            book = openpyxl.Workbook()
            for row in (heads, *rows):
                book.active.append(row)
            book.save(path)
        reader = read_csv if request.param == "csv" else read_excel
        return with_values_mapped(reader(path, ForeignTable(names=names, **known)), names)

    return read


def without_sheets(notes):
    return [note.removeprefix("sheet 'Sheet': ") for note in notes]


def test_columns_are_what_they_are_mapped_to(project, table):
    foreign = table()
    assert [(row.id, row.part, row.cells["text"]) for row in foreign.rows] == [
        ("SYS-1", Part.SYSTEM, "The task shall end within 30 s."),
        ("SYS-9", Part.SYSTEM, "The gripper shall hold 3 kg."),
    ]
    assert foreign.rows[1].cells["priority"] == "high"
    assert foreign.rows[1].cells["derived_from"] == "STK-1; STK-2"
    changed, added = project.compare(foreign, defaults={**DEFAULTS, "priority": "low"})
    # An empty cell of the table is the default.
    assert {each.attribute.name: each.new for each in changed.attributes} == {
        "text": "The task shall end within 30 s.",
        "rationale": "Unknown.",
        "priority": "low",
    }
    assert (added.id, added.entry["owner"]) == ("SYS-9", "me")


def test_rows_and_columns_that_are_not_imported_are_noted(table):
    assert sorted(without_sheets(table().notes)) == [
        "1 row is not imported: 'Info' is no part (--map-value 'part:Info=…' takes such)",
        "1 row is not imported: no id",
        "1 row is not imported: no text",
        "the column 'Heading' is not imported: rgss has none of that name (--map 'Heading=…' takes it)",
    ]


def test_elements_that_the_table_of_another_tool_lacks_are_not_removed(project, table):
    assert [change.kind.value for change in project.compare(table(), defaults={**DEFAULTS, "priority": "low"})] == [
        "changed",
        "added",
    ]


def test_a_part_follows_from_the_project_or_is_given(table):
    names = ForeignNames(attributes={"Object Text": "text", "Prio": "", "Type": "", "Changed": ""})
    foreign = table(ROWS[:2], names=names, known={"SYS-1": Part.SYSTEM}, part=Part.STAKEHOLDER)
    assert [row.part for row in foreign.rows] == [Part.SYSTEM, Part.STAKEHOLDER]
    (loss,) = foreign.losses
    assert (loss.line, loss.message) == (
        3,
        "SYS-9: a stakeholder requirement has no 'derived_from': 'STK-1; STK-2' is omitted",
    )


def test_a_table_without_ids_names_the_likely_option(table, refused):
    (line,) = refused(table, heads=["Object Identifier", *HEADS[1:]])
    assert line.endswith("no column has the ids (give --map 'Object Identifier=id') [exchange.column]")


def test_two_columns_for_one_attribute_are_refused(table, refused):
    names = ForeignNames(attributes={"Heading": "text", "Object Text": "text"})
    (line,) = refused(table, names=names)
    assert line.endswith(
        "the columns 'Heading' and 'Object Text' are both the text (map one of them) [exchange.column]"
    )


def test_what_no_mapped_column_has_may_be_anything(table):
    """A date or a formula in a column that is not imported does not matter."""
    rows = [[*ROWS[0][:7], "=1+1"]]
    assert [row.id for row in table(rows).rows] == ["SYS-1"]


def test_a_table_of_rgss_is_the_same_with_a_mapping(project, tmp_path):
    (tmp_path / "t.csv").write_text(csv_text(project.content), encoding="utf-8", newline="")
    foreign = read_csv(tmp_path / "t.csv", ForeignTable(names=ForeignNames(), part=Part.SYSTEM))
    assert project.compare(foreign) == ()
    assert {Part.STAKEHOLDER, Part.SYSTEM} <= foreign.whole


def test_numbers_are_ids_with_a_prefix(project, table):
    """Ids that begin with a letter are those of rgss already, so that an export can be imported again."""
    rows = [
        ["12", "", "The gripper shall hold 3 kg.", "Heavy.", "Requirement", "1", "13, STK-2", ""],
        ["13", "", "The gripper shall hold 4 kg.", "Heavy.", "Requirement", "1", "7", ""],
    ]
    names = replace(NAMES, id_prefix="DOORS-", values={**VALUES, "derived_from": {"7": "STK-1"}})

    def read():
        return table(rows, names=names)

    assert {row.id: row.cells["derived_from"] for row in read().rows} == {
        "DOORS-12": "DOORS-13; STK-2",
        "DOORS-13": "STK-1",
    }
    project.apply(read(), defaults=DEFAULTS, remove=False)
    assert project.compare(read(), defaults=DEFAULTS) == ()
    path = project.folder / "back.csv"
    path.write_text(csv_text(project.content), encoding="utf-8", newline="")
    back = read_csv(path, ForeignTable(names=ForeignNames(id_prefix="DOORS-")))
    assert project.compare(back) == ()


def test_an_id_and_the_same_with_the_prefix_are_duplicates(project, table, refused):
    rows = [[each, "", "It shall hold.", "Heavy.", "Requirement", "1", "STK-2", ""] for each in ("12", "DOORS-12")]
    (line,) = refused(project.compare, table(rows, names=replace(NAMES, id_prefix="DOORS-")), defaults=DEFAULTS)
    assert "'DOORS-12' is already in line" in line


def test_an_id_that_is_a_number_names_the_option(project, table, refused):
    rows = [["12", "", "It shall hold.", "Heavy.", "Requirement", "1", "STK-2", ""]]
    (line,) = refused(project.compare, table(rows), defaults=DEFAULTS)
    assert line.endswith("(give --id-prefix, such as --id-prefix SYS-) [exchange.value]")


def test_line_breaks_of_other_systems_within_a_cell_are_line_breaks(tmp_path):
    path = tmp_path / "t.csv"
    path.write_bytes(b'ID,Object Text\r\nSYS-1,"One\r\nTwo\rThree\nFour"\r\n')
    (row,) = read_csv(path, ForeignTable(names=NAMES)).rows
    assert row.cells["text"] == "One\nTwo\nThree\nFour"
