"""``rgss import`` of files whose names are those of another tool."""

from __future__ import annotations

import pytest

TABLE = (
    "Identifier,Object Text,Priority,Verification Method,Changed\n"
    "SYS-901,The gripper shall hold 3 kg.,Mandatory,T,now\n"
)
MAPPING = """\
attributes: {Identifier: id, Object Text: text, Verification Method: verification, Changed: null}
values:
  priority: {Mandatory: high}
  verification: {T: test}
defaults:
  {group: gripper, source: DOORS, status: draft, owner: me, rationale: It is heavy., facility: Bench,
   phase: qualification, success: It holds.}
"""


@pytest.fixture
def table(tmp_path):
    (tmp_path / "doors.csv").write_text(TABLE, encoding="utf-8")
    (tmp_path / "doors.yaml").write_text(MAPPING, encoding="utf-8")
    return tmp_path / "doors.csv"


def test_a_mapping_file_takes_a_table_of_another_tool(rgss, folder, table):
    command = ("import", "csv", table, "--project", folder, "--as", "system", "--mapping", table.with_suffix(".yaml"))
    told = rgss(*command)
    assert (told.status, told.errors) == (1, "")
    assert "added system SYS-901" in told.output
    assert "  priority: 'high'" in told.output
    assert "note: " not in told.output
    assert told.output.endswith("1 added, 0 removed, 0 changed; nothing is written (--apply writes it).\n")
    assert rgss(*command, "--apply").status == 0
    assert rgss(*command).output == "No changes.\n"


def test_options_count_before_the_file(rgss, untouched, table):
    mapping = table.with_suffix(".yaml")
    options = ("--map", "Changed=owner", "--map-value", "priority:Mandatory=low", "--default", "source=Jama")
    told = rgss("import", "csv", table, "--project", untouched, "--as", "system", "--mapping", mapping, *options)
    assert [each in told.output for each in ("priority: 'low'", "owner: 'now'", "source: 'Jama'")] == [True] * 3


def test_without_a_mapping_the_options_are_named(rgss, untouched, table):
    told = rgss("import", "csv", table, "--project", untouched)
    assert told.status == 2
    assert "unknown column 'Object Text' (for a table of another tool give --map 'Object Text=text')" in told.errors


def test_notes_are_printed_beside_a_refusal(rgss, untouched, table):
    told = rgss("import", "csv", table, "--project", untouched, "--as", "system", "--map", "Object Text=text")
    assert told.status == 2
    assert told.errors.startswith(f"{table}:1:1: error: no column has the ids (give --map Identifier=id)")
    options = ("--map", "Object Text=text", "--map", "Identifier=id")
    told = rgss("import", "csv", table, "--project", untouched, "--as", "system", *options)
    assert "note: the column 'Changed' is not imported: rgss has none of that name (--map 'Changed=…' takes it)" in (
        told.output
    )
    assert "--map-value 'priority:Mandatory=…' maps it" in told.errors


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (("--map", "Object Text"), "--map 'Object Text' is not NAME=ATTRIBUTE (such as --map 'Object Text=text')"),
        (("--map", "Object Text=txt"), "'txt' is not an attribute of rgss (did you mean 'text'?)"),
        (("--map", "Identifier=id", "--map", "Objekt Text=text"), "--map: the file has no 'Objekt Text' (it has "),
        (("--map-value", "Mandatory=high"), "--map-value 'Mandatory=high' is not ATTRIBUTE:VALUE=OURS"),
        (("--map-value", "prio:Mandatory=high"), "'prio' is not an attribute of rgss (did you mean 'priority'?)"),
        (("--as", "systm"), "--as 'systm' is not KIND or TYPE=KIND (kinds: stakeholder, system)"),
        (("--as", "Need=customer"), "--as 'Need=customer' is not KIND or TYPE=KIND (kinds: stakeholder, system, block"),
        (("--mapping", "none.yaml"), "none.yaml:1:1: error: no such file"),
    ],
)
def test_an_option_that_is_wrong_is_one_line(rgss, untouched, table, options, complaint):
    told = rgss("import", "csv", table, "--project", untouched, *options)
    assert (told.status, told.errors.count("\n")) == (2, 1)
    assert complaint in told.errors


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (("--map-relation", "Satisfies"), "--map-relation 'Satisfies' is not TYPE=LINK (such as "),
        (("--map-relation", "Satisfies=derives"), "'derives' is not what a relation may state (did you mean "),
        (
            ("--map-relation", "Fulfils=derived_from"),
            "--map-relation: the file has no relations 'Fulfils' (it has none)",
        ),
        (("--id-prefix", "1-"), "--id-prefix '1-': an id is a letter, then letters, digits, and _ . -"),
        (("--default", "id=x"), "--default 'id=x' is not NAME=VALUE with a known name (names: actor, actors, "),
    ],
)
def test_a_relation_or_a_prefix_that_is_wrong_is_one_line(rgss, untouched, table, options, complaint):
    command = ("import", "csv", table, "--project", untouched, "--mapping", table.with_suffix(".yaml"))
    told = rgss(*command, "--as", "system", *options)
    assert (told.status, told.errors.count("\n")) == (2, 1)
    assert complaint in told.errors


def test_numbers_are_ids_with_the_prefix_of_the_command_line_or_the_file(rgss, folder, table):
    table.write_text(TABLE.replace("SYS-901", "901"), encoding="utf-8")
    mapping = table.with_suffix(".yaml")
    command = ("import", "csv", table, "--project", folder, "--as", "system", "--mapping", mapping)
    assert "(give --id-prefix, such as --id-prefix SYS-)" in rgss(*command).errors
    mapping.write_text(f"{MAPPING}id_prefix: SYS-\n", encoding="utf-8")
    assert "added system DOORS-901" in rgss(*command, "--id-prefix", "DOORS-").output
    assert rgss(*command, "--apply").status == 0
    assert rgss(*command).output == "No changes.\n"
