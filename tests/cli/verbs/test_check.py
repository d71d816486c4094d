"""``rgss check``: explaining, reviewing, checking evidence; checks write nothing."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from rgss.trace import RULES
from rgss.trials.metrics import METRICS

STAKEHOLDER = "requirements/stakeholder.yaml"
GRIPPER = "requirements/system/2-gripper.yaml"


@pytest.fixture
def edit(folder):
    def change(name, old, new):
        path = folder / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, old
        path.write_text(text.replace(old, new), encoding="utf-8")

    return change


@pytest.fixture
def judged(with_evidence, tmp_path):
    """A copy with evidence that the test may change."""
    return Path(shutil.copytree(with_evidence, tmp_path / "judged"))


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_the_sources_of_measures_are_explained_with_unit_and_meaning(rgss):
    told = rgss("check", "--explain", "measures.unknown-source")
    assert (told.status, told.errors) == (0, "")
    lines = told.output.splitlines()
    for name, metric in METRICS.items():
        (at,) = [number for number, line in enumerate(lines) if line.startswith(f"trial.{name} ({metric.unit}")]
        assert lines[at + 1] == f"  {metric.meaning_in_trial}"
    (rule,) = rgss("check", "--explain", "unknown-source", "--json").document["rules"]
    assert {one["source"] for one in rule["sources"]} == {f"trial.{name}" for name in METRICS}


def test_a_rule_of_reading_is_not_said_to_be_explained(rgss):
    told = rgss("check", "--explain", "document.value")
    assert told.status == 2
    assert "its findings say what is wrong and where" in told.errors


def test_a_rule_is_explained(rgss):
    told = rgss("check", "--explain", "wording.R7")

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("wording.R7 (error)\n  A requirement has no vague word")
    assert "terms_removed" in told.output


def test_all_rules_are_listed_without_a_project(rgss, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = rgss("check", "--explain")

    assert (told.status, told.errors) == (0, "")
    assert [line.split(" (")[0] for line in told.output.splitlines() if line and line[0] != " "] == [
        rule.id for rule in RULES
    ]
    document = rgss("check", "--explain", "--json").document
    assert [rule["rule"] for rule in document["rules"]] == [rule.id for rule in RULES]
    (rule,) = rgss("check", "--explain", "trace.cycle", "--json").document["rules"]
    assert (rule["severity"], rule["configurable"]) == ("error", False)


def test_the_page_of_rules(rgss):
    assert rgss("check", "--explain", "--markdown").output.startswith("# Rules\n")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--explain", "wording.R77"], "there is no rule 'wording.R77' (did you mean 'wording.R7'?)"),
        (["--explain", "wording.R7", "--markdown"], "--markdown writes the page of all rules (rgss check --explain"),
        (["--markdown"], "--markdown writes the page of all rules (rgss check --explain --markdown)"),
        (["--explain", "--review", "SYS-001"], "--explain and --review exclude each other (give one of them)"),
        (["--reviewer", "A"], "--reviewer goes with --review (rgss check --review ID --reviewer NAME)"),
        (["--junit", "x.xml"], "--junit goes with --evidence (rgss check --evidence --junit FILE)"),
    ],
)
def test_options_that_do_not_go_together(rgss, words, complaint):
    told = rgss("check", *words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(f"rgss: {complaint}")


def test_a_review_is_stamped_and_then_suspect(rgss, folder, edit):
    told = rgss("check", "--review", "STK-010", "SYS-012", "--reviewer", "A. Reader", "--project", folder)
    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("Reviewed 2 elements; ")
    assert told.output.rstrip().endswith("reviews.yaml has 2 reviews.")
    assert rgss("check", "--project", folder).status == 0

    edit(STAKEHOLDER, "without slippage", "without a slip")
    found = rgss("check", "--json", "--project", folder).document["findings"]
    suspect = [one for one in found if one["severity"] == "warning"]
    assert [(one["rule"], one["file"]) for one in suspect] == [
        ("review.changed", STAKEHOLDER),
        ("review.suspect-link", GRIPPER),
    ]
    line = (folder / GRIPPER).read_text(encoding="utf-8").splitlines()[suspect[1]["line"] - 1]
    assert line[suspect[1]["column"] - 1 :].startswith("STK-010")

    told = rgss("check", "--review", "STK-010", "--reviewer", "B", "--project", folder)
    assert told.output.startswith("Reviewed 1 element; ")
    rgss("check", "--review", "STK-010", "SYS-012", "--reviewer", "B", "--project", folder)
    assert rgss("check", "--project", folder).status == 0


def test_everything_is_reviewed(rgss, folder):
    told = rgss("check", "--review", "all", "--reviewer", "B", "--json", "--project", folder)

    assert (told.status, told.document["reviewer"]) == (0, "B")
    assert len(told.document["reviewed"]) == len(set(told.document["reviewed"])) == 47
    notes = rgss("check", "--json", "--project", folder).document["findings"]
    assert not [one for one in notes if one["rule"].startswith("review.")]


def test_without_a_name_the_login_name_is_the_reviewer(rgss, folder, monkeypatch):
    monkeypatch.setattr("getpass.getuser", lambda: "reader")
    assert rgss("check", "--review", "SYS-001", "--json", "--project", folder).document["reviewer"] == "reader"

    def unknown():
        raise OSError("no name")

    monkeypatch.setattr("getpass.getuser", unknown)
    told = rgss("check", "--review", "SYS-001", "--project", folder)
    assert (told.status, told.complaint) == (2, "rgss: the login name is not known (give --reviewer NAME)")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["SYS-0011"], "rgss: 'SYS-0011' is not an element of the requirements (did you mean 'SYS-011'?)"),
        (["sys-011"], "rgss: 'sys-011' is not an element of the requirements (did you mean 'SYS-011'?)"),
        (["SYS-001", "--reviewer", "\x1b[2J"], "rgss: a reviewer is named by 1 to 80 printable characters"),
    ],
)
def test_reviews_that_are_refused_write_nothing(rgss, folder, words, complaint):
    before = contents(folder)
    told = rgss("check", "--project", folder, "--review", *words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(complaint)
    assert contents(folder) == before


def test_a_project_that_cannot_be_read_is_not_reviewed(rgss, folder, edit):
    edit(STAKEHOLDER, "id: STK-010", "id: STK-006")
    told = rgss("check", "--review", "SYS-001", "--project", folder)

    assert told.status == 2
    assert "[requirements.duplicate-id]" in told.complaint
    assert not (folder / "requirements" / "reviews.yaml").exists()


@pytest.mark.parametrize("words", [[], ["--all"], ["--evidence"], ["--json"], ["--explain"]])
def test_a_check_writes_nothing(rgss, judged, words):
    before = contents(judged)
    rgss("check", *words, "--project", judged)

    assert {name for name, content in contents(judged).items() if before.get(name) != content} <= {
        name for name in before if name.suffix in (".sqlite-shm", ".sqlite-wal")
    }


def test_settings_and_exemptions_of_a_project(rgss, folder, edit):
    edit(STAKEHOLDER, "upright.", "properly upright.")
    told = rgss("check", "--project", folder)
    assert told.status == 1
    assert "'STK-012' says 'properly', which is vague" in told.output

    rules = folder / "requirements" / "rules.yaml"
    before = rules.read_text(encoding="utf-8") if rules.exists() else "rules:\n"
    rules.write_text(before + "  wording.R7: {severity: info, reason: a test}\n", encoding="utf-8")
    assert rgss("check", "--project", folder).status == 0

    rules.write_text(before + "  wording.R77: {enabled: false, reason: a test}\n", encoding="utf-8")
    told = rgss("check", "--project", folder)
    assert told.status == 1
    assert "[settings.unknown-rule]" in told.output


@pytest.mark.parametrize(
    ("old", "new", "status", "rule"),
    [
        ("The gripper shall complete a", "The gripper shall open, shall complete a", 1, "wording.R18"),
        ("The gripper shall complete a", "The gripper shall <script>alert(1)</script> complete a", 0, None),
        ("derived_from: [STK-012]", "derived_from: [STK-O12]", 2, "requirements.dangling-id"),
        ("derived_from: [STK-012]", "derived_from: [STK-012, SYS-008]", 2, "requirements.cycle"),
        ("id: SYS-009", "id: STK-010", 2, "requirements.duplicate-id"),
    ],
)  # fmt: skip
def test_bad_input_is_a_finding_on_one_line(rgss, folder, edit, old, new, status, rule):
    edit(GRIPPER, old, new)
    told = rgss("check", "--project", folder)

    assert (told.status, told.errors) == (status, "")
    assert "Traceback" not in told.output
    assert rule is None or f"[{rule}]" in told.output


def test_evidence_is_checked_where_asked_for(rgss, with_evidence, untouched):
    assert rgss("check", "--project", with_evidence).status == 0
    told = rgss("check", "--evidence", "--project", with_evidence)
    # The tests of the project stayed behind, and nothing else verifies what they do.
    assert told.output.count(", and nothing records it (rgss verify SYS-") == 33
    assert told.output.count("evidence.") == 33

    told = rgss("check", "--evidence", "--project", untouched)
    assert told.status == 1
    assert told.output.count("has no evidence for any of the 72 variants (rgss sweep) [evidence.none]") == 6


def test_verdicts_are_recorded_and_then_stale(rgss, judged):
    told = rgss("measure", "--record", "--verdicts", "--json", "--project", judged)
    assert told.status == 0
    rows = told.document
    assert {frozenset(row) for row in rows} == {frozenset({"variant", "requirement", "verdict", "changed"})}
    assert not [row for row in rows if row["changed"]]

    path = judged / "requirements/system/6-script.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text.replace("at least 0.9", "at least 0.8", 1).replace("threshold: 0.9", "threshold: 0.8", 1), encoding="utf-8"
    )
    rows = rgss("measure", "--verdicts", "--json", "--project", judged).document
    stale = {(row["requirement"], row["verdict"], *row["changed"]) for row in rows if row["changed"]}
    assert stale == {("SYS-024", "stale", "requirement")}

    told = rgss("measure", "--project", judged)
    assert "72 verdicts are stale, for this changed since they were made: requirement\n" in told.output
    assert told.output.endswith("'rgss measure --record' gives verdicts by the stored evidence.\n")
    assert "'rgss sweep'" not in told.output
    told = rgss("check", "--evidence", "--project", judged)
    assert told.status == 1
    assert "'SYS-024' has stale evidence for any of the 72 variants: the requirement has changed since" in told.output

    rgss("measure", "--record", "--project", judged)
    assert "evidence.stale" not in rgss("check", "--evidence", "--project", judged).output


def test_a_recorded_verdict_that_was_changed_contradicts_its_evidence(rgss, judged):
    rgss("measure", "--record", "--project", judged)
    path = judged / ".rgss" / "verdicts.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    (book,) = record["studies"].values()
    assert book["SYS-024"]["7"]["verdict"] == "not_met"
    book["SYS-024"]["7"]["verdict"] = "met"
    path.write_text(json.dumps(record), encoding="utf-8")
    told = rgss("check", "--evidence", "--project", judged)

    assert told.status == 1
    assert "'SYS-024' is recorded as met by variant 7, but the evidence says not_met" in told.output
    assert "[evidence.contradiction]" in told.output


def test_another_model_makes_evidence_stale(rgss, judged):
    path = judged / "scenes/restaurant.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace("mass: 0.25 kg", "mass: 0.26 kg"), encoding="utf-8")
    rows = rgss("measure", "--verdicts", "--json", "--project", judged).document

    assert {(row["requirement"], *row["changed"]) for row in rows if row["verdict"] == "stale"} == {
        # The records of the fixture name neither code nor engines.
        (requirement, "model", "code", "engines")
        for requirement in ("SYS-005", "SYS-009", "SYS-012", "SYS-024", "SYS-033", "SYS-040")
    }
    assert not [row for row in rows if row["verdict"] == "not_run"]


def test_a_verdict_of_one_variant_says_why_it_is_stale(rgss, judged):
    path = judged / "scenes/restaurant.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace("mass: 0.25 kg", "mass: 0.26 kg"), encoding="utf-8")
    told = rgss("measure", "--variant", 7, "--project", judged)

    assert "6 verdicts are stale, for this changed since they were made: model, code, engines\n" in told.output
    remedy = "'rgss sweep' makes the outdated trials again, and records the verdicts of their variants.\n"
    assert told.output.endswith(remedy)
    assert "--record" not in told.output
    told = rgss("measure", "--verdicts", "--variant", 7, "--project", judged)
    assert [line.split()[:4] for line in told.output.splitlines()[2:] if "SYS-024" in line] == [
        ["7", "SYS-024", "stale", "model,"]
    ]


def test_only_all_variants_are_recorded(rgss, judged):
    told = rgss("measure", "--record", "--variant", 7, "--project", judged)

    assert (told.status, told.complaint) == (2, "rgss: --record needs all variants (omit --variant)")
    assert not (judged / ".rgss" / "verdicts.json").exists()


@pytest.mark.parametrize("verb", [["measure"], ["check", "--evidence"]])
def test_a_record_of_verdicts_that_is_none(rgss, judged, verb):
    (judged / ".rgss" / "verdicts.json").write_text("{", encoding="utf-8")
    told = rgss(*verb, "--project", judged)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith("rgss: .rgss/verdicts.json is not a record of verdicts (remove it and run")


def test_a_result_of_tests_needs_tests(rgss, folder):
    """It is an input: it would be neither read nor written."""
    told = rgss("check", "--evidence", "--junit", folder / "nowhere.xml", "--project", folder)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == "rgss: --junit is given, but the project has no tests (omit it)"


def test_a_hostile_test_result_is_refused_in_one_line(rgss, folder):
    (folder / "tests").mkdir()
    hostile = folder / "hostile.xml"
    hostile.write_text('<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/hostname">]><testsuites>&b;</testsuites>', "utf-8")
    told = rgss("check", "--evidence", "--junit", hostile, "--project", folder)

    assert (told.status, told.output) == (2, "")
    assert "it declares a document type, which is refused" in told.complaint


def test_files_that_nothing_reads_and_characters_that_nobody_sees(rgss, folder):
    (folder / "requirements" / "rule.yaml").write_text("rules: {}\n")
    scene = folder / "scenes" / "restaurant.yaml"
    scene.write_text(scene.read_text(encoding="utf-8") + "# \u202eend\n", encoding="utf-8")
    last = len(scene.read_text(encoding="utf-8").splitlines())
    told = rgss("check", "--project", folder)

    assert told.status == 1
    unread, invisible = told.output.splitlines()[:2]
    assert unread == (
        "requirements/rule.yaml:1:1: warning: nothing reads this file "
        "(is it meant to be 'requirements/rules.yaml'?) [document.unread]"
    )
    assert invisible == (
        f"scenes/restaurant.yaml:{last}:3: warning: has the invisible character U+202E, so the text may read "
        "otherwise than it is (remove it) [document.invisible]"
    )


def test_a_misspelt_file_is_named_beside_the_missing_one(rgss, folder):
    (folder / "requirements" / "measures.yaml").rename(folder / "requirements" / "measure.yaml")
    told = rgss("check", "--project", folder)

    assert told.status == 2
    assert "requirements/measure.yaml:1:1: warning: nothing reads this file" in told.output
