"""Verbs that read and simulate nothing: check, variants, measure, trade."""

from __future__ import annotations

import json
import re
import shutil
import sqlite3
from pathlib import Path

import pytest

TABLE = Path(__file__).parents[2] / "designs" / "table_4_3.csv"
EFFECTIVENESS = ("P_max_simulated", "C_total", "t_e_simulated", "t_p", "S")


@pytest.fixture
def spoilt(with_evidence, tmp_path):
    """A copy with evidence that the test may spoil."""
    return Path(shutil.copytree(with_evidence, tmp_path / "spoilt"))


@pytest.mark.verifies("SYS-030")
def test_check_of_a_sound_project(rgss, untouched):
    told = rgss("check", "--project", untouched)

    assert (told.status, told.errors) == (0, "")
    (summary,) = told.output.splitlines()
    assert "72 variants: 0 findings" in summary


def test_check_shows_notes_where_they_are_asked_for(rgss, untouched):
    *notes, summary = rgss("check", "--all", "--project", untouched).output.splitlines()

    assert notes
    assert all(": info: " in note for note in notes)
    assert summary.endswith("0 findings")


@pytest.mark.verifies("SYS-030")
def test_check_finds_a_requirement_that_nobody_asked_for(rgss, folder):
    file = folder / "requirements/system/1-manipulator.yaml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("derived_from: [STK-006, STK-095]", "derived_from: []", 1), encoding="utf-8")
    told = rgss("check", "--project", folder)

    assert (told.status, told.errors) == (1, "")
    assert "[trace.orphan]" in told.output
    assert told.output.splitlines()[-1].endswith("notes (--all shows them)")
    findings = rgss("check", "--json", "--project", folder).document["findings"]
    assert ("trace.orphan", "error") in {(each["rule"], each["severity"]) for each in findings}


def test_check_as_json(rgss, untouched):
    document = rgss("check", "--json", "--project", untouched).document

    assert set(document) == {"findings", "skipped"}
    assert document["skipped"] == []
    for finding in document["findings"]:
        assert {"rule", "severity", "message", "file", "line", "column"} <= set(finding)
        assert finding["severity"] == "info"
        assert (untouched / finding["file"]).is_file()


@pytest.mark.verifies("SYS-027")
def test_check_of_an_unusable_project_as_json(rgss, folder):
    (folder / "studies/pick_place.yaml").write_text("", encoding="utf-8")
    told = rgss("check", "--json", "--project", folder)

    assert (told.status, told.errors) == (2, "")
    (finding,) = told.document["findings"]
    assert (finding["rule"], finding["file"]) == ("document.empty", "studies/pick_place.yaml")
    assert (finding["line"], finding["column"], finding["severity"]) == (1, 1, "error")


@pytest.mark.verifies("SYS-029")
def test_variants_as_csv_are_the_table(rgss, untouched):
    told = rgss("variants", "--format", "csv", "--project", untouched)

    assert (told.status, told.errors) == (0, "")
    assert told.output.encode() == TABLE.read_bytes()


def test_variants_as_json(rgss, untouched):
    document = rgss("variants", "--json", "--project", untouched).document
    header, *rows = (line.split(",") for line in TABLE.read_text(encoding="utf-8").splitlines())

    assert [set(entry) for entry in document] == [{"id", "parameters"}] * 72
    assert [list(entry["parameters"]) for entry in document] == [header[1:]] * 72
    for entry, row in zip(document, rows, strict=True):
        assert entry["id"] == int(row[0])
        for value, cell in zip(entry["parameters"].values(), row[1:], strict=True):
            assert value == cell or value == float(cell)
    assert rgss("variants", "--format", "json", "--project", untouched).document == document


