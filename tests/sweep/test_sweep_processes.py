"""Sweeps as the command line runs them: interrupted, killed, robbed of their workers, and resumed.

The workers are held at a known point by `doubles/held_sweep.py`, so that no test depends on how
fast the machine is: what is interrupted is never finished, and what is waited for always comes.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sqlite3
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from rgss.evidence import EvidenceStore
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.running import sweep
from tests.fixtures.processes import PATIENCE_S, is_running, wait_until

pytestmark = pytest.mark.engine

HELD_SWEEP = Path(__file__).parent / "doubles" / "held_sweep.py"
SHORT = ["--jobs", "2", "--fidelity", "kinematic"]
MANY = 1000
"""So many tasks that no worker is held."""


@dataclass(frozen=True)
class HeldSweep:
    """A sweep whose workers stop after a number of tasks."""

    process: subprocess.Popen
    marks: Path

    def wait_until_held(self, workers):
        """Wait until this many workers have stopped, and what was made before is in the store."""
        wait_for(lambda: len(self.held()) == workers, self.process)

    def held(self):
        """The processes that have stopped."""
        return [int(mark.name.partition("-")[2]) for mark in self.marks.glob("held-*")]

    def open_gate(self):
        """Let all workers go on, those that come later too: the pipe becomes a file."""
        (self.marks / "open").touch()
        (self.marks / "open").replace(self.marks / "gate")


def rgss(*arguments):
    return start("-m", "rgss.cli.main", *arguments)


def start(*words):
    return subprocess.Popen(
        [sys.executable, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )


@pytest.fixture
def held_sweep(tmp_path):
    """Starts a sweep whose workers stop after a number of tasks."""
    started = []

    def begin(*arguments, tasks, pieces="quick"):
        marks = tmp_path / f"marks-{len(started)}"
        marks.mkdir()
        os.mkfifo(marks / "gate")
        process = start(str(HELD_SWEEP), str(marks), str(tasks), pieces, *arguments)
        started.append(process)
        return HeldSweep(process=process, marks=marks)

    yield begin
    for process in started:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


@pytest.mark.verifies("SYS-026")
@pytest.mark.parametrize("jobs", [1, 2])
def test_an_interrupted_sweep_stops_at_once_and_goes_on_later(folder, held_sweep, jobs):
    arguments = ["sweep", "--project", str(folder), "--only", "1,10", *SHORT, "--jobs", str(jobs)]
    evidence = folder / ".rgss" / "evidence.sqlite"
    sweeping = held_sweep(*arguments, tasks=4)
    sweeping.wait_until_held(jobs)
    wait_for(lambda: stored(evidence, "pieces") == 4, sweeping.process)
    # Ctrl-C in a terminal reaches the workers too, which would wait at the gate for ever.
    os.killpg(sweeping.process.pid, signal.SIGINT)
    output, errors = sweeping.process.communicate(timeout=PATIENCE_S)

    assert (sweeping.process.returncode, output) == (130, "")
    assert errors == "rgss: interrupted; finished trials are stored\n"
    assert not any(is_running(pid) for pid in sweeping.held())
    kept = stored(evidence)
    assert kept < 6
    assert stored(evidence, "pieces") == 4
    output, errors = held_sweep(*arguments, tasks=MANY).process.communicate(timeout=PATIENCE_S)
    assert errors == ""
    assert output.startswith(f"6 trials: {6 - kept} run, {kept} from evidence; ")
    assert stored(evidence) == 6
    assert stored(evidence, "pieces") == 15


@pytest.mark.verifies("SYS-026")
def test_a_sweep_that_is_killed_leaves_no_process_and_goes_on_to_the_same_end(folder, held_sweep):
    arguments = ["sweep", "--project", str(folder), "--only", "1,2,10", *SHORT, "--replicates", "2"]
    evidence = folder / ".rgss" / "evidence.sqlite"
    sweeping = held_sweep(*arguments, tasks=3, pieces="real")
    sweeping.wait_until_held(2)
    wait_for(lambda: stored(evidence, "pieces") == 3, sweeping.process)
    workers = workers_of(sweeping.process.pid)
    sweeping.process.kill()
    sweeping.process.communicate(timeout=PATIENCE_S)
    assert sorted(workers) == sorted(sweeping.held())
    wait_until(lambda: not any(is_running(pid) for pid in workers))
    assert stored(evidence) < 6
    rgss(*arguments).communicate(timeout=PATIENCE_S)

    project = load_project(folder).with_fidelity("kinematic").with_replicates(2)
    variants = [project.designs.variant(number) for number in (1, 2, 10)]
    with EvidenceStore.open(folder / "undisturbed.sqlite") as undisturbed, EvidenceStore.open(evidence) as resumed:
        sweep(trial_specs(project, variants=variants), undisturbed, jobs=1, on_finished=lambda _: None)
        assert len(undisturbed) == 6
        assert digests_in(resumed) == digests_in(undisturbed)


def test_workers_that_are_killed_cost_nothing_but_time(folder, held_sweep):
    sweeping = held_sweep("sweep", "--project", str(folder), "--only", "1-3,10-12", *SHORT, "--json", tasks=3)
    sweeping.wait_until_held(2)
    workers = sweeping.held()
    sweeping.open_gate()
    for worker in workers:
        os.kill(worker, signal.SIGKILL)
    output, errors = sweeping.process.communicate(timeout=PATIENCE_S)

    assert (sweeping.process.returncode, errors) == (0, "")
    assert '"run": 18' in output
    assert '"run_failures": []' in output
    assert not any(is_running(pid) for pid in workers)
    assert workers_of(sweeping.process.pid) == []


def digests_in(store):
    return {trial.key: trial.content_digest for trial in store.all()}


def wait_for(condition, process):
    """Wait for what a process does; it ends in the meantime only by mistake."""

    def is_so():
        if condition():
            return True
        assert process.poll() is None, process.communicate()
        return False

    wait_until(is_so)


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
