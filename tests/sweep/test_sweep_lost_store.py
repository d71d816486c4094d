"""A store that is lost in the middle of a sweep: the sweep ends, and what was finished is saved."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rgss.errors import StorageError
from rgss.evidence import EvidenceStore
from rgss.evidence.store.verification import verify
from rgss.studies.expansion import trial_specs
from rgss.sweep import evidence_writer as keeping
from rgss.sweep.inline_workers import InlineWorkers
from rgss.sweep.running import sweep
from rgss.sweep.trial_keys import trials_of

DOUBLES = Path(__file__).parent / "doubles"


@pytest.fixture
def doubles(monkeypatch):
    monkeypatch.syspath_prepend(DOUBLES)
    import worker_doubles

    return worker_doubles


@pytest.fixture
def specs(shipped):
    kinematic = shipped.with_fidelity("kinematic")
    return trial_specs(kinematic, variants=[kinematic.designs.variant(number) for number in (1, 10)], seeds=range(5))


LOSSES = {
    "removed": lambda path: path.unlink(),
    "replaced": lambda path: (path.unlink(), EvidenceStore.open(path).close()),
    "cut to nothing": lambda path: os.truncate(path, 0),
    "without its log": lambda path: path.with_name(f"{path.name}-wal").unlink(),
}


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("at_once", [True, False], ids=["put at once", "put in the end"])
@pytest.mark.parametrize("task", [1, 12, 25])
def test_what_was_finished_is_saved(doubles, specs, tmp_path, monkeypatch, loss, at_once, task):
    monkeypatch.setattr(keeping, "LONGEST_S", 0.0 if at_once else 1000.0)
    path = tmp_path / "evidence.sqlite"
    begun = []

    def losing(made, needed):
        begun.append(made)
        if len(begun) == task:
            LOSSES[loss](path)
        return doubles.quick(made, needed)

    assert len({piece for trial in trials_of(specs) for piece in trial.pieces.values()}) == 25
    told = []
    with EvidenceStore.open(path, label="it") as store, pytest.raises(StorageError) as caught:
        sweep(specs, store, jobs=0, maker=losing, on_finished=told.append)
    assert " while it was in use; " in str(caught.value)
    rescued = path.with_name("evidence.sqlite.rescued")
    found = verify(rescued, label="it")
    assert found.damages == ()
    # What is cut is lost but for what is in the log and in memory; a small store is wholly there.
    # The last piece may not have been taken in yet when the loss was noticed.
    assert found.sound["piece"] >= task - 1
    with EvidenceStore.open(rescued) as store:
        assert {trial.key for trial in told} <= {trial.key for trial in store.all()}
        # The sweep goes on from there.
        again = []
        sweep(specs, store, jobs=0, maker=doubles.quick, on_finished=again.append)
        assert len(again) == 10


def test_a_loss_after_the_last_commit_is_noticed_too(doubles, specs, tmp_path, monkeypatch):
    path = tmp_path / "evidence.sqlite"
    put_many = EvidenceStore.put_many

    def losing(store, **rows):
        put = put_many(store, **rows)
        path.unlink(missing_ok=True)
        return put

    monkeypatch.setattr(EvidenceStore, "put_many", losing)
    monkeypatch.setattr(keeping, "LONGEST_S", 1000.0)
    with EvidenceStore.open(path, label="it") as store, pytest.raises(StorageError, match="it was removed"):
        sweep(specs, store, jobs=0, maker=doubles.quick, on_finished=lambda _: None)


def test_an_interrupted_sweep_does_not_say_that_its_store_is_there(doubles, specs, tmp_path):
    path = tmp_path / "evidence.sqlite"

    def interrupted(made, needed):
        path.unlink()
        raise KeyboardInterrupt

    with EvidenceStore.open(path, label="it") as store, pytest.raises(StorageError, match="was removed"):
        sweep(specs, store, jobs=0, maker=interrupted, on_finished=lambda _: None)


@pytest.mark.parametrize("loss", ["removed", "without its log"])
def test_what_was_finished_before_a_task_failed_is_saved_too(doubles, specs, tmp_path, monkeypatch, loss):
    monkeypatch.setattr(keeping, "LONGEST_S", 1000.0)
    path = tmp_path / "evidence.sqlite"
    begun = []

    def failing(made, needed):
        begun.append(made)
        if len(begun) < 12:
            return doubles.quick(made, needed)
        LOSSES[loss](path)
        raise RuntimeError("the task failed")

    with EvidenceStore.open(path, label="it") as store, pytest.raises(StorageError, match="while it was in use"):
        sweep(specs, store, jobs=0, maker=failing, on_finished=lambda _: None)
    found = verify(path.with_name("evidence.sqlite.rescued"), label="it")
    assert found.damages == ()
    assert found.sound["piece"] == 11


def test_an_interrupt_while_workers_end_loses_nothing(doubles, specs, tmp_path, monkeypatch):
    monkeypatch.setattr(keeping, "LONGEST_S", 1000.0)
    begun = []

    def interrupted(made, needed):
        begun.append(made)
        if len(begun) == 12:
            raise KeyboardInterrupt
        return doubles.quick(made, needed)

    def interrupted_again(workers):
        raise KeyboardInterrupt

    monkeypatch.setattr(InlineWorkers, "close", interrupted_again)
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as store:
        with pytest.raises(KeyboardInterrupt):
            sweep(specs, store, jobs=0, maker=interrupted, on_finished=lambda _: None)
        assert len(store.database.rows("SELECT * FROM pieces")) == 11
