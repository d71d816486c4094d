"""The process beside a script that makes its trials: results, errors and ends as if it were this one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.sweep import engine_process
from rgss.sweep.engine_process import EngineProcess, compute
from rgss.trials.code.kernel_environment import problem_here
from tests.fixtures.processes import is_running, wait_until

REPOSITORY = Path(__file__).parents[2]


@pytest.fixture
def process():
    engine = EngineProcess()
    yield engine
    engine.close()


def test_it_computes_with_the_numeric_environment_and_stays(process):
    assert process.call(problem_here, ()) == ""
    first = process.call(os.getpid, ())
    assert first == process.call(os.getpid, ()) != os.getpid()


def test_a_process_that_computes_so_itself_needs_no_other():
    assert compute(os.getpid) == os.getpid()


def test_another_process_is_used_where_this_one_does_not(monkeypatch, process):
    monkeypatch.setattr(engine_process, "is_in_force", lambda: False)
    monkeypatch.setattr(engine_process, "_engine_process_of", lambda _: process)
    assert compute(os.getpid) != os.getpid()


def test_an_error_comes_back_as_it_was_raised(process):
    # What the process can import by its name: tests are no module to it.
    with pytest.raises(SimulationError, match="no world") as caught:
        process.call(exec, ("from rgss.errors import SimulationError\nraise SimulationError('no world', hint='h')",))
    assert caught.value.hint == "h"
    with pytest.raises(SimulationError, match=r"^the trial could not be run: ZeroDivisionError: .* by zero$"):
        process.call(divmod, (1, 0))
    assert process.call(divmod, (7, 2)) == (3, 1)


def test_a_crash_is_told_and_the_next_call_has_a_process_again(process):
    with pytest.raises(SimulationError, match=r"^the process that ran the trial was killed by SIGKILL$"):
        process.call(exec, ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)",))
    with pytest.raises(SimulationError, match=r"ended with status 3: so it goes$"):
        process.call(exec, ("import os; os.write(2, b'so it goes\\n'); os._exit(3)",))
    assert process.call(divmod, (7, 2)) == (3, 1)


def test_it_prints_nothing(process, capfd):
    process.call(print, ("engines print",))
    assert capfd.readouterr() == ("", "")


SCRIPT = """
import os, sys
from rgss.sweep.engine_process import EngineProcess
process = EngineProcess()
print(process.call(os.getpid, ()), flush=True)
sys.stdin.read()
"""


def test_nothing_is_left_open_at_the_exit():
    leave = SCRIPT.replace("sys.stdin.read()", "")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", leave], capture_output=True, text=True, cwd=REPOSITORY, check=True
    )
    assert done.stderr == ""


def test_it_ends_with_the_process_that_started_it_even_if_that_is_killed():
    with subprocess.Popen(
        [sys.executable, "-c", SCRIPT], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=REPOSITORY
    ) as script:
        child = int(script.stdout.readline())
        os.kill(script.pid, signal.SIGKILL)
        script.wait()
        wait_until(lambda: not is_running(child))


def test_its_temporary_files_end_with_it(process):
    """An interrupt kills it where it is, as while the engine reads a robot from a file."""
    held = "import os, tempfile; folder = tempfile.mkdtemp(); os.kill(os.getpid(), 9)"
    before = process.call(eval, ("__import__('tempfile').gettempdir()",))
    with pytest.raises(SimulationError):
        process.call(exec, (held,))
    assert not Path(before).exists()


def test_its_temporary_files_end_when_its_parent_is_killed(tmp_path):
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    with subprocess.Popen(
        [sys.executable, "-c", SCRIPT],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        cwd=REPOSITORY,
        env=environment,
    ) as script:
        child = int(script.stdout.readline())
        assert len([*tmp_path.iterdir()]) == 1
        os.kill(script.pid, signal.SIGKILL)
        script.wait()
        wait_until(lambda: not is_running(child))
    assert [*tmp_path.iterdir()] == []


FORKED = """
import json, multiprocessing, os
from rgss.sweep import engine_process
from rgss.sweep.engine_process import compute

engine_process.is_in_force = lambda: False
def asked(number):
    return number, abs(compute(eval, f"{-number}")), compute(os.getpid)

before = compute(os.getpid)
with multiprocessing.get_context("fork").Pool(3) as pool:
    answers = pool.map(asked, range(60), chunksize=1)
print(json.dumps({"before": before, "answers": answers, "after": compute(os.getpid)}))
"""


def test_a_fork_has_an_engine_process_of_its_own():
    told = subprocess.run(
        [sys.executable, "-W", "error", "-c", FORKED], cwd=REPOSITORY, capture_output=True, text=True, check=True
    )
    result = json.loads(told.stdout)

    assert [asked for asked, _, _ in result["answers"]] == [got for _, got, _ in result["answers"]] == list(range(60))
    assert result["before"] == result["after"]
    assert result["before"] not in {process for _, _, process in result["answers"]}
    assert told.stderr == ""
