"""Sweeps as the command line runs them: interrupted, killed, robbed of their workers, and resumed."""

from __future__ import annotations

import contextlib
import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rgss.evidence import EvidenceStore
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.sweep import sweep

pytestmark = pytest.mark.engine

SHORT = ["--jobs", "2", "--fidelity", "kinematic"]


def rgss(*arguments):
    return subprocess.Popen(
        [sys.executable, "-m", "rgss.cli.main", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


@pytest.mark.verifies("SYS-026")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupted_sweep_stops_at_once_and_goes_on_later(folder, jobs):
    arguments = ["sweep", "--project", str(folder), "--only", "1,10", *SHORT, "--jobs", jobs]
    process = rgss(*arguments)
    evidence = folder / ".rgss" / "evidence.sqlite"
    wait_for(lambda: stored(evidence, "pieces") > 0, process)
    # Ctrl-C in a terminal reaches the workers too.
    os.killpg(process.pid, signal.SIGINT)
    asked = time.monotonic()
    output, errors = process.communicate(timeout=30)
    took_s = time.monotonic() - asked

    assert (process.returncode, output, errors) == (130, "", "rgss: interrupted; what was finished is kept\n")
    assert took_s < 2.0
    kept, pieces = stored(evidence), stored(evidence, "pieces")
    assert kept < 6
    assert 0 < pieces < 15
    output, errors = rgss(*arguments).communicate(timeout=120)
    assert errors == ""
    assert output.startswith(f"6 trials: {6 - kept} run, {kept} from evidence; ")
    assert stored(evidence) == 6
    assert stored(evidence, "pieces") == 15


@pytest.mark.verifies("SYS-026")
def test_a_sweep_that_is_killed_leaves_no_process_and_goes_on_to_the_same_end(folder):
    arguments = ["sweep", "--project", str(folder), "--only", "1,2,10", *SHORT, "--replicates", "2"]
    process = rgss(*arguments)
    evidence = folder / ".rgss" / "evidence.sqlite"
    wait_for(lambda: stored(evidence, "pieces") > 0, process)
    workers = workers_of(process.pid)
    process.kill()
    process.communicate()
    assert workers
    wait_until(lambda: not any(is_running(pid) for pid in workers))
    assert stored(evidence) < 6
    rgss(*arguments).communicate(timeout=120)

    project = load_project(folder).with_fidelity("kinematic").with_replicates(2)
    variants = [project.designs.variant(number) for number in (1, 2, 10)]
    with EvidenceStore.open(folder / "undisturbed.sqlite") as undisturbed, EvidenceStore.open(evidence) as resumed:
        sweep(trial_specs(project, variants=variants), undisturbed, jobs=0, on_finished=lambda _: None)
        assert len(undisturbed) == 6
        assert digests_in(resumed) == digests_in(undisturbed)


def test_workers_that_are_killed_cost_nothing_but_time(folder):
    process = rgss("sweep", "--project", str(folder), "--only", "1-3,10-12", *SHORT, "--json")
    wait_for(lambda: stored(folder / ".rgss" / "evidence.sqlite", "pieces") > 0, process)
    for worker in workers_of(process.pid):
        os.kill(worker, signal.SIGKILL)
    output, errors = process.communicate(timeout=120)

    assert (process.returncode, errors) == (0, "")
    assert '"run": 18' in output
    assert '"run_failures": []' in output
    assert workers_of(process.pid) == []


def digests_in(store):
    return {trial.key: trial.content_digest for trial in store.all()}


def wait_for(condition, process, timeout_s=60.0):
    end = time.monotonic() + timeout_s
    while not condition():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.02)


def wait_until(condition, timeout_s=20.0):
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def is_running(pid):
    try:
        return (Path("/proc") / str(pid) / "stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def stored(evidence, table="trials"):
    """How many trials or pieces are in a store that another process may be writing."""
    if not evidence.exists():
        return 0
    connection = sqlite3.connect(f"file:{evidence}?mode=ro", uri=True)
    try:
        return connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0]  # noqa: S608 - a table's name
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