def test_variants_as_a_table(rgss, untouched):
    head, _, *rows = rgss("variants", "--project", untouched).output.splitlines()

    assert head == "id  d1  d2 [kg]  d3 [kg]  d7 [m/s]      d8  d9 [s]"
    assert [int(row.split()[0]) for row in rows[:72]] == list(range(1, 73))
    header, *written = (line.split(",") for line in TABLE.read_text(encoding="utf-8").splitlines())
    varying = [place for place, name in enumerate(header) if name[:2] in {"de", "d1", "d2", "d3", "d7", "d8", "d9"}]
    assert [row.split() for row in rows[:72]] == [[row[place] for place in varying] for row in written]
    assert rows[72:] == [
        "",
        (
            "d1 gripper fingers, d2 finger mass, d3 gripper base mass, d7 max manipulator velocity, d8 planner, "
            "d9 max planning time"
        ),
        (
            "The same in all designs: d4 max finger velocity 0.04 m/s, d5 max gripper force 10 N, "
            "d6 friction coefficient 0.7"
        ),
    ]
    assert max(map(len, (head, *rows[:72]))) <= 100


@pytest.mark.verifies("SYS-036")
def test_measure_as_json(rgss, with_evidence):
    told = rgss("measure", "--json", "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    rows = told.document
    assert {frozenset(row) for row in rows} == {frozenset({"variant", "measure", "value", "unit", "low", "high", "n"})}
    assert sorted({row["variant"] for row in rows}) == list(range(1, 73))
    found = {(row["variant"], row["measure"]): row for row in rows}
    assert found[1, "t_p"]["value"] == pytest.approx(5 * (0.3 + 0.01 + 0.002))
    assert (found[1, "S"]["value"], found[1, "S"]["n"]) == (1.0, 3)
    assert (found[7, "S"]["value"], found[7, "t_p"]["value"], found[7, "t_p"]["n"]) == (0.0, None, 0)
    assert found[7, "C_total"]["low"] == found[7, "C_total"]["high"] == found[7, "C_total"]["value"]


def test_measure_as_a_table(rgss, with_evidence):
    told = rgss("measure", "--project", with_evidence)
    verdicts, cautions, table = told.output.split("\n\n")[:3]
    head, _, *rows = table.splitlines()

    assert told.status == 0
    standing, heads, _, *counted = verdicts.splitlines()
    assert standing == "Study pick_place: 72 variants, 216 trials"
    assert heads.split() == ["requirement", "criterion", "met", "not_met", "inconclusive"]
    counts = {line.split()[0]: [int(word) for word in line.split()[-3:]] for line in counted}
    assert {sum(each) for each in counts.values()} == {72}
    assert counts["SYS-024"][1] == sum("not_met" in row.split()[-3:] for row in rows) > 0
    assert all(f"{measure} [" in head for measure in EFFECTIVENESS)
    assert len(rows) == 72
    # The made records last 8 s and their plans; the equation has half a metre for each move.
    assert cautions.startswith("Caution: t_e: equation and simulation differ by more than 10 % in ")
    assert "trials of all 72 variants have no bench_payload; there P_max_simulated takes P_max_g instead." in cautions
    assert " s by the equation, " in cautions
    assert "–" in rows[6]
    assert "not_met" in rows[6]


def test_measure_of_one_variant(rgss, with_evidence):
    told = rgss("measure", "--variant", 7, "--project", with_evidence)

    assert told.status == 0
    assert all(f"\n{measure} " in told.output for measure in EFFECTIVENESS)
    assert "SYS-024" in told.output
    rows = rgss("measure", "--variant", 7, "--json", "--project", with_evidence).document
    assert {row["variant"] for row in rows} == {7}


def test_measure_shows_what_is_missing(rgss, with_evidence):
    told = rgss("measure", "--replicates", 4, "--json", "--project", with_evidence)

    assert told.status == 0
    assert {row["n"] for row in told.document if row["measure"] == "S"} == {3}


@pytest.mark.verifies("SYS-038")
def test_trade_as_json(trade_as_json):
    told, document = trade_as_json, trade_as_json.document

    assert (told.status, told.errors) == (0, "")
    assert {"status", "chosen", "runner_up", "ranking", "infeasible", "certificate"} <= set(document)
    assert document["status"] == "optimal"
    assert document["certificate"]["enumeration_agrees"] == "agreed"
    assert document["ranking"][0]["variant"] == document["chosen"]
    assert document["ranking"][1]["variant"] == document["runner_up"]
    values = [entry["value"] for entry in document["ranking"]]
    assert values == sorted(values, reverse=True)
    assert [set(entry) for entry in document["ranking"]] == [{"variant", "value", "objectives"}] * len(values)
    assert len(values) + len(document["infeasible"]) == 72
    failing = [entry for entry in document["infeasible"] if "SYS-024" in entry["requirements"]]
    assert len(failing) == 24


@pytest.mark.verifies("SYS-038")
def test_trade_says_what_is_chosen_and_why(rgss, with_evidence, trade_as_json):
    told = rgss("trade", "--project", with_evidence)
    document = trade_as_json.document

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("Study pick_place: 72 variants, 216 trials\n")
    assert f"Variant {document['chosen']} has the highest value" in told.output
    assert f"It leads the runner-up {document['runner_up']} by" in told.output
    assert "Caution: t_e contains t_p, so t_p counts twice." in told.output
    assert "enumeration of all 72 variants agrees" in told.output
    assert told.output.splitlines()[-1].endswith("evidence.sqlite")


def test_trade_where_nothing_is_feasible(rgss, with_little_evidence, tmp_path):
    spoilt = Path(shutil.copytree(with_little_evidence, tmp_path / "spoilt"))
    file = spoilt / "requirements/system/2-gripper.yaml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("at least 0.8 kg", "at least 80 kg").replace('"0.8 kg"', '"80 kg"'), encoding="utf-8")
    told, document = rgss("trade", "--project", spoilt), rgss("trade", "--json", "--project", spoilt)

    assert (told.status, told.errors, document.status) == (1, "", 1)
    assert told.output.count("none meets every requirement by its estimates") == 1
    assert "SYS-012" in told.output
    section = rgss("trade", "--section", "--project", spoilt)
    assert (section.status, section.errors) == (1, "")
    assert "No variant is chosen: none meets every requirement by its estimates" in section.output
    (row,) = [line for line in section.output.splitlines() if line.startswith("| SYS-012 |")]
    assert row.split(" | ")[1:3] == ["P_max_simulated >= 80 kg", "8"]
    assert "| SYS-012 alone |" in section.output
    assert re.search(r"^Nearest: variant \d+, which violates SYS-012", section.output, re.MULTILINE)
    assert (document.document["status"], document.document["chosen"]) == ("infeasible", None)


def test_trade_needs_all_evidence(rgss, with_evidence):
    told = rgss("trade", "--replicates", 4, "--project", with_evidence)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        "rgss: 72 of 288 trials have no evidence for the project as it is now (run 'rgss sweep --replicates 4' first)"
    )


