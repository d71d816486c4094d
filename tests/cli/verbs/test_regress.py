"""``rgss regress`` on evidence that is there already."""

from __future__ import annotations

import json
import re
from xml.etree import ElementTree as ET

import pytest

from rgss.evidence import EvidenceStore
from rgss.guard.runs import guard_of, watched_trials
from rgss.studies.project import load_project
from rgss.sweep.trial_keys import key_of
from tests.cli.conftest import made_record
from tests.fixtures.stored_trials import put_trials

STUDY = "studies/pick_place.yaml"
BASELINE = "studies/pick_place.baseline.json"
SECTION = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "57,60", replicates: 4, batch: 4, cap: 8}
  metrics:
    - {metric: success, better: higher, margin: 40 %}
    - {metric: planning_time_s, phases: all, better: lower, margin: 0.2 s}
"""


@pytest.fixture
def guarded(folder):
    """A copy of the shipped project that guards a little, with evidence of all that it watches."""
    (folder / BASELINE).unlink()
    path = folder / STUDY
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r"(?ms)^regression:\n.*?(?=^\S|\Z)", "", text) + SECTION, encoding="utf-8")
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        for trials in watched_trials(project, guard_of(project)):
            put_trials(store, trials.specs(trials.run.cap), made_record)
    return folder


@pytest.fixture
def with_baseline(rgss, guarded):
    """The same with a baseline."""
    told = rgss("regress", "--project", guarded, "--update", "--reason", "First <b>baseline</b>.")
    assert (told.status, told.errors) == (0, "")
    assert told.output == f"{BASELINE} written: 16 trials, change 1 of its history.\n"
    return guarded


@pytest.fixture
def spoil(with_baseline):
    """Changes the baseline, as if the code had been better then."""

    def change(edit):
        path = with_baseline / BASELINE
        document = json.loads(path.read_text(encoding="ascii"))
        edit(document)
        path.write_text(json.dumps(document), encoding="ascii")
        return with_baseline

    return change


def faster(document):
    run = document["runs"]["planning"]
    run["values"]["planning_time_s"]["lift"] = run["values"]["planning_time_s"]["move_to_grasp"]
    for row in run["values"]["planning_time_s"]["move_to_grasp"].values():
        row[:] = [value - 0.5 for value in row]
    for row in run["fingerprints"].values():
        row[:] = [" ".join(["f" * 12] * 9) for _ in row]


def test_nothing_changed(rgss, with_baseline):
    told = rgss("regress", "--project", with_baseline)
    assert (told.status, told.errors) == (0, "")
    assert told.output.splitlines() == [
        f"{STUDY} against {BASELINE}: same",
        "6 comparisons: 6 same; seeds after 1 look: planning 4",
        "behaviour unchanged: 8 trials the same bit for bit",
        (
            "power: success of the trial (run planning): a loss of 40 % is found with a probability of at least 17 % "
            "with up to 8 seeds; 80 % takes 19"
        ),
    ]
    assert len(rgss("regress", "--all", "--project", with_baseline).output.splitlines()) == 11


def test_a_regression_in_every_form(rgss, spoil, tmp_path):
    folder = spoil(faster)
    words = ("regress", "--project", folder, "--junit", tmp_path / "j.xml", "--markdown", tmp_path / "s.md")
    told = rgss(*words)
    assert (told.status, told.errors) == (1, "")
    assert "  WORSE         planning_time_s at move_to_grasp (run planning): " in told.output
    assert "  MISSING       planning_time_s at lift (run planning): 8 trials had a value" in told.output
    suite = ET.fromstring((tmp_path / "j.xml").read_bytes())  # noqa: S314 - our own file
    failed = {case.get("name") for case in suite if case.find("failure") is not None}
    assert failed == {"planning_time_s at move_to_grasp", "planning_time_s at lift", "behaviour"}
    assert "❌ worse | planning\\_time\\_s | move\\_to\\_grasp" in (tmp_path / "s.md").read_text(encoding="utf-8")
    document = rgss("regress", "--json", "--project", folder).document
    assert (document["verdict"], document["fails"]) == ("failed", True)


def test_what_is_inconclusive_fails_if_it_must(rgss, spoil):
    def noisy(document):
        faster(document)
        del document["runs"]["planning"]["values"]["planning_time_s"]["lift"]
        for row in document["runs"]["planning"]["values"]["planning_time_s"]["move_to_grasp"].values():
            row[:] = [value + 0.5 + (-1) ** place for place, value in enumerate(row)]

    folder = spoil(noisy)
    told = rgss("regress", "--project", folder)
    assert "INCONCLUSIVE  planning_time_s at move_to_grasp" in told.output
    assert "seeds after 2 looks: planning 8" in told.output
    assert told.status == 4
    accepted = ("regress", "--accept-change", "Noise.", "--project", folder)
    assert rgss(*accepted).status == 0
    assert rgss(*accepted, "--strict").status == 1


def test_changed_behaviour_has_a_status_of_its_own_until_a_reason_is_stated(rgss, spoil, tmp_path):
    """Every record differs and no metric does: nothing is worse, and the robot is another one."""

    def other(document):
        for row in document["runs"]["planning"]["fingerprints"].values():
            row[:] = [" ".join([f"{place:012x}"] * 9) for place, _ in enumerate(row)]
        document["inputs"]["scene.workpiece.friction"] = "0.98"

    folder = spoil(other)
    told = rgss("regress", "--project", folder, "--junit", tmp_path / "j.xml", "--markdown", tmp_path / "s.md")
    assert told.status == 4
    assert told.output.splitlines()[:2] == [
        f"{STUDY} against {BASELINE}: changed",
        (
            "  CHANGED       behaviour changed: 16 of 16 trials not the same bit for bit; first different phase: "
            "move_to_grasp in 16"
        ),
    ]
    assert "input changed: scene.workpiece.friction 0.98 → 1.0" in told.output.splitlines()
    assert told.output.splitlines()[-1].startswith("a change needs a reason: make it the baseline with 'rgss regress")
    assert "❗ **changed**" in (tmp_path / "s.md").read_text(encoding="utf-8")
    assert b'failures="1"' in (tmp_path / "j.xml").read_bytes()
    document = rgss("regress", "--json", "--project", folder)
    assert (document.status, document.document["verdict"], document.document["changed"]) == (4, "changed", True)

    accepted = rgss("regress", "--project", folder, "--accept-change", "A <new> pad.")
    assert accepted.status == 0
    assert "  ACCEPTED      behaviour changed: 16 of 16 trials" in accepted.output
    assert accepted.output.splitlines()[-1] == "changed behaviour is accepted in this run: A <new> pad."
    # Once is once; an update is for good.
    assert rgss("regress", "--project", folder).status == 4
    assert rgss("regress", "--project", folder, "--update", "--reason", "A new pad.").status == 0
    assert rgss("regress", "--project", folder).status == 0


def test_an_accepted_change_still_fails_for_what_is_worse(rgss, spoil):
    folder = spoil(faster)
    assert rgss("regress", "--project", folder, "--accept-change", "Why not.").status == 1


def test_a_baseline_of_the_schema_before_is_compared_and_brought_up_to_date(rgss, spoil):
    def earlier(document):
        for part in (document, *document["runs"].values()):
            del part["inputs"]
        del document["origin"]["modules"], document["origin"]["constants"]
        document["schema"] = 2

    folder = spoil(earlier)
    told = rgss("regress", "--project", folder)
    assert told.status == 0
    assert "note: the baseline was written by an earlier rgss and lacks the values of inputs" in told.output
    assert rgss("regress", "--project", folder, "--update", "--reason", "New schema.").status == 0
    document = json.loads((folder / BASELINE).read_text(encoding="ascii"))
    assert document["schema"] == 5
    assert document["inputs"]["settings.control.firm_grasp_s"] == "0.05"
    assert "note:" not in rgss("regress", "--project", folder).output


def test_the_history_goes_on(rgss, with_baseline):
    told = rgss("regress", "--project", with_baseline, "--update", "--reason", "Again.", "--json")
    assert told.document == {"baseline": BASELINE, "trials": 16, "changes": 2}
    history = json.loads((with_baseline / BASELINE).read_text(encoding="ascii"))["history"]
    assert [change["reason"] for change in history] == ["First <b>baseline</b>.", "Again."]


def test_a_baseline_elsewhere(rgss, guarded, tmp_path):
    path = tmp_path / "other.json"
    assert rgss("regress", "--project", guarded, "--baseline", path, "--update", "--reason", "x").status == 0
    assert not (guarded / BASELINE).exists()
    assert rgss("regress", "--project", guarded, "--baseline", path).status == 0


def test_a_damaged_baseline_is_not_replaced_unseen(rgss, with_baseline):
    path = with_baseline / BASELINE
    path.write_text("{", encoding="ascii")
    told = rgss("regress", "--project", with_baseline, "--update", "--reason", "x")
    assert told.status == 2
    assert told.complaint.startswith(f"rgss: the baseline {BASELINE} is not JSON: ")
    assert path.read_text(encoding="ascii") == "{"


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("--jobs", "0"), "rgss: --jobs must be at least 1 (omit it for one process a core)"),
        (("--reason", "x"), "rgss: --reason needs --update (without it nothing is changed)"),
        (("--update",), "rgss: --update needs a reason (state with --reason why the numbers change)"),
        (("--update", "--reason", " "), "rgss: --update needs a reason (state with --reason why the numbers change)"),
        (
            ("--update", "--reason", "x", "--junit", "j"),
            "rgss: --update and --junit exclude each other (compare in a run of its own)",
        ),
        (
            ("--update", "--reason", "x", "--markdown", "m"),
            "rgss: --update and --markdown exclude each other (compare in a run of its own)",
        ),
        (
            ("--accept-change", " "),
            "rgss: --accept-change needs a reason (state why behaviour changes)",
        ),
        (
            ("--update", "--reason", "x", "--accept-change", "y"),
            "rgss: --update and --accept-change exclude each other (compare in a run of its own)",
        ),
        (
            ("--update", "--reason", "x", "--strict"),
            "rgss: --update and --strict exclude each other (compare in a run of its own)",
        ),
    ],
)
def test_bad_input(rgss, untouched, words, complaint):
    told = rgss("regress", "--project", untouched, *words)
    assert (told.status, told.output, told.complaint) == (2, "", complaint)


def test_there_is_no_baseline_yet(rgss, guarded):
    told = rgss("regress", "--project", guarded)
    complaint = f"rgss: there is no baseline {BASELINE} (make it with 'rgss regress --update --reason TEXT')"
    assert (told.status, told.output, told.complaint) == (2, "", complaint)


def test_files_that_cannot_be_written(rgss, with_baseline, tmp_path):
    for option in ("--junit", "--markdown"):
        told = rgss("regress", "--project", with_baseline, option, tmp_path / "no" / "file")
        assert told.status == 2
        assert "cannot be written" in told.complaint


def test_designs_that_are_not_there_are_told_where_they_stand(rgss, guarded):
    path = guarded / STUDY
    path.write_text(path.read_text(encoding="utf-8").replace('"57,60"', '"57,160"'), encoding="utf-8")
    line = 1 + path.read_text(encoding="utf-8")[: path.read_text(encoding="utf-8").index('"57,160"')].count("\n")
    said = (
        f"{STUDY}:{line}:53: error: variants of run planning: unknown variant 160 (ids go from 1 to 72) "
        "[study.regression]"
    )

    checked = rgss("check", "--project", guarded)
    assert checked.status == 1
    assert checked.output.splitlines()[0] == said
    told = rgss("regress", "--project", guarded, "--update", "--reason", "x")
    assert (told.status, told.output, told.complaint) == (2, "", said)
    # What is guarded stops nothing but the guard.
    assert rgss("variants", "--project", guarded).status == 0


def test_a_trial_that_could_not_be_run_is_a_status_of_its_own(rgss, with_baseline, monkeypatch):
    project = load_project(with_baseline)
    (trials,) = watched_trials(project, guard_of(project))
    gone = next(spec for spec in trials.specs(4) if (spec.variant, spec.seed) == (60, 2))
    records = EvidenceStore.records

    def without_one(store, keys):
        return {key: record for key, record in records(store, keys).items() if key != key_of(gone)}

    monkeypatch.setattr(EvidenceStore, "records", without_one)
    told = rgss("regress", "--project", with_baseline)
    assert told.status == 3
    assert "FAILED        not run: run planning: the trial of variant 60 with seed 2 could not be run" in told.output
