"""Verbs that simulate: run and sweep."""

from __future__ import annotations

import pytest

from rgss.errors import MotionError, SimulationError

pytestmark = pytest.mark.engine

SPACE = "designs/grasping_system.yaml"


@pytest.fixture
def too_short(folder):
    """A project whose planners have ten milliseconds."""
    text = (folder / SPACE).read_text(encoding="utf-8")
    for number, limit in enumerate(("4 s", "6 s", "8 s"), start=1):
        text = text.replace(f"d9: {limit}", f"d9: {9 + number / 10} ms")
    (folder / SPACE).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.verifies("SYS-025")
def test_run_as_json(rgss, untouched):
    told = rgss("run", 65, "--json", "--project", untouched)
    document = told.document

    assert (told.status, told.errors) == (0, "")
    assert {"variant", "seed", "success", "failure", "phases", "planning", "metrics", "digest"} <= set(document)
    assert (document["variant"], document["seed"], document["success"], document["failure"]) == (65, 1, True, None)
    assert len(document["phases"]) == 8
    assert all({"phase", "outcome", "duration_s"} <= set(phase) for phase in document["phases"])
    assert len(document["planning"]) == 5
    keys = {"subtask", "outcome", "checks", "time_s", "path_length_m"}
    assert all(keys <= set(planning) for planning in document["planning"])
    assert document["metrics"]["phases_completed"] == 8
    assert len(document["digest"]) == 64
    assert not (untouched / ".rgss").exists()


@pytest.mark.verifies("SYS-021")
def test_run_shows_the_same_trial_to_people(rgss, rgss_process, untouched):
    # A process of its own: its exit status tells that the engines let the interpreter end.
    told = rgss_process("run", 65, "--seed", 2, "--project", untouched)
    done = rgss("run", 65, "--seed", 2, "--json", "--project", untouched)

    assert (told.returncode, told.stderr) == (0, "")
    assert (done.status, done.errors) == (0, "")
    lines = told.stdout.splitlines()
    assert lines[0].startswith("Variant 65, seed 2")
    assert [line.split()[1] for line in lines[3:11]] == [phase["phase"] for phase in done.document["phases"]]
    assert any(line.startswith("Success in ") for line in lines)
    assert f"digest {done.document['digest']}" in lines


def test_a_run_that_fails_says_why(rgss, too_short):
    told, as_json = (rgss("run", 65, *more, "--project", too_short) for more in ([], ["--json"]))

    assert (told.status, as_json.status) == (1, 1)
    assert "Failed at move_to_grasp: planning_limit: RRT found no path in 0.0092 s" in told.output
    assert "To fix it: give the planner more time (what sets planning.time_limit in designs/" in told.output
    assert as_json.document["failure"] == "planning_limit"
    assert "lower planning.clearance in studies/" in as_json.document["failure_hint"]
    assert as_json.document["failure_detail"].startswith("RRT found no path in 0.0092 s")
    assert as_json.document["planning"][1]["outcome"] == "not_run"


@pytest.mark.parametrize("error", [SimulationError, MotionError])
def test_an_engine_that_gives_up_is_one_line(rgss, untouched, monkeypatch, error):
    def give_up(*_, **__):
        raise error("the engine gave up", hint="try again")

    monkeypatch.setattr("rgss.trials.pieces.run_trial", give_up)
    told = rgss("run", 65, "--project", untouched)

    assert (told.status, told.output) == (3, "")
    assert told.complaint == "rgss: the engine gave up (try again)"


@pytest.mark.verifies("SYS-026")
def test_sweep_runs_what_is_missing(rgss, too_short):
    words = ["sweep", "--replicates", 1, "--jobs", 1, "--project", too_short]
    first = rgss(*words, "--only", "1,65", "--json")
    both = rgss(*words, "--only", "1-2,65", "--json")
    told = rgss(*words, "--only", "1-2,65")

    assert (first.status, first.errors) == (0, "")
    assert {name: first.document[name] for name in ("trials", "run", "from_evidence", "succeeded", "failed")} == {
        "trials": 2,
        "run": 2,
        "from_evidence": 0,
        "succeeded": 0,
        "failed": 2,
    }
    assert first.document["failures"] == {"planning_limit at move_to_grasp": 2}
    assert first.document["evidence"].endswith(".rgss/evidence.sqlite")
    assert (both.document["run"], both.document["from_evidence"]) == (1, 2)
    assert (told.status, told.errors) == (0, "")
    assert told.output.splitlines()[0] == "3 trials: 0 run, 3 from evidence; 0 succeeded, 3 failed."
    assert told.output.splitlines()[1] == "  3 × planning_limit at move_to_grasp"
    assert told.output.splitlines()[2].startswith("Evidence: ")


def test_sweep_measure_and_trade_follow_each_other(rgss, folder):
    """The smallest study: two variants, one replicate."""
    text = (folder / SPACE).read_text(encoding="utf-8")
    for line in (
        "      - id: standard\n        sets: {d2: 0.3 kg, d3: 0.4 kg}\n",
        "      - id: slow\n        sets: {d7: 0.5 m/s}\n",
        "      - id: trrt\n        sets: {d8: TRRT}\n",
        "      - id: stride\n        sets: {d8: STRIDE}\n",
        "      - id: short\n        sets: {d9: 4 s}\n",
        "      - id: medium\n        sets: {d9: 6 s}\n",
    ):
        assert line in text
        text = text.replace(line, "")
    (folder / SPACE).write_text(text, encoding="utf-8")
    study = folder / "studies/pick_place.yaml"
    # Its guard watches designs that are no longer there.
    study.write_text(study.read_text(encoding="utf-8").partition("\nregression:")[0] + "\n", encoding="utf-8")
    options = ["--replicates", 1, "--project", folder]

    assert rgss("check", "--project", folder).status == 0
    swept = rgss("sweep", *options, "--jobs", 2, "--json").document
    assert (swept["trials"], swept["succeeded"]) == (2, 2)
    measured = rgss("measure", *options, "--json").document
    assert {(row["variant"], row["value"]) for row in measured if row["measure"] == "S"} == {(1, 1.0), (2, 1.0)}
    decision = rgss("trade", *options, "--json").document
    assert decision["certificate"]["enumeration_agrees"]
    assert {entry["variant"] for entry in (*decision["ranking"], *decision["infeasible"])} == {1, 2}
