"""What is left of a pool that is killed: no file, no folder, no process; and pools without a temporary folder."""

from __future__ import annotations

import os
import resource
import select
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fixtures.processes import PATIENCE_S

DOUBLES = Path(__file__).parent / "doubles"

PROGRAM = """\
import sys
import tempfile
tempfile.tempdir = sys.argv[4]
sys.path.insert(0, sys.argv[1])
import task_doubles
from pathlib import Path
from rgss.sweep.workers import WorkerPool

if __name__ == "__main__":
    with WorkerPool(task_doubles.act, size=1) as pool:
        while not pool.free:
            pool.prepare_for(1)
            pool.wait(0.1)
        pool.begin("hang", (sys.argv[2],))
        ended = []
        while not ended and not [*Path(sys.argv[3]).glob("hanging-*")]:
            ended = pool.wait(0.01)
        print(pool._workers[0].process.pid if not ended else ended[0].failure or "done", flush=True)
        if not ended:
            pool.wait(1000.0)
"""


@pytest.fixture
def start(tmp_path):
    """Starts a pool in a process of its own, with a temporary folder of its own."""
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    (tmp_path / "marks").mkdir()
    script = tmp_path / "program.py"
    script.write_text(PROGRAM, encoding="utf-8")

    def run(task, *, folder=temporary, **options):
        environment = {**os.environ, "TMPDIR": str(folder), "WORKER_DOUBLES_FOLDER": str(tmp_path / "marks")}
        command = [sys.executable, str(script), str(DOUBLES), task, str(tmp_path / "marks"), str(folder)]
        return subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
        )

    run.temporary = temporary
    return run


@pytest.mark.parametrize("task", ["hang", "hang_with_a_file"])
def test_a_pool_that_is_killed_leaves_nothing(start, task):
    process = start(task)
    worker = int(process.stdout.readline())
    watched = os.pidfd_open(worker)
    process.send_signal(signal.SIGKILL)
    process.communicate()

    # The worker ends by itself when its parent has; this waits for exactly that.
    assert select.select([watched], [], [], PATIENCE_S)[0]
    os.close(watched)
    assert [*start.temporary.iterdir()] == []


def test_a_pool_that_is_interrupted_leaves_nothing(start):
    """Its workers are killed where they are, with their files open."""
    process = start("hang_with_a_file", preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    assert process.stdout.readline().strip().isdecimal()
    assert [*start.temporary.rglob("robot.urdf")]
    process.send_signal(signal.SIGINT)
    process.communicate()

    assert [*start.temporary.iterdir()] == []


def test_a_worker_that_timed_a_motion_leaves_nothing_where_there_is_no_home(start, monkeypatch):
    """The engine imports Matplotlib, which without a home would make a folder of its own for each worker."""
    monkeypatch.setenv("HOME", "/proc/none")
    for name in ("MPLCONFIGDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    process = start("time_and_hang")
    worker = int(process.stdout.readline())
    watched = os.pidfd_open(worker)
    process.send_signal(signal.SIGKILL)
    process.communicate()

    assert select.select([watched], [], [], PATIENCE_S)[0]
    os.close(watched)
    assert [*start.temporary.iterdir()] == []


def test_a_pool_needs_no_temporary_folder(start, tmp_path):
    process = start("who", folder=tmp_path / "nowhere")
    output, errors = process.communicate(timeout=PATIENCE_S)
    assert (output, errors) == ("done\n", "")


def test_few_open_files_are_enough_or_end_in_one_line(start):
    def limited(number):
        def limit():
            resource.setrlimit(resource.RLIMIT_NOFILE, (number, number))

        return limit

    process = start("who", preexec_fn=limited(32))
    assert process.communicate(timeout=PATIENCE_S) == ("done\n", "")
    process = start("who", preexec_fn=limited(7))
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert errors.splitlines()[-1].startswith(
        "rgss.errors.SimulationError: a worker process cannot start: Too many open files ("
    )
