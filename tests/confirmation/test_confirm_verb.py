"""``rgss confirm`` with real trials in both engines, on a design that is planned quickly."""

from __future__ import annotations

import contextlib
import io
import json
from dataclasses import dataclass

import pytest

from rgss.assessment import measure_variants
from rgss.cli.main import main
from rgss.evidence import EvidenceStore
from rgss.studies import load_project
from tests.fixtures.shipped_project import copy_project

CRITERION = 'criterion: {measure: t_gc_simulated, statistic: value, comparison: "<=", threshold: "3 s"}'


@dataclass
class Told:
    status: int
    output: str
    errors: str


def rgss(*words) -> Told:
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        try:
            status = main([str(word) for word in words])
        except SystemExit as end:
            status = end.code
    return Told(status, output.getvalue(), errors.getvalue())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return copy_project(tmp_path_factory.mktemp("confirm"))


@pytest.fixture(scope="module")
def confirmed(folder):
    """Variant 65 confirmed with one seed in both engines."""
    words = ("confirm", "--variants", 65, "--seeds", 1, "--jobs", 1, "--project", folder)
    return rgss(*words, "--json"), words


@pytest.mark.engine
def test_the_engines_agree_on_a_trial(confirmed):
    told, _ = confirmed
    document = json.loads(told.output)
    assert (told.status, told.errors) == (0, "")
    assert [one["varies"] for one in document["settings"]] == ["study", "step", "iterations", "engine"]
    assert {one["first"] for one in document["settings"]} == {65}
    (trial,) = document["trials"]
    assert {one["outcome"] for one in trial["settings"]} == {"success"}
    slips = [one["metrics"]["slip_m"] for one in trial["settings"]]
    assert len(set(slips)) == 4
    assert max(slips) < 2e-4
    payloads = [one["metrics"]["bench_payload_kg"] for one in trial["settings"]]
    assert payloads == pytest.approx([payloads[0]] * 4, rel=0.02)
    assert document["run"] == 4


@pytest.mark.engine
def test_a_second_run_takes_everything_from_evidence_and_says_the_same(confirmed):
    first, words = confirmed
    again = rgss(*words, "--json")
    assert {**json.loads(again.output), "run": 4} == json.loads(first.output)
    assert json.loads(again.output)["run"] == 0


@pytest.mark.engine
def test_the_study_never_sees_what_confirms_it(confirmed, folder):
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        assert len(list(store.iterate())) == 4
        (entry,) = measure_variants(project, store, among=[project.designs.variant(65)])
        (other,) = measure_variants(project, store, among=[project.designs.variant(64)])
    assert (len(entry.records), entry.missing, entry.outdated) == (1, 2, 0)
    assert (len(other.records), other.missing) == (0, 3)


@pytest.mark.engine
def test_trials_of_both_engines_are_found_again_bit_for_bit(confirmed, folder):
    own = rgss("replay", "65/1", "--project", folder)
    assert own.status == 0
    assert "The same, bit for bit" in own.output
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        made = {trial.key: store.inputs(trial.provenance.inputs_digest) for trial in store.iterate()}
    (second,) = [key for key, inputs in made.items() if "engine" in inputs["settings"]["physics"]]
    there = rgss("replay", second[:16], "--project", folder)
    assert (there.status, "The same, bit for bit" in there.output) == (0, True)


