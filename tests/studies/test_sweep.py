"""Sweeps: resumed, shared among processes, interrupted, and survived."""

from __future__ import annotations

import contextlib
import os
import signal
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

import rgss.studies.sweep as sweep_module
from rgss.errors import EvidenceError, MotionError, SimulationError
from rgss.evidence import EvidenceStore, record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.sweep import batches_of, key_of, sweep
from rgss.trials.spec import digests_of
from rgss.trials.versions import versions


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


@pytest.fixture
def specs_of(shipped):
    """Makes the trials of some variants with some seeds."""

    def make(*variants, seeds=(1,)):
        return trial_specs(shipped, variants=[shipped.designs.variant(number) for number in variants], seeds=seeds)

    return make


def run(specs, store, jobs=1):
    """Sweep; return what was finished, in the order in which it was told."""
    finished = []
    sweep(specs, store, jobs=jobs, on_finished=finished.append)
    return finished


def digests_in(store):
    return {trial.key: trial.content_digest for trial in store.all()}


def rgss(*arguments, **options):
    return subprocess.Popen(
        [sys.executable, "-m", "rgss.cli.main", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **options,
    )


def test_keys_are_distinct_and_stable(shipped, folder):
    specs = trial_specs(shipped)
    keys = [key_of(spec) for spec in specs]

    assert len(set(keys)) == 216
    # The same project elsewhere has the same keys, and other replicates do not change them.
    elsewhere = load_project(folder).with_replicates(4)
    assert [key_of(spec) for spec in trial_specs(elsewhere) if spec.seed < 4] == keys


def test_a_change_of_the_scene_changes_the_keys(shipped, folder, edit):
    edit("scenes/restaurant.yaml", "mass: 0.25 kg", "mass: 0.26 kg")
    before, after = ([key_of(spec) for spec in trial_specs(each)] for each in (shipped, load_project(folder)))

    assert not {*before} & {*after}


def test_trials_that_share_a_plan_are_one_batch(shipped):
    batches = batches_of(trial_specs(shipped))

    assert sorted(len(batch.specs) for batch in batches) == [12] * 18
    for batch in batches:
        assert len({digests_of(spec, versions()).plan for spec in batch.specs}) == 1


def test_what_is_kept_is_told_and_not_run(shipped, filled, record_of, monkeypatch):
    store = filled(shipped, record_of)
    monkeypatch.setattr(sweep_module, "run_shared", lambda _: pytest.fail("a trial was run"))
    specs = trial_specs(shipped)
    finished = run(specs, store)

    assert [trial.key for trial in finished] == [key_of(spec) for spec in specs]
    assert {trial.fresh for trial in finished} == {False}


def test_a_trial_that_is_asked_for_twice_is_run_once(specs_of, filled, shipped, record_of, store, monkeypatch):
    monkeypatch.setattr(sweep_module, "run_shared", made_up(record_of))

    assert len(run([*specs_of(65), *specs_of(65)], store)) == 1


def made_up(record_of):
    """Stands in for the simulation."""

    def run_shared(specs):
        for spec in specs:
            yield spec, digests_of(spec, versions()), record_of(spec)

    return run_shared


@pytest.mark.verifies("SYS-026")
def test_only_what_is_missing_is_run(specs_of, store, record_of, monkeypatch):
    monkeypatch.setattr(sweep_module, "run_shared", made_up(record_of))
    first = run(specs_of(1, 65), store)
    both = run(specs_of(1, 2, 65, seeds=(1, 2)), store)

    assert [trial.fresh for trial in first] == [True, True]
    assert [trial.record.variant for trial in both if not trial.fresh] == [1, 65]
    assert sorted((trial.record.variant, trial.record.seed) for trial in both if trial.fresh) == [
        (1, 2),
        (2, 1),
        (2, 2),
        (65, 2),
    ]
    assert len(store) == 6


@pytest.mark.verifies("SYS-026")
def test_what_was_finished_before_an_error_is_kept(specs_of, store, record_of, monkeypatch):
    def breaks_at_the_third(specs):
        for number, finished in enumerate(made_up(record_of)(specs)):
            if number == 2:
                raise SimulationError("the physics engine refused a body", hint="check its sizes")
            yield finished

    monkeypatch.setattr(sweep_module, "run_shared", breaks_at_the_third)
    with pytest.raises(SimulationError, match="refused a body"):
        run(specs_of(1, 2, 3, 10), store)

    assert len(store) == 2


def test_another_result_for_the_same_trial_is_an_error(specs_of, store, record_of, monkeypatch):
    monkeypatch.setattr(sweep_module, "run_shared", made_up(record_of))
    monkeypatch.setattr(EvidenceStore, "has", lambda *_: set())
    run(specs_of(65), store)
    monkeypatch.setattr(sweep_module, "run_shared", made_up(lambda spec: record_of(spec, motion_s=9.0)))

    with pytest.raises(EvidenceError, match=r"non-determinism: trial .* of variant 65, seed 1 has another result"):
        run(specs_of(65), store)


@pytest.mark.engine
@pytest.mark.verifies("SYS-021")
def test_records_do_not_depend_on_the_number_of_processes(specs_of, tmp_path):
    specs = specs_of(1, 65)
    with EvidenceStore.open(tmp_path / "one.sqlite") as one, EvidenceStore.open(tmp_path / "two.sqlite") as two:
        alone = run(specs, one)
        together = run(specs[::-1], two, jobs=2)

        assert digests_in(one) == digests_in(two)
    assert {trial.key: record_digest(trial.record) for trial in alone} == {
        trial.key: record_digest(trial.record) for trial in together
    }
    assert {trial.fresh for trial in (*alone, *together)} == {True}


@pytest.mark.engine
def test_an_error_in_a_worker_is_told_as_it_is(specs_of, store):
    specs = [replace(spec, planner="PRM") for spec in specs_of(1, 65)]

    with pytest.raises(MotionError, match="there is no planner 'PRM'") as caught:
        run(specs, store, jobs=2)
    assert caught.value.hint.startswith("the planners are RRT")
    assert len(store) == 0


@pytest.mark.engine
@pytest.mark.verifies("SYS-026")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupted_sweep_stops_at_once_and_goes_on_later(folder, jobs):
    arguments = ["sweep", "--project", str(folder), "--only", "1,19", "--jobs", jobs]
    process = rgss(*arguments)
    evidence = folder / ".rgss" / "evidence.sqlite"
    wait_for(lambda: stored(evidence) > 0, process)
    # Ctrl-C in a terminal reaches the workers too.
    os.killpg(process.pid, signal.SIGINT)
    asked = time.monotonic()
    output, errors = process.communicate(timeout=30)
    took_s = time.monotonic() - asked

    assert (process.returncode, output, errors) == (130, "", "rgss: interrupted; what was finished is kept\n")
    assert took_s < 2.0
    kept = stored(evidence)
    assert 0 < kept < 6
    again = subprocess.run(
        [sys.executable, "-m", "rgss.cli.main", *arguments], capture_output=True, text=True, check=False
    )
    assert (again.returncode, again.stderr) == (0, "")
    assert again.stdout.startswith(f"6 trials: {6 - kept} run, {kept} from evidence; ")
    assert stored(evidence) == 6


@pytest.mark.engine
def test_a_worker_that_dies_is_told_in_one_line(folder):
    process = rgss("sweep", "--project", str(folder), "--only", "1-24", "--jobs", "2")
    wait_for(lambda: len(workers_of(process.pid)) == 2, process)
    os.kill(workers_of(process.pid)[0], signal.SIGKILL)
    output, errors = process.communicate(timeout=60)

    assert (process.returncode, output) == (3, "")
    assert errors == (
        "rgss: a worker process died in the middle of a trial (finished trials are kept; run again, with --jobs 1 "
        "to see which trial it is)\n"
    )
    assert workers_of(process.pid) == []


def wait_for(condition, process, timeout_s=60.0):
    end = time.monotonic() + timeout_s
    while not condition():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.05)


def stored(evidence):
    """How many trials are in a store that another process may be writing."""
    if not evidence.exists():
        return 0
    connection = sqlite3.connect(f"file:{evidence}?mode=ro", uri=True)
    try:
        return connection.execute("SELECT count(*) FROM trials").fetchone()[0]
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()


def workers_of(pid):
    """The processes of a pool: children of a process that run a piece of multiprocessing."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has just ended
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == pid and "spawn_main" in (entry / "cmdline").read_text():
                found.append(int(entry.name))
    return found
