"""``rgss export`` and ``rgss import`` on copies of the shipped project."""

from __future__ import annotations

import base64
import csv
import io
import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import yaml

from rgss.cli.main import main
from rgss.exchange import importing
from rgss.requirements import load_requirements
from rgss.studies import load_project

DEFAULTS = ("--default", "source=The supplier", "--default", "priority=low", "--default", "owner=gripper engineer")


def held(folder):
    return {path: path.read_bytes() for path in sorted((folder / "requirements").rglob("*.yaml"))}


@pytest.fixture(scope="module")
def exports(untouched, tmp_path_factory):
    """The shipped project in every format."""
    folder = tmp_path_factory.mktemp("exports")
    for name in ("reqif", "csv", "xlsx", "sysml"):
        assert main(["export", name, "--project", str(untouched), "-o", str(folder / f"rgss.{name}")]) == 0
    return folder


@pytest.fixture
def table(exports, tmp_path):
    """A copy of the table of the shipped project with some cells changed."""

    def changed(**cells):
        text = (exports / "rgss.csv").read_text(encoding="utf-8-sig")
        rows = list(csv.DictReader(io.StringIO(text, newline="")))
        for name, value in cells.items():
            next(row for row in rows if row["id"] == "SYS-002")[name] = value
        out = io.StringIO(newline="")
        writer = csv.DictWriter(out, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
        path = tmp_path / "table.csv"
        path.write_text(out.getvalue(), encoding="utf-8", newline="")
        return path

    return changed


@pytest.mark.parametrize("name", ["reqif", "csv", "xlsx"])
def test_an_export_changes_nothing_when_it_comes_back(rgss, untouched, exports, name):
    told = rgss("import", name, exports / f"rgss.{name}", "--project", untouched)
    assert (told.status, told.output, told.errors) == (0, "No changes.\n", "")


def test_the_exports_say_what_they_hold(rgss, untouched, exports, tmp_path):
    told = rgss("export", "sysml", "--project", untouched, "-o", tmp_path / "a.sysml", "--json")
    requirements = load_requirements(untouched / "requirements")
    assert told.document == {
        "file": str(tmp_path / "a.sysml"),
        "requirements": len(requirements.stakeholder) + len(requirements.system),
        "elements of the architecture": len(requirements.architecture.elements),
    }
    assert (tmp_path / "a.sysml").read_bytes() == (exports / "rgss.sysml").read_bytes()
    assert "SYS-001" in (tmp_path / "a.sysml").read_text(encoding="utf-8")


def test_a_table_is_reported_applied_and_then_no_change(rgss, folder, table):
    before = held(folder)
    path = table(owner="=boss", facility="Bench")
    told = rgss("import", "csv", path, "--project", folder)
    assert told.status == 1
    assert told.output.splitlines() == [
        "changed system SYS-002",
        "  facility: 'Build machine' -> 'Bench'",
        "  owner: 'manipulator engineer' -> '=boss'",
        "0 added, 0 removed, 1 changed; nothing is written (--apply writes it).",
    ]
    assert held(folder) == before
    told = rgss("import", "csv", path, "--project", folder, "--apply", "--json")
    assert (told.status, told.document["applied"], len(told.document["files"])) == (0, True, 1)
    assert told.document["changes"][0]["attributes"][1] == {
        "name": "owner",
        "old": "manipulator engineer",
        "new": "=boss",
    }
    (changed,) = [path for path, content in held(folder).items() if content != before[path]]
    old, new = before[changed].decode().splitlines(), changed.read_text(encoding="utf-8").splitlines()
    assert [line for line in new if line not in old] == ["    facility: Bench", '    owner: "=boss"']
    assert rgss("import", "csv", path, "--project", folder).output == "No changes.\n"


@pytest.mark.parametrize(
    ("cells", "complaint"),
    [
        ({"satisfied_by": "SYS-001"}, "after the import: "),
        (
            {"measure": "t_none", "comparison": "<", "threshold": "1 s", "success": ""},
            "after the import: ",
        ),
        ({"derived_from": "SYS-999"}, "SYS-002: derived_from: unknown element 'SYS-999'"),
        ({"status": "frozen"}, "SYS-002: status: 'frozen' is not one of"),
        ({"id": "SYS-001"}, "'SYS-001' is already in line"),
    ],
)
def test_what_would_break_the_project_is_not_applied(rgss, untouched, table, cells, complaint):
    before = held(untouched)
    told = rgss("import", "csv", table(**cells), "--project", untouched, "--apply")
    assert told.status == 2
    assert complaint in told.errors.splitlines()[0]
    assert "Traceback" not in told.errors
    assert held(untouched) == before


def test_a_file_of_strictdoc_is_taken_in_and_a_reqif_of_ours_takes_it_out_again(rgss, folder, exports):
    strictdoc = Path(__file__).parents[2] / "exchange" / "strictdoc" / "gripper.reqif"
    before = held(folder)
    told = rgss("import", "reqif", strictdoc, "--project", folder)
    assert told.status == 2
    assert "--as stakeholder or --as system" in told.errors.splitlines()[0]
    told = rgss("import", "reqif", strictdoc, "--project", folder, "--as", "system", *DEFAULTS, "--apply")
    assert told.status == 0
    assert "added system SUP-2" in told.output
    assert "note: the attribute 'ReqIF.Name' is not imported" in told.output
    assert rgss("import", "reqif", strictdoc, "--project", folder).status == 0
    shown = rgss("import", "reqif", exports / "rgss.reqif", "--project", folder)
    assert shown.status == 1
    assert shown.output.splitlines()[-1] == (
        "0 added, 2 removed, 0 changed; nothing is written (--apply writes it, and keeps what the file lacks without "
        "--remove: 2)."
    )
    kept = rgss("import", "reqif", exports / "rgss.reqif", "--project", folder, "--apply")
    assert kept.status == 1
    assert kept.output.splitlines()[-1] == (
        "0 added, 2 removed, 0 changed; nothing to write; what the file lacks is kept: 2 (--remove removes it)."
    )
    assert rgss("import", "reqif", exports / "rgss.reqif", "--project", folder, "--apply", "--remove").status == 0
    assert held(folder) == before
    again = folder / "again.reqif"
    assert rgss("export", "reqif", "--project", folder, "-o", again).status == 0
    assert again.read_bytes() == (exports / "rgss.reqif").read_bytes()


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("import", "csv", "none.csv"), "cannot be read: No such file"),
        (("import", "csv", "none.csv", "--remove"), "--remove goes with --apply"),
        (("import", "csv", "none.csv", "--default", "colour=red"), "'colour=red' is not NAME=VALUE with a known name"),
        (("import", "csv", "none.csv", "--default", "owner"), "'owner' is not NAME=VALUE with a known name"),
        (("import", "doc", "none.doc"), "invalid choice: 'doc'"),
        (("export", "doc", "-o", "none.doc"), "invalid choice: 'doc'"),
        (("export", "csv", "-o", "/none/none.csv"), "/none/none.csv cannot be written: No such file or directory"),
    ],
)
def test_words_that_are_wrong_are_one_line(rgss, untouched, words, complaint):
    told = rgss(*words, "--project", untouched)
    assert told.status == 2
    assert complaint in told.complaint


