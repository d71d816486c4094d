"""``rgss sweep``: what it says it did or would do, and what becomes of a run that fails."""

from __future__ import annotations

import json

import pytest

from rgss.cli.sweep.output import lost_line, result_lines, shown_trials
from rgss.cli.sweep.progress import SweepProgress, course_of
from rgss.evidence import RunFailure, RunFailureKind
from rgss.sweep.results import LostTrials, SweepResult, SweepState

SCENE = "scenes/restaurant.yaml"


@pytest.fixture
def sweep(rgss, folder):
    """Sweeps a few variants kinematically."""

    def run(*words, only="10,65", jobs=1):
        options = ["--project", folder, "--fidelity", "kinematic", "--replicates", 1, "--jobs", jobs, "--only", only]
        return rgss("sweep", *options, *words)

    return run


def test_a_dry_run_on_no_evidence_makes_none(sweep, folder):
    told = sweep("--dry-run")

    assert (told.status, told.errors) == (0, "")
    assert told.output.splitlines()[:4] == [
        "2 trials: 2 to run, 0 from evidence.",
        "Pieces: 2 plans, 2 timings, 2 executions to make.",
        "  2 trials (variants 10, 65, seed 1): plans, timings, executions to make",
        "    new",
    ]
    assert not (folder / ".rgss").exists()


@pytest.mark.engine
@pytest.mark.verifies("SYS-026")
def test_a_dry_run_says_what_would_be_made_and_why(sweep, folder):
    first = sweep()
    assert first.output.splitlines()[:2] == [
        "2 trials: 2 run, 0 from evidence; 2 succeeded, 0 failed.",
        "Pieces: 2 plans, 2 timings, 2 executions made.",
    ]
    text = (folder / SCENE).read_text(encoding="utf-8")
    (folder / SCENE).write_text(text.replace("mass: 0.25 kg", "mass: 0.4 kg"), encoding="utf-8")
    told, document = sweep("--dry-run"), sweep("--dry-run", "--json").document

    assert told.output.splitlines()[:4] == [
        "2 trials: 2 to run, 0 from evidence.",
        "Pieces: 2 executions to make, 2 plans, 2 timings from evidence.",
        "  2 trials (variants 10, 65, seed 1): executions to make",
        "    changed input: scene.workpiece.mass_kg 0.25 → 0.4",
    ]
    assert document["pieces"]["execution"] == {"make": 2, "from_evidence": 0, "uses": 2}
    assert document["due"] == [
        {
            "causes": [
                {"reason": "changed input", "name": "scene.workpiece.mass_kg", "then": "0.25", "now": "0.4"},
            ],
            "pieces": ["execution"],
            "trials": [{"variant": 10, "seed": 1}, {"variant": 65, "seed": 1}],
        }
    ]
    again = sweep("--json").document
    assert again["pieces_made"] == {"execution": 2}
    assert again["pieces_from_evidence"] == {"plan": 2, "timing": 2}
    assert (again["run"], again["run_failures"]) == (2, [])
    # Kinematics does not see the mass, so trials with another one have the same records, under other keys.
    assert sweep("--dry-run").output.splitlines()[0] == "2 trials: 0 to run, 2 from evidence."


@pytest.mark.engine
@pytest.mark.verifies("SYS-021")
def test_without_sharing_the_verdict_is_the_same(sweep):
    shared = sweep("--no-share", only="65")
    assert shared.output.splitlines()[1] == "Pieces: none shared; 1 trial run by itself."
    assert sweep("--dry-run", only="65").output.splitlines()[0] == "1 trial: 0 to run, 1 from evidence."


@pytest.mark.engine
def test_a_run_that_takes_too_long_is_one_line_and_status_3(sweep):
    told = sweep("--time-limit", "1 ms", only="1-2,65")

    assert told.status == 3
    assert told.output.splitlines()[0] == (
        "3 trials: 0 run, 0 from evidence; 0 succeeded, 0 failed; 3 could not be run."
    )
    assert told.errors.splitlines() == [
        "rgss: the plan of variants 1-2, seed 1 took too long: not done after 0.001 s (tried 2 times)",
        "rgss: the plan of variant 65, seed 1 took too long: not done after 0.001 s (tried 2 times)",
    ]
    why = sweep("--dry-run", only="65").output
    assert "    failed before: plan, timed_out: not done after 0.001 s" in why.splitlines()
    document = sweep("--time-limit", "1 ms", "--json", only="65").document
    (failure,) = document["run_failures"]
    assert {name: failure[name] for name in ("what", "kind", "detail", "attempts", "trials")} == {
        "what": "plan",
        "kind": "timed_out",
        "detail": "not done after 0.001 s",
        "attempts": 2,
        "trials": [{"variant": 65, "seed": 1}],
    }
    assert sweep(only="65").status == 0
    assert sweep("--dry-run", only="65").output.splitlines()[0] == "1 trial: 0 to run, 1 from evidence."