@pytest.mark.engine
def test_a_verdict_between_the_engines_ends_with_status_1(confirmed, folder, tmp_path):
    told, words = confirmed
    cells = json.loads(told.output)["trials"][0]["settings"]
    times = {one["setting"]: one["metrics"]["grasp_cycle_time_s"] for one in cells}
    study, *_, engine = times.values()
    assert engine < study
    file = folder / "requirements/system/2-gripper.yaml"
    before = file.read_text(encoding="utf-8")
    assert CRITERION in before
    file.write_text(
        before.replace(CRITERION, CRITERION.replace("3 s", f"{(study + engine) / 2} s")),
        encoding="utf-8",
    )
    page = tmp_path / "confirmation.md"
    try:
        differing = rgss(*words, "--markdown", page)
    finally:
        file.write_text(before, encoding="utf-8")
    assert differing.status == 1
    lines = differing.output.splitlines()
    assert lines[0].startswith("Among 1 of 72 designs the decision depends on ")
    assert "no design is first under PyBullet 240 Hz, 20 iterations" in lines[0]
    # One seed has no interval, so that the verdict is open under each setting, though not the choice.
    assert lines[1] == (
        "All 7 verdicts on 1 design are the same under every setting, but 5 of them are inconclusive by so few seeds."
    )
    assert "0 run, 4 from evidence" in lines[-1]
    begin = "# Confirmation of pick\\_place\n\nAmong 1 of 72 designs the decision depends on "
    assert page.read_text(encoding="utf-8").startswith(begin)


@pytest.mark.engine
def test_a_run_that_cannot_be_made_is_told_with_status_3(folder, monkeypatch):
    def lose(spec, *_, **__):
        raise RuntimeError("no")

    monkeypatch.setattr("rgss.cli.sweep.runner.SweepRunner.run", _lost)
    told = rgss("confirm", "--variants", 64, "--seeds", 1, "--failures", 0, "--jobs", 1, "--project", folder)
    assert (told.status, told.output) == (3, "")
    assert told.errors.splitlines()[-1] == (
        "rgss: the trial of variant 64 with seed 1 could not be run (see what failed, then run it again)"
    )


def _lost(runner, specs):
    from rgss.cli.sweep.runner import FinishedSweep, TrialTally
    from rgss.evidence import RunFailure, RunFailureKind
    from rgss.sweep import LostTrials, SweepResult

    failure = RunFailure(key="a" * 64, what="plan", kind=RunFailureKind.CRASHED, detail="killed", attempts=2)
    lost = (LostTrials(failure=failure, trials=((64, 1),)),)
    result = SweepResult(made={}, reused={}, lost=lost, elapsed_s=0.0, busy_s=0.0)
    return FinishedSweep(trials=len(specs), tally=TrialTally(), result=result)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--variants", "28;31"], "rgss: --variants must be a list of ids, got '28;31' (write ids, such as 28,31)"),
        (["--variants", "99"], "rgss: unknown variant 99 (ids of variants: from 1 to 72)"),
        (["--seeds", "0"], "rgss: --seeds must be from 1 to 10000, got 0 (omit it for the replicates)"),
        (["--failures", "-1"], "rgss: --failures must be from 0 to 10000, got -1 (0 omits the sample)"),
        (["--rate", "1000"], "rgss: --rate: '1000'"),
        (["--rate", "fast"], "rgss: --rate: "),
        (
            ["--rate", "240 Hz"],
            (
                "rgss: the finer rate must be above that of the study, 240 Hz, got 240 Hz "
                "(give a higher rate: a coarser step confirms nothing)"
            ),
        ),
        (["--jobs", "0"], "rgss: --jobs must be at least 1"),
        (["--engine", "bullet"], "rgss confirm: argument --engine: invalid choice: 'bullet'"),
    ],
)
def test_bad_input_is_one_line(folder, words, message):
    named = [] if "--variants" in words else ["--variants", "65"]
    sample = [] if "--failures" in words else ["--failures", 0]
    told = rgss("confirm", *named, *words, *sample, "--project", folder)
    assert (told.status, told.output) == (2, "")
    (line,) = told.errors.splitlines()
    assert line.startswith(message)


def test_without_evidence_of_the_study_there_is_no_choice_to_confirm(tmp_path):
    project = copy_project(tmp_path)
    told = rgss("confirm", "--project", project)
    assert (told.status, told.output) == (2, "")
    assert told.errors.endswith(f"(run 'rgss sweep --project {project}' first)\n")