@pytest.mark.parametrize("verb", ["measure", "trade", "sweep"])
def test_evidence_that_is_no_store(rgss, spoilt, verb):
    evidence = spoilt / ".rgss" / "evidence.sqlite"
    for name in evidence.parent.iterdir():
        name.unlink()
    evidence.write_bytes(b"not a database at all\n" * 100)
    told = rgss(verb, "--project", spoilt)

    assert (told.status, told.output) == (2, "")
    assert "cannot be used" in told.complaint
    assert evidence.read_bytes().startswith(b"not a database")


@pytest.mark.parametrize("verb", ["measure", "trade", "sweep"])
def test_evidence_that_was_tampered_with(rgss, spoilt, verb):
    connection = sqlite3.connect(spoilt / ".rgss" / "evidence.sqlite")
    with connection:
        connection.execute("UPDATE trials SET content_digest = lower(hex(zeroblob(32)))")
    connection.close()
    told = rgss(verb, "--project", spoilt)

    assert (told.status, told.output) == (2, "")
    assert "is damaged: its record is not the one that was put" in told.complaint


@pytest.mark.parametrize("verb", ["measure", "trade"])
def test_what_only_reads_makes_no_evidence(rgss, folder, verb):
    assert rgss(verb, "--project", folder).status == 2
    assert not (folder / ".rgss").exists()


def test_json_is_one_document_and_nothing_else(rgss_process, with_evidence):
    for words in (["check"], ["variants"], ["measure"], ["trade", "--brief"]):
        done = rgss_process(*words, "--json", "--project", with_evidence)

        assert (done.returncode, done.stderr) == (0, "")
        json.loads(done.stdout)