def test_a_worker_that_has_no_memory_to_start_is_one_line(sweep):
    told = sweep("--memory-limit", "1 MB")

    assert (told.status, told.output) == (3, "")
    assert told.complaint.startswith("rgss: a worker process cannot start: ")
    assert told.complaint.endswith(" (is its memory limit too low?)")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--jobs", "0"], "rgss: --jobs must be at least 1 (omit it for one process a core)"),
        (["--time-limit", "5"], "rgss: --time-limit: '5' has no unit (write it as '5 min')"),
        (
            ["--time-limit", "5 kg"],
            "rgss: --time-limit: unit 'kg' does not measure what 's' measures (write it as '5 min')",
        ),
        (["--time-limit", "0 s"], "rgss: --time-limit must be greater than zero, got '0 s' (write it as '5 min')"),
        (
            ["--memory-limit", "-1 GB"],
            "rgss: --memory-limit must be greater than zero, got '-1 GB' (write it as '4 GB')",
        ),
    ],
)
def test_a_limit_that_is_none_is_refused(rgss, untouched, words, complaint):
    told = rgss("sweep", "--project", untouched, *words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == complaint


@pytest.mark.parametrize(
    ("trials", "text"),
    [
        ([(65, 1)], "variant 65, seed 1"),
        ([(1, 1), (2, 1), (3, 1), (5, 1)], "variants 1-3, 5, seed 1"),
        ([(v, s) for v in range(1, 13) for s in (1, 2, 3)], "variants 1-12, seeds 1-3"),
        ([(1, 1), (2, 2)], "variant/seed 1/1, 2/2"),
        ([(v, v) for v in range(1, 10)], "variant/seed 1/1, 2/2, 3/3, 4/4, 5/5, 6/6 and 3 more"),
    ],
)
def test_trials_are_told_by_variants_and_seeds(trials, text):
    assert shown_trials(trials) == text


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (RunFailureKind.CRASHED, "crashed"),
        (RunFailureKind.TIMED_OUT, "took too long"),
        (RunFailureKind.OUT_OF_MEMORY, "ran out of memory"),
        (RunFailureKind.RAISED, "failed"),
    ],
)
def test_every_kind_of_failure_has_its_words(kind, words):
    failure = RunFailure(key="a" * 64, what="execution", kind=kind, detail="why", attempts=1)

    assert lost_line(LostTrials(failure=failure, trials=((1, 2),))) == (
        f"the execution of variant 1, seed 2 {words}: why (tried once)"
    )


def test_a_trial_that_is_lost_twice_is_counted_once():
    failure = RunFailure(key="a" * 64, what="bench", kind=RunFailureKind.RAISED, detail="why", attempts=2)
    lost = LostTrials(failure=failure, trials=((1, 1), (2, 1)))
    result = SweepResult(made={"bench": 2, "plan": 1}, reused={}, lost=(lost, lost))

    assert result_lines(3, {"run": 1, "kept": 0, "succeeded": 1, "failed": 0}, {}, result, "x.sqlite") == [
        "3 trials: 1 run, 0 from evidence; 1 succeeded, 0 failed; 2 could not be run.",
        "Pieces: 1 plan, 2 benches made.",
        "Evidence: x.sqlite",
    ]


def state(**changes):
    values = {"elapsed_s": 20.0, "remaining_s": 95.4, "tasks_left": 30, "made": {"plan": 6}, "reused": {}, "saved": 0}
    return SweepState(**{**values, **changes})


@pytest.mark.parametrize(
    ("found", "fresh", "text"),
    [
        (state(), 50, "2.5/s; 1:35 left; 6 made, 30 to make"),
        (state(reused={"bench": 4}, saved=12), 50, "2.5/s; 1:35 left; 6 made, 30 to make, 4 from evidence; 12 shared"),
        (state(remaining_s=None, made={}), 0, "estimating; 0 made, 30 to make"),
        (state(tasks_left=0, remaining_s=0.0), 72, "3.6/s; 6 made, 0 to make"),
    ],
)
def test_the_course_of_a_sweep_in_one_line(found, fresh, text):
    assert course_of(found, fresh=fresh) == text


def test_progress_is_shown_on_a_terminal_and_nowhere_else(capsys, monkeypatch):
    def shown():
        with SweepProgress(4) as progress:
            progress.finished({"run": 1, "kept": 2, "succeeded": 2, "failed": 1})
            progress.state(state(remaining_s=3.0))
        return capsys.readouterr()

    assert shown() == ("", "")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "160")
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    output, errors = shown()
    assert output == ""
    assert "estimating" in errors
    assert "3/4" in errors
    assert "2 succeeded, 1 failed" in errors
    assert "0:03 left; 6 made, 30 to make" in errors


def test_a_narrow_terminal_keeps_the_numbers_of_the_progress(capsys, monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with SweepProgress(2160) as progress:
        progress.finished({"run": 1044, "kept": 0, "succeeded": 1040, "failed": 4})
        progress.state(state(remaining_s=3.0))
    errors = capsys.readouterr().err

    assert "1044/2160" in errors
    assert "1040 succeeded, 4 failed" in errors


def test_json_of_a_sweep_is_one_document(sweep):
    assert {*json.loads(sweep("--dry-run", "--json").output)} == {
        "trials",
        "run",
        "from_evidence",
        "pieces",
        "due",
        "evidence",
    }