def test_terminal_codes_of_a_foreign_file_are_not_printed(rgss, untouched, table):
    path = table(owner="boss\u202e\u009bred")
    told = rgss("import", "csv", path, "--project", untouched)
    assert told.status == 1
    assert "'boss��red'" in told.output


def test_long_texts_are_shown_where_they_differ(rgss, untouched, exports, tmp_path):
    text = (exports / "rgss.csv").read_bytes()
    path = tmp_path / "table.csv"
    assert b"within 10 mm of" in text
    path.write_bytes(text.replace(b"within 10 mm of", b"within 12 mm of", 1))
    told = rgss("import", "csv", path, "--project", untouched)
    assert "  text: '…ool to within 10 mm of the waypoint.' -> '…ool to within 12 mm of the waypoint.'" in told.output


def test_a_default_fills_the_empty_cells_of_a_new_element(rgss, folder, exports, tmp_path):
    """The rehearsal must know of defaults what the plan knows."""
    rows = list(csv.DictReader(io.StringIO((exports / "rgss.csv").read_text(encoding="utf-8-sig"), newline="")))
    new = {
        **next(row for row in rows if row["id"] == "SYS-002"),
        "id": "SYS-900",
        "source": "",
        "owner": "",
        "exempt": "",
    }
    out = io.StringIO(newline="")
    writer = csv.DictWriter(out, list(new))
    writer.writeheader()
    writer.writerows([*rows, new])
    path = tmp_path / "table.csv"
    path.write_text(out.getvalue(), encoding="utf-8", newline="")
    told = rgss("import", "csv", path, "--project", folder, "--apply", *DEFAULTS)

    assert (told.status, told.errors) == (0, "")
    assert "1 added, 0 removed, 0 changed; written into" in told.output
    added = load_requirements(folder / "requirements").requirement("SYS-900")
    assert (added.source, added.owner) == ("The supplier", "gripper engineer")


