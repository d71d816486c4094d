"""``rgss trace`` on copies of the shipped project."""

from __future__ import annotations

import csv
import io
import json
import re
import resource

import pytest
from openpyxl import load_workbook

from rgss.evidence import EvidenceStore
from rgss.reports.trace.formats import TRACE_FORMATS
from rgss.reports.trace.json_document import json_schema
from rgss.requirements import load_requirements
from rgss.studies.project import load_project
from rgss.trace.evidence import run_properties

TABLES = ["coverage", "gaps", "stakeholder-moe", "system-stakeholder", "system-architecture", "verification"]
ENDINGS = ", ".join(one.suffix for one in TRACE_FORMATS)


def test_the_whole_report_in_the_terminal(rgss, with_evidence):
    told = rgss("trace", "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    assert "Evidence: variant 10, which the trade-off chooses." in told.output
    for title in ("Coverage", "Stakeholder requirements × measures of effectiveness", "Verification matrix"):
        assert f"\n{title}\n" in told.output
    (row,) = [line for line in told.output.splitlines() if line.startswith("SYS-005 ") and "t_e" in line]
    assert row.split()[1] == "analysis"
    # Three trials do not exclude a slow one: the interval reaches beyond the limit.
    low, high = (float(one) for one in re.search(r"\(([\d.]+) to ([\d.]+)\), 3 trials", row).groups())
    assert low < 25 < high
    assert row.split()[-1] == "inconclusive"
    (decided,) = [line for line in told.output.splitlines() if line.startswith("SYS-004 ") and "C_total" in line]
    assert decided.split()[-1] == "met"


def test_json_keeps_its_schema(rgss, with_evidence):
    import jsonschema

    documents = [
        rgss("trace", "--project", with_evidence, *words, "--json").document
        for words in ([], ["--variant", "9", "--gaps"], ["SYS-005"], ["SYS-005", "--impact"])
    ]

    for document in documents:
        jsonschema.validate(document, json_schema())
    assert [document["document"] for document in documents] == ["report", "report", "chain", "impact"]
    assert documents[0]["evidence"]["variant"] == 10
    assert documents[1]["evidence"] | {"trials": 0} == documents[0]["evidence"] | {
        "choice": "variant 9, as requested",
        "variant": 9,
        "trials": 0,
    }
    assert {trial["variant"] for trial in documents[1]["evidence"]["trials"]} == {9}


def test_the_trials_that_decide_are_those_that_the_estimate_counts(rgss, with_evidence):
    measures = rgss("measure", "--project", with_evidence, "--json").document
    document = rgss("trace", "--project", with_evidence, "--json").document
    counts = {one["measure"]: one["n"] for one in measures if one["variant"] == 10}
    decided = {row["requirement"]: row for row in document["verification"] if row["measured"]}

    assert decided
    assert all(len(row["trials"]) == row["measured"]["n"] for row in decided.values())
    assert decided["SYS-005"]["measured"]["n"] == counts["t_e"] == 3
    assert decided["SYS-004"]["trials"] == []
    assert decided["SYS-004"]["measured"]["value"] is not None


def test_a_trial_is_told_by_the_key_that_the_store_knows_it_by(rgss, with_evidence):
    chain = rgss("trace", "--project", with_evidence, "SYS-005", "--json").document
    told = [step for step in chain["down"] if step["kind"] == "trial"]
    # Two measures decide it and what is derived from it, by the same trials.
    with EvidenceStore.open(load_project(with_evidence).evidence, create=False) as store:
        stored = {trial.key: trial.record for trial in store.all()}

    assert [(stored[step["id"]].variant, stored[step["id"]].seed) for step in told] == [(10, 1), (10, 2), (10, 3)] * 2
    assert f"; rgss replay {told[0]['id'][:12]}; " in told[0]["note"]
    assert "t_e_simulated = 11.11 s; " in told[0]["note"]
    assert told[0]["note"].endswith("task_time_s = 11.11")


def test_without_evidence_links_are_shown_and_verdicts_not_run(rgss, untouched):
    told = rgss("trace", "--project", untouched, "--json")
    verdicts = {row["verdict"] for row in told.document["verification"]}

    assert told.status == 0
    assert told.document["evidence"]["variant"] is None
    assert "no variant is chosen" in told.document["evidence"]["choice"]
    assert "not_run" in verdicts
    assert all(matrix["empty_rows"] == [] for matrix in told.document["matrices"])


def test_gaps_end_with_1_as_long_as_there_are_any(rgss, with_evidence):
    told = rgss("trace", "--project", with_evidence, "--gaps")

    assert told.status == 1
    assert "\nGaps\n" in told.output
    assert "×" not in told.output
    assert "has no evidence" not in told.output.split("\nGaps\n")[0]


@pytest.mark.parametrize("name", ["trace.html", "trace.md", "trace.xlsx", "trace.json", "trace.txt"])
def test_a_file_by_its_ending(rgss, with_evidence, tmp_path, name):
    told = rgss("trace", "--project", with_evidence, "-o", tmp_path / name)

    assert (told.status, told.output) == (0, f"Wrote {tmp_path / name}\n")
    assert [path.name for path in tmp_path.iterdir()] == [name]
    first = (tmp_path / name).read_bytes()
    rgss("trace", "--project", with_evidence, "-o", tmp_path / name)
    assert (tmp_path / name).read_bytes() == first


def test_the_formats_say_the_same(rgss, with_evidence, tmp_path):
    rgss("trace", "--project", with_evidence, "-o", tmp_path / "t.json")
    rgss("trace", "--project", with_evidence, "-o", tmp_path / "t.xlsx")
    told = rgss("trace", "--project", with_evidence, "--table", "verification", "--format", "csv")
    document = json.loads((tmp_path / "t.json").read_text(encoding="utf-8"))
    workbook = load_workbook(tmp_path / "t.xlsx")
    rows = list(csv.DictReader(io.StringIO(told.output, newline="")))

    assert workbook.sheetnames == TABLES
    assert [row["requirement"] for row in rows] == [row["requirement"] for row in document["verification"]]
    assert [row["text"] for row in rows] == [row["text"] for row in document["verification"]]
    assert [cell.value for cell in workbook["verification"]["A"]][1:] == [row["requirement"] for row in rows]
    for matrix in document["matrices"]:
        heads, *lines = workbook[matrix["name"]].iter_rows(values_only=True)
        assert list(heads[2:]) == matrix["columns"]
        for line in lines:
            linked = [column for column, mark in zip(heads[2:], line[2:], strict=True) if mark == "x"]
            assert linked == matrix["linked"][line[0]]


def test_csv_into_a_folder(rgss, with_evidence, tmp_path):
    folder = tmp_path / "tables"
    told = rgss("trace", "--project", with_evidence, "--format", "csv", "-o", folder)

    assert (told.status, len(told.output.splitlines())) == (0, len(TABLES))
    assert sorted(path.name for path in folder.iterdir()) == sorted(f"{name}.csv" for name in TABLES)
    assert (folder / "coverage.csv").read_bytes().startswith(b"\xef\xbb\xbf")


def test_ids_are_whole_wherever_a_line_ends(rgss, with_evidence):
    told = rgss("trace", "--project", with_evidence, "SYS-005", "--impact")
    document = rgss("trace", "--project", with_evidence, "SYS-005", "--impact", "--json").document

    assert "SEQ-move-to-grasp-departure" in json.dumps(document)
    assert "SEQ-move-to-grasp-departure" in told.output
    assert not [line for line in told.output.splitlines() if line.endswith("-")]


def test_a_chain_and_an_impact_as_files_in_a_folder(rgss, with_evidence, tmp_path):
    rgss("trace", "--project", with_evidence, "10/1", "--format", "html", "-o", tmp_path)
    rgss("trace", "--project", with_evidence, "SYS-005", "--impact", "--format", "text", "-o", tmp_path)
    rgss("trace", "--project", with_evidence, "mu", "--impact", "-o", tmp_path / "impact.csv")
    (key,) = [path.stem.removeprefix("chain-") for path in tmp_path.glob("chain-*.html")]

    assert len(key) == 64
    names = [f"chain-{key}.html", "impact-SYS-005.txt", "impact.csv"]
    assert sorted(path.name for path in tmp_path.iterdir()) == names


def test_diagrams_into_a_folder(rgss, untouched, tmp_path):
    told = rgss("trace", "--project", untouched, "--diagrams", tmp_path / "svg")
    files = list((tmp_path / "svg").iterdir())

    assert (told.status, told.output) == (0, f"Wrote {len(files)} diagrams into {tmp_path / 'svg'}\n")
    assert {"containment.svg", "use-cases.svg"} <= {path.name for path in files}


def test_results_of_tests_decide(rgss, folder, tmp_path):
    tests = folder / "tests"
    tests.mkdir()
    mark = '@pytest.mark.verifies("SYS-001")'
    (tests / "test_a.py").write_text(f"import pytest\n\n\n{mark}\ndef test_a():\n    pass\n", encoding="utf-8")
    junit = tmp_path / "junit.xml"
    noted = run_properties(folder, load_requirements(folder / "requirements").system)
    of_run = "".join(f'<property name="{name}" value="{value}"/>' for name, value in noted.items())
    junit.write_text(
        f'<testsuites><testsuite name="pytest"><properties>{of_run}</properties>'
        '<testcase classname="tests.test_a" name="test_a"><properties>'
        '<property name="rgss.test" value="tests/test_a.py::test_a"/>'
        '<property name="rgss.verifies" value="SYS-001"/></properties></testcase></testsuite></testsuites>',
        encoding="utf-8",
    )

    def row(*words):
        document = rgss("trace", "--project", folder, *words, "--json").document
        (found,) = [row for row in document["verification"] if row["requirement"] == "SYS-001"]
        return found["verdict"], [(test["id"], test["end"]) for test in found["tests"]]

    assert row() == ("not_run", [("tests/test_a.py::test_a", None)])
    assert row("--junit", junit) == ("met", [("tests/test_a.py::test_a", "passed")])
    told = rgss("trace", "--project", folder, "--junit", tmp_path / "nowhere.xml")
    assert (told.status, "there is no test result" in told.complaint) == (2, True)


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["SYS-999"], "'SYS-999' is not an id of the requirements, the architecture, the measures"),
        (["--impact"], "--impact needs an id (rgss trace SYS-004 --impact)"),
        (["SYS-004", "--gaps"], "--gaps does not go with an id (omit one of them)"),
        (["SYS-004", "--table", "gaps"], "--table does not go with an id"),
        (["SYS-004", "--diagrams", "x"], "--diagrams does not go with an id"),
        (["--json", "-o", "x.json"], "--json prints JSON (for a file use -o FILE.json"),
        (["--json", "--format", "md"], "--json prints JSON"),
        (["--format", "xlsx"], "an Excel file cannot be printed (name a file with -o trace.xlsx)"),
        (["--format", "csv"], "a CSV file holds one table (choose one with --table (coverage, gaps,"),
        (["-o", "x.csv"], "a CSV file holds one table"),
        (["--format", "html", "--table", "gaps"], "--table does not go with html, which holds everything"),
        (["-o", "x.yaml"], f"'x.yaml' does not end in {ENDINGS} (use that suffix)"),
        (["-o", "x.html", "--format", "md"], "'x.html' does not end in .md"),
        (["-o", "x"], "no format is given for the folder 'x'"),
        (["-o", "no/such/x.html"], "'no/such/x.html' cannot be written: there is no folder no/such"),
        (["--variant", "99"], "99"),
        (["--gaps", "--table", "verification-", "-o", "x.md"], "argument --table: invalid choice"),
        (["--gaps", "--format", "md", "--table", "stakeholder-moe"], "unknown table 'stakeholder-moe'"),
        (["--junit", "nowhere.xml"], "--junit is given, but the project has no tests (omit it)"),
    ],
)
def test_what_is_refused_in_one_line(rgss, untouched, tmp_path, monkeypatch, words, complaint):
    monkeypatch.chdir(tmp_path)
    told = rgss("trace", "--project", untouched, *words)

    assert told.status == 2
    assert complaint in told.complaint
    assert told.output == ""
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file(rgss, untouched, tmp_path):
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    for words in (["-o", tmp_path / "file", "--format", "csv"], ["--diagrams", tmp_path / "file"]):
        told = rgss("trace", "--project", untouched, *words)
        assert (told.status, told.complaint) == (
            2,
            f"rgss: {str(tmp_path / 'file')!r} is a file, not a folder (name another folder)",
        )
    assert (tmp_path / "file").read_text(encoding="utf-8") == "mine"


def test_nothing_is_half_written(rgss_process, untouched, tmp_path):
    """A page that cannot be finished leaves the file that was there."""
    target = tmp_path / "trace.html"
    target.write_text("before", encoding="utf-8")

    def small_files():
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

    told = rgss_process("trace", "--project", untouched, "-o", target, preexec_fn=small_files)

    assert told.returncode == 3
    assert "File too large" in told.stderr
    assert "Traceback" not in told.stderr
    assert [(path.name, path.read_text(encoding="utf-8")) for path in tmp_path.iterdir()] == [("trace.html", "before")]


def test_a_broken_project_is_told_with_its_place(rgss, folder):
    system = next((folder / "requirements").rglob("*manipulator*.yaml"))
    system.write_text(
        system.read_text(encoding="utf-8").replace("derived_from: [STK-006]", "derived_from: [STK-00X]", 1)
    )
    told = rgss("trace", "--project", folder)

    assert told.status == 2
    assert "STK-00X" in told.errors
    assert "Traceback" not in told.errors
