"""Wrong answers of workers: recorded as failures of the run, and the sweep goes on with what is right."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.evidence import EvidenceStore, RunFailureKind
from rgss.evidence.store.verification import verify
from rgss.studies.expansion import trial_specs
from rgss.sweep.answers import answer_problem, is_end_of, wrong_answer
from rgss.sweep.running import sweep
from rgss.sweep.task_end import Ended, TaskError
from rgss.sweep.trial_keys import key_of, trials_of
from rgss.trials.pieces.pieces import TrialTask, tasks_of
from tests.fixtures.eight_states import Phase

DOUBLES = Path(__file__).parent / "doubles"


@pytest.fixture
def wrong_results(monkeypatch):
    monkeypatch.syspath_prepend(DOUBLES)
    import wrong_results

    return wrong_results


@pytest.fixture
def specs_of(shipped):
    kinematic = shipped.with_fidelity("kinematic")
    return lambda seeds: trial_specs(kinematic, variants=[kinematic.designs.variant(1)], seeds=seeds)


@pytest.mark.parametrize("jobs", [0, 2])
def test_wrong_pieces_are_failures_of_their_trials_alone(wrong_results, specs_of, tmp_path, jobs):
    wrong = [*wrong_results.WRONG_PIECES, *(wrong_results.LATE + number for number in wrong_results.WRONG_PIECES)]
    specs = specs_of([0, *wrong, 99])
    told = []
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        result = sweep(specs, store, jobs=jobs, maker=wrong_results.wrong, on_finished=told.append)

        assert sorted(trial.record.seed for trial in told) == [0, 99]
        lost = {seed: each.failure for each in result.lost for _, seed in each.trials}
        assert sorted(lost) == sorted(wrong)
        # What cannot be pickled or is too long does not even arrive from a process.
        assert {failure.kind for failure in lost.values()} <= {RunFailureKind.WRONG_ANSWER, RunFailureKind.RAISED}
        assert all(failure.attempts == 2 for failure in lost.values())
        assert {seed: failure.what for seed, failure in lost.items()} == {
            seed: "execution" if seed >= wrong_results.LATE else "plan" for seed in wrong
        }
        assert store.failures(failure.key for failure in lost.values()) == {
            failure.key: failure for failure in lost.values()
        }
        details = {seed: failure.detail for seed, failure in lost.items()}
        assert details[1] == "expected a piece, got a NoneType"
        assert details[3].endswith(f", got '{'0' * 59}…'")
        assert details[4].startswith("expected a piece of kind plan, got <PieceKind.BENCH")
        assert details[7].startswith("it is malformed: the plan is not JSON: ")
        assert details[9].endswith("NaN is not a finite number")
        assert details[11].startswith("it is malformed: the piece has 17825792 bytes")
        # The next sweep tries again.
        again = []
        assert (
            sweep(specs, store, jobs=0, maker=wrong_results.worker_doubles.quick, on_finished=again.append).lost == ()
        )
        assert len(again) == len(specs)
    assert verify(tmp_path / "evidence.sqlite", label="it").damages == ()


def test_wrong_records_are_failures_of_their_trials_alone(wrong_results, specs_of, tmp_path):
    specs = specs_of([0, *wrong_results.WRONG_RECORDS, wrong_results.TEXTS_FOR_MEMBERS, 99])
    told = []
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        result = sweep(specs, store, jobs=0, share=False, maker=wrong_results.wrong, on_finished=told.append)

        assert sorted(trial.record.seed for trial in told) == [0, wrong_results.TEXTS_FOR_MEMBERS, 99]
        assert all(trial.record.failed_phase in tuple(Phase) for trial in told)
        lost = {seed: each.failure for each in result.lost for _, seed in each.trials}
        assert sorted(lost) == sorted(wrong_results.WRONG_RECORDS)
        assert {failure.kind for failure in lost.values()} == {RunFailureKind.WRONG_ANSWER}
        details = {seed: failure.detail for seed, failure in lost.items()}
        assert details[2] == "it is the record of another trial"
        assert details[6] == "it does not have the steps of the task in their order"
        assert "task_time_s" in details[5]
        assert details[7] == "it does not have the planned moves of the task in their order"
        assert details[8] == "it failed in a step that the task does not have"
        assert store.failures([key_of(specs[1])]).keys() == {key_of(specs[1])}
    assert verify(tmp_path / "evidence.sqlite", label="it").damages == ()


def test_a_whole_trial_that_fails_is_named_as_such(wrong_results, specs_of, tmp_path):
    def refused(task, needed):
        if task.spec.seed == 2:
            raise SimulationError("no world", hint="make one")
        return wrong_results.worker_doubles.quick(task, needed)

    specs, told = specs_of([1, 2]), []
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        result = sweep(specs, store, jobs=0, share=False, maker=refused, on_finished=told.append)
    (lost,) = result.lost
    assert lost.trials == ((1, 2),)
    assert (lost.failure.what, lost.failure.key, lost.failure.attempts) == ("trial", key_of(specs[1]), 1)
    assert lost.failure.detail == "no world (make one)"
    assert [trial.record.seed for trial in told] == [1]


def test_pieces_that_do_not_fit_each_other_cost_their_trial_alone(wrong_results, specs_of, tmp_path, monkeypatch):
    specs = specs_of([1, 2, 3])
    record_of = sweep.__globals__["record_of"]

    def breaking(spec, pieces):
        if spec.seed == 2:
            raise KeyError("lift")
        return replace(record_of(spec, pieces), metrics={"x": math.nan}) if spec.seed == 3 else record_of(spec, pieces)

    monkeypatch.setitem(sweep.__globals__, "record_of", breaking)
    told = []
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        result = sweep(specs, store, jobs=0, maker=wrong_results.worker_doubles.quick, on_finished=told.append)
    assert [trial.record.seed for trial in told] == [1]
    assert [each.trials for each in result.lost] == [((1, 2),), ((1, 3),)]
    assert result.lost[0].failure.detail == "its pieces make no record: KeyError: 'lift'"
    assert {each.failure.what for each in result.lost} == {"trial"}


def test_a_detail_is_cut_and_steers_nothing(wrong_results, specs_of, tmp_path):
    def refused(task, needed):
        raise RuntimeError("\x1b[2J\u202e\u2066 [bold red]\n\trgss: all is well\n" + "x" * 10_000)

    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        result = sweep(specs_of([1]), store, jobs=0, maker=refused, on_finished=lambda _: None)
        (lost,) = result.lost
        assert len(lost.failure.detail) == 500
        assert lost.failure.detail.isprintable()
        assert lost.failure.detail.startswith("RuntimeError: �[2J�� [bold red] rgss: all is well xxx")
        assert lost.failure.detail.endswith("x…")
        assert store.failures([lost.failure.key])[lost.failure.key] == lost.failure


def test_every_right_answer_is_one(wrong_results, specs_of):
    (trial,) = trials_of(specs_of([1]))
    pieces = {}
    for task in tasks_of(trial.spec, trial.digests):
        pieces[task.digest] = wrong_results.worker_doubles.quick(
            task, {digest: pieces[digest] for digest in task.needs}
        )
        assert answer_problem(task, pieces[task.digest]) == ""
    whole = TrialTask(digest=trial.key, spec=trial.spec)
    assert answer_problem(whole, wrong_results.worker_doubles.quick(whole, {})) == ""


@pytest.mark.parametrize(
    "ended",
    [
        None,
        "done",
        Ended(key="other", result=1, failure=None, took_s=0.0),
        Ended(key="k", result=1, failure=None, took_s=math.nan),
        Ended(key="k", result=1, failure=None, took_s=-1.0),
        Ended(key="k", result=1, failure=None, took_s="1"),
        Ended(key="k", result=1, failure="trouble", took_s=1.0),
        Ended(key="k", result=1, failure=TaskError(kind="crashed", detail="x", may_pass=True), took_s=1.0),
        Ended(
            key="k", result=1, failure=TaskError(kind=RunFailureKind.CRASHED, detail=None, may_pass=True), took_s=1.0
        ),
    ],
)
def test_what_is_not_the_end_of_a_task(ended):
    assert not is_end_of(ended, "k")


def test_what_is_the_end_of_a_task():
    assert is_end_of(Ended(key="k", result=object(), failure=None, took_s=1.5), "k")
    assert is_end_of(wrong_answer("k", "why"), "k")