def test_the_last_requirement_of_a_file_is_removed_with_the_file(rgss, folder, exports, tmp_path):
    ids = {
        each["id"]
        for each in yaml.safe_load((folder / "requirements/system/3-actuator.yaml").read_text(encoding="utf-8"))[
            "requirements"
        ]
    }
    rows = list(csv.DictReader(io.StringIO((exports / "rgss.csv").read_text(encoding="utf-8-sig"), newline="")))
    # What names them would be left in the air.
    named = ("derived_from", "traces", "parent")
    kept = [row for row in rows if row["id"] not in ids]
    for row in kept:
        for name in named:
            row[name] = "; ".join(each for each in row[name].split("; ") if each not in ids)
    out = io.StringIO(newline="")
    writer = csv.DictWriter(out, list(rows[0]))
    writer.writeheader()
    writer.writerows(kept)
    path = tmp_path / "table.csv"
    path.write_text(out.getvalue(), encoding="utf-8", newline="")
    told = rgss("import", "csv", path, "--project", folder, "--apply", "--remove")

    assert (told.status, told.errors) == (0, "")
    assert "removed the empty requirements/system/3-actuator.yaml" in told.output
    assert not (folder / "requirements/system/3-actuator.yaml").exists()
    assert ids.isdisjoint(each.id for each in load_requirements(folder / "requirements").system)


def test_an_archive_goes_out_and_comes_back(rgss, untouched, exports, tmp_path):
    path = tmp_path / "rgss.reqifz"
    assert rgss("export", "reqif", "--project", untouched, "-o", path).status == 0
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == ["rgss.reqif"]
        assert archive.read("rgss.reqif") == (exports / "rgss.reqif").read_bytes()
    told = rgss("import", "reqif", path, "--project", untouched)
    assert (told.status, told.output) == (0, "No changes.\n")


def test_an_import_that_takes_nothing_says_why(rgss, untouched, exports, tmp_path):
    text = (exports / "rgss.reqif").read_text(encoding="utf-8")
    strange = re.sub(r'(<SPEC-OBJECT-TYPE IDENTIFIER=")', r"\1_", text).replace(
        "<SPEC-OBJECT-TYPE-REF>", "<SPEC-OBJECT-TYPE-REF>_"
    )
    strange = strange.replace('"ReqIF.ForeignID"', '"Number"').replace('"ReqIF.Text"', '"Words"')
    path = tmp_path / "foreign.reqif"
    path.write_text(strange, encoding="utf-8")
    told = rgss("import", "reqif", path, "--project", untouched)

    assert (told.status, told.errors) == (1, "")
    assert told.output.splitlines()[-1] == "Nothing of the file was imported: the notes above say why."
    assert "not imported: no id and no text among their attributes" in told.output


def test_a_changed_measure_is_not_read_and_is_told(rgss, untouched, exports, tmp_path):
    text = (exports / "rgss.reqif").read_text(encoding="utf-8")
    definition = "Acceleration of the manipulator's tool while it carries the object."
    (own,) = [one for one in load_project(untouched).measures.measures if one.id == "t_e"]
    assert text.count(own.definition) == 1
    assert definition not in own.definition
    path = tmp_path / "foreign.reqif"
    path.write_text(text.replace(own.definition, definition), encoding="utf-8")
    told = rgss("import", "reqif", path, "--project", untouched)
    assert (told.status, told.errors) == (1, "")
    loss, last = told.output.splitlines()
    assert loss == (
        f"{path}:1:1: warning: the definition of measure 't_e' is another one than the project's (an import reads no "
        "measures; change measures.yaml) [exchange.measure]"
    )
    assert last == "No changes."

    path.write_text(re.sub(r'THE-VALUE="t_e"', 'THE-VALUE="t_new"', text), encoding="utf-8")
    told = rgss("import", "reqif", path, "--project", untouched)
    assert "measure 't_new' is none of the project's" in told.output
    assert told.status == 1


