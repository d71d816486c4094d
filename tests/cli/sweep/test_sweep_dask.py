"""``rgss sweep --dask``: the same sweep on a cluster, and one line where there is none."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import sqlite3
import subprocess
import sys
import threading

import pytest
from distributed import LocalCluster

from rgss.errors import EvidenceError
from rgss.evidence.records.origin import machine
from rgss.studies.expansion import trial_specs
from rgss.sweep.dask import cluster as dask_cluster
from rgss.sweep.workers import WorkerPool
from tests.fixtures.processes import PATIENCE_S, wait_until


@pytest.fixture(scope="module")
def address():
    """Where the scheduler of a cluster of two threads is."""
    with LocalCluster(
        n_workers=1,
        threads_per_worker=2,
        processes=False,
        protocol="tcp://",  # so that other processes reach it
        dashboard_address=":0",
        silence_logs=60,
    ) as cluster:
        yield cluster.scheduler_address


@pytest.fixture
def sweep(rgss, folder):
    """Sweeps a few variants kinematically."""

    def run(*words):
        options = ["--project", folder, "--fidelity", "kinematic", *words]
        return rgss("sweep", *options)

    return run


@pytest.mark.engine
@pytest.mark.verifies("SYS-026")
def test_a_sweep_on_a_cluster_says_what_a_sweep_here_says(sweep, folder, address):
    there = sweep("--replicates", 1, "--only", "10,65", "--dask", address)
    assert (there.status, there.errors) == (0, "")
    assert there.output.splitlines()[:2] == [
        "2 trials: 2 run, 0 from evidence; 2 succeeded, 0 failed.",
        "Pieces: 2 plans, 2 timings, 2 executions made.",
    ]
    document = sweep("--replicates", 1, "--only", "10,65", "--dask", address, "--json").document
    assert (document["run"], document["from_evidence"], document["pieces_made"]) == (0, 2, {})
    (folder / ".rgss" / "evidence.sqlite").unlink()
    here = sweep("--replicates", 1, "--only", "10,65", "--jobs", 1)
    assert here.output == there.output


@pytest.fixture
def gate(folder, monkeypatch):
    """Closed as soon as a trial is stored: no task begins any more, so that a sweep is never finished."""
    opened = threading.Event()
    begin = WorkerPool.begin

    def held(pool, *task):
        if stored(folder / ".rgss" / "evidence.sqlite") > 0:
            assert opened.wait(PATIENCE_S)
        begin(pool, *task)

    monkeypatch.setattr(WorkerPool, "begin", held)
    yield opened
    opened.set()


@pytest.mark.engine
@pytest.mark.verifies("SYS-026")
def test_an_interrupted_sweep_on_a_cluster_stops_at_once_and_keeps_what_was_finished(folder, address, gate):
    words = ["--project", str(folder), "--fidelity", "kinematic", "--only", "1,10,65", "--replicates", "20"]
    process = subprocess.Popen(
        [sys.executable, "-m", "rgss.cli.main", "sweep", *words, "--dask", address],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    wait_until(lambda: stored(folder / ".rgss" / "evidence.sqlite") > 0 or process.poll() is not None)
    # The Dask worker is in this process, so the engine processes are children of it. Held like this, they
    # answer nothing any more: the command ends without waiting for them, or not at all.
    for engines in multiprocessing.active_children():
        # One that an earlier sweep has stopped may be ending just now.
        with contextlib.suppress(ProcessLookupError):
            os.kill(engines.pid, signal.SIGSTOP)
    os.killpg(process.pid, signal.SIGINT)
    output, errors = process.communicate(timeout=PATIENCE_S)

    assert (process.returncode, output, errors) == (130, "", "rgss: interrupted; finished trials are stored\n")
    assert 0 < stored(folder / ".rgss" / "evidence.sqlite") < 60
    gate.set()
    wait_until(lambda: not multiprocessing.active_children())


@pytest.mark.engine
def test_until_decided_runs_on_a_cluster_too(sweep, address, monkeypatch):
    ran = []

    def run_a_few(project, store, run, **_):
        specs = trial_specs(project.with_replicates(1), variants=[project.designs.variant(65)])
        run(specs)
        ran.extend(trial.provenance.machine for trial in store.all())
        raise EvidenceError("that is enough")

    monkeypatch.setattr("rgss.decision.replicate_until_decided", run_a_few)
    told = sweep("--until", "decided", "--dask", address)

    assert (told.status, told.complaint) == (2, "rgss: that is enough")
    assert ran == [machine()]


def test_jobs_and_a_cluster_exclude_each_other(sweep):
    told = sweep("--dask", "tcp://127.0.0.1:1", "--jobs", 2)

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        "rgss: --dask and --jobs exclude each other (a Dask cluster has as many workers as it was started with)"
    )


def test_an_address_without_a_scheduler_is_one_line(sweep, folder, monkeypatch):
    monkeypatch.setitem(dask_cluster.dask_cluster.__wrapped__.__kwdefaults__, "patience_s", 0.2)
    told = sweep("--dask", "tcp://127.0.0.1:1")

    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        "rgss: no Dask scheduler answers at tcp://127.0.0.1:1 (start one with 'dask scheduler', or correct the address)"
    )
    assert not (folder / ".rgss").exists()


def test_a_dry_run_asks_no_cluster(sweep):
    told = sweep("--dry-run", "--replicates", 1, "--only", "65", "--dask", "tcp://127.0.0.1:1")

    assert (told.status, told.output.splitlines()[0]) == (0, "1 trial: 1 to run, 0 from evidence.")


def stored(evidence):
    """How many pieces are in a store that another process may be writing."""
    if not evidence.exists():
        return 0
    connection = sqlite3.connect(f"file:{evidence}?mode=ro", uri=True)
    try:
        return connection.execute("SELECT count(*) FROM pieces").fetchone()[0]
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()