def test_what_a_text_loses_is_a_finding(rgss, folder, exports, tmp_path):
    text = (exports / "rgss.reqif").read_text(encoding="utf-8")
    place = text.index("<xhtml:div>") + len("<xhtml:div>")
    path = tmp_path / "foreign.reqif"
    path.write_text(text[:place] + '<xhtml:object data="a.png"/>' + text[place:], encoding="utf-8")
    told = rgss("import", "reqif", path, "--project", folder)
    as_json = rgss("import", "reqif", path, "--project", folder, "--json")

    assert told.status == as_json.status == 1
    loss, last = told.output.splitlines()
    assert loss.startswith(f"{path}:")
    assert loss.endswith("the attachment 'a.png' is omitted [exchange.loss]")
    assert last == "No changes."
    assert [each["message"].endswith("'a.png' is omitted") for each in as_json.document["losses"]] == [True]


def test_the_status_says_whether_the_project_states_what_the_file_states(rgss, folder, exports, tmp_path):
    """Also where one change is applied and other elements are kept."""
    rows = list(csv.DictReader(io.StringIO((exports / "rgss.csv").read_text(encoding="utf-8-sig"), newline="")))
    named = {name for row in rows for key in ("parent", "derived_from", "traces") for name in row[key].split("; ")}
    last = next(row for row in reversed(rows) if row["id"] not in named)
    rows.remove(last)
    rows[0]["owner"] = "somebody else"
    path = tmp_path / "fewer.csv"
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)

    first = rgss("import", "csv", path, "--project", folder, "--apply")
    second = rgss("import", "csv", path, "--project", folder, "--apply")
    assert (first.status, second.status) == (1, 1)
    assert "1 removed, 1 changed; written into" in first.output
    assert "1 removed, 0 changed; nothing to write" in second.output


def test_while_one_import_writes_no_other_does(rgss, folder, table):
    """Each would write what it has read, and the later one undo the earlier."""
    with importing(folder):
        told = rgss("import", "csv", table(), "--project", folder, "--apply")
        looked = rgss("import", "csv", table(), "--project", folder)
    assert (told.status, told.output) == (2, "")
    assert told.errors == "rgss: another import writes into this project (wait until it has ended)\n"
    assert (looked.status, looked.output) == (0, "No changes.\n")


def test_an_interrupted_import_is_named_and_undone(rgss, folder, table):
    """The journal is that of an import that was killed after its first file."""
    path = folder / "requirements" / "stakeholder.yaml"
    old, new = path.read_bytes(), b"requirements: []\n"
    coded = [base64.b64encode(content).decode("ascii") for content in (old, new)]
    path.write_bytes(new)
    (folder / ".rgss").mkdir(exist_ok=True)
    (folder / ".rgss" / "import.json").write_text(
        json.dumps({"requirements/stakeholder.yaml": coded}), encoding="utf-8"
    )

    told = rgss("check", "--project", folder)
    assert told.status == 2
    assert told.errors == (
        "rgss: an import into this project was interrupted (`rgss import` undoes what it has written)\n"
    )
    told = rgss("import", "csv", table(), "--project", folder)
    assert (told.status, told.output) == (0, "No changes.\n")
    assert told.errors == "an import that was interrupted is undone in requirements/stakeholder.yaml\n"
    assert path.read_bytes() == old


def test_a_verb_of_a_mixture_says_so_before_its_result(folder):
    coded = base64.b64encode((folder / "requirements" / "stakeholder.yaml").read_bytes()).decode("ascii")
    (folder / ".rgss").mkdir(exist_ok=True)
    (folder / ".rgss" / "import.json").write_text(
        json.dumps({"requirements/stakeholder.yaml": ["", coded]}), encoding="utf-8"
    )
    command = [sys.executable, "-m", "rgss", "variants", "--project", str(folder)]
    told = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    lines = told.stdout.splitlines()
    assert "was interrupted" in lines[0]
    assert len(lines) > 3
    assert "was interrupted" not in "".join(lines[1:])


def test_a_mixture_of_two_imports_that_can_be_read_is_told(rgss, folder):
    """An import that was killed between two files leaves what may be sound and is neither the old nor the new."""
    coded = base64.b64encode((folder / "requirements" / "stakeholder.yaml").read_bytes()).decode("ascii")
    (folder / ".rgss").mkdir(exist_ok=True)
    (folder / ".rgss" / "import.json").write_text(
        json.dumps({"requirements/stakeholder.yaml": ["", coded]}), encoding="utf-8"
    )

    told = rgss("check", "--project", folder)

    assert told.status == 0
    assert (
        told.errors == "rgss: an import into this project was interrupted (`rgss import` undoes what it has written)\n"
    )
