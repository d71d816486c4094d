"""The pool of workers: what becomes of a task that ends well, badly or never."""

from __future__ import annotations

import contextlib
import errno
import os
import pickle
import signal
import tracemalloc
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.evidence import RunFailureKind
from rgss.sweep.inline_workers import InlineWorkers
from rgss.sweep.task_end import Ended, TaskError
from rgss.sweep.workers import WorkerPool
from tests.fixtures.processes import PATIENCE_S

DOUBLES = Path(__file__).parent / "doubles"
GIB = 1024**3


@pytest.fixture
def doubles(monkeypatch):
    monkeypatch.syspath_prepend(DOUBLES)
    import task_doubles

    return task_doubles


class Clock:
    """A time that goes on only when it is told to, so that a limit passes when the worker is known to hang."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def hanging(tmp_path, monkeypatch):
    """Tells whether the task has begun that never ends."""
    monkeypatch.setenv("WORKER_DOUBLES_FOLDER", str(tmp_path))
    return lambda: [*tmp_path.glob("hanging-*")]


def test_one_pool_goes_on_whatever_becomes_of_its_tasks(doubles, carried_out, troubles_of_tasks, clock, hanging):
    names = ["who", "die", "memory_limit", "exit", "fail", "refuse", "allocate", "threads", "interrupted"]
    with WorkerPool(doubles.act, size=2, time_limit_s=5.0, memory_limit_bytes=1 * GIB, clock=clock) as pool:
        assert (pool.size, pool.free) == (2, 0)
        ended = carried_out(pool, {name: (name,) for name in names})
        ended |= timed_out(pool, clock, hanging, {"hang": ("hang",)})
        again = carried_out(pool, {"again": ("who",)})

    assert ended["who"].failure is None
    assert ended["who"].result != os.getpid()
    assert ended["who"].took_s >= 0.0
    assert again["again"].result is not None
    assert ended["memory_limit"].result == GIB
    assert ended["threads"].result == "1"
    assert ended["interrupted"].result is True
    troubles = {name: each.failure for name, each in ended.items() if each.failure is not None}
    assert troubles == {
        **troubles_of_tasks,
        "allocate": TaskError(kind=RunFailureKind.OUT_OF_MEMORY, detail="MemoryError", may_pass=True),
    }


def timed_out(pool, clock, hanging, tasks):
    """Begin a task that hangs, and let its time pass once it does; returns how it ended."""
    ((key, arguments),) = tasks.items()
    while not pool.free:
        pool.prepare_for(1)
        assert pool.wait(0.1) == []
    pool.begin(key, arguments)
    while not hanging():
        assert pool.wait(0.01) == []
    clock.now += 1000.0
    (ended,) = pool.wait(0.0)
    return {ended.key: ended}


def test_a_worker_keeps_what_it_has_loaded_for_the_next_task(doubles, carried_out):
    with WorkerPool(doubles.act, size=1) as pool:
        first = carried_out(pool, {"one": ("who",), "two": ("who",)})
        pid = first["one"].result
        os.kill(pid, signal.SIGKILL)
        after = carried_out(pool, {"three": ("who",)})

    assert first["two"].result == pid
    # Killed while it had nothing to do, or just as it was given something: told once, and never as another's.
    failure = after["three"].failure
    assert failure is None or failure.detail == "the worker was killed by SIGKILL"


def test_no_more_processes_are_started_than_there_are_tasks(doubles, carried_out):
    with WorkerPool(doubles.act, size=8) as pool:
        carried_out(pool, {"one": ("who",)})
        assert pool.free == 1
        pool.prepare_for(0)
        assert pool.free == 1


def test_closing_stops_at_once_and_leaves_no_process(doubles, tmp_path, carried_out):
    with WorkerPool(doubles.act, size=1) as pool:
        pid = carried_out(pool, {"who": ("who",)})["who"].result
        pool.begin("hang", ("hang",))
    # It hangs for ever, so that this is reached only because it is not waited for.
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    pool.close()


def start_for_ever(pool, processes):
    while True:
        pool.prepare_for(processes)
        assert pool.wait(PATIENCE_S) == []


def test_workers_that_cannot_start_are_an_error_in_the_end(doubles):
    problem = r"^a worker process cannot start: .* \(is its memory limit too low"
    with (
        WorkerPool(doubles.act, size=1, memory_limit_bytes=1024) as pool,
        pytest.raises(SimulationError, match=problem),
    ):
        start_for_ever(pool, 1)


@pytest.fixture
def stillborn(monkeypatch, tmp_path):
    """A function that costs so many workers before one of them starts."""
    monkeypatch.syspath_prepend(DOUBLES)
    import stillborn

    def with_deaths(number):
        monkeypatch.setenv(stillborn.FOLDER, str(tmp_path))
        monkeypatch.setenv(stillborn.DEATHS, str(number))
        return stillborn.who

    return with_deaths


@pytest.mark.parametrize(("size", "deaths"), [(1, 1), (1, 3), (3, 4)])
def test_workers_that_are_killed_while_they_start_are_replaced(stillborn, carried_out, tmp_path, size, deaths):
    with WorkerPool(stillborn(deaths), size=size) as pool:
        ended = carried_out(pool, {str(number): () for number in range(2 * size)})

    assert all(each.failure is None for each in ended.values())
    assert len([*tmp_path.iterdir()]) == deaths


def test_workers_that_are_always_killed_while_they_start_end_with_one_line(stillborn, tmp_path):
    with WorkerPool(stillborn(1000), size=2) as pool, pytest.raises(SimulationError) as caught:
        start_for_ever(pool, 2)
    # What it printed is told without what could steer a terminal.
    assert caught.value.message == (
        "a worker process cannot start: the worker was killed by SIGKILL: no room�[31m for engines�, like 4 before it"
    )
    assert len([*tmp_path.iterdir()]) in {5, 6}


@pytest.fixture
def liars(doubles):
    import liars

    return liars


def test_garbage_in_place_of_an_answer_costs_the_worker_and_nothing_else(liars, carried_out):
    """No limit of time is needed to find it, but for what could still become an answer; see the next test."""
    names = [name for name in liars.GARBAGE if name not in UNFINISHED]
    with WorkerPool(liars.act, size=2) as pool:
        ended = carried_out(pool, {name: (name,) for name in [*names, "flood"]})
        after = carried_out(pool, {"who": ("who",)})

    assert {each.failure.kind for each in ended.values()} == {RunFailureKind.WRONG_ANSWER}
    details = {name: each.failure.detail for name, each in ended.items()}
    assert details["zeros"] == "the worker was ended: it wrote something other than an answer to its pipe"
    assert details["a huge length"] == (
        f"the worker was ended: it announced an answer of {2**60} bytes; at most 67108864 are read"
    )
    assert details["a wrong checksum"] == "the worker was ended: its answer was damaged on the way"
    assert details["an answer to another task"] == "the worker was ended: its answer belongs to another task"
    assert details["what cannot be put together"].startswith("the worker was ended: its answer cannot be read: ValueEr")
    assert after["who"].failure is None


UNFINISHED = ["half a head", "less than it says"]


@pytest.mark.parametrize("name", UNFINISHED)
def test_the_beginning_of_an_answer_keeps_nobody_longer_than_the_limit(liars, clock, name, carried_out):
    tracemalloc.start()
    with WorkerPool(liars.act, size=1, time_limit_s=5.0, clock=clock) as pool:
        carried_out(pool, {"who": ("who",)})
        pool.begin("bad", (name,))
        # Each look ends, with what has arrived.
        while not pool._workers[0].channel._reader._buffer:
            assert pool.wait(0.01) == []
        clock.now += 6.0
        (ended,) = pool.wait(PATIENCE_S)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert ended.failure == TaskError(kind=RunFailureKind.TIMED_OUT, detail="not done after 5 s", may_pass=True)
    assert peak < 8 * 1024 * 1024


def test_a_worker_that_takes_no_task_keeps_nobody_longer_than_the_limit(doubles, clock, carried_out):
    with WorkerPool(doubles.act, size=1, time_limit_s=5.0, clock=clock) as pool:
        pid = carried_out(pool, {"who": ("who",)})["who"].result
        os.kill(pid, signal.SIGSTOP)
        # Far more than a pipe holds.
        pool.begin("large", ("who", b"x" * 50_000_000))
        assert pool.wait(0.01) == []
        clock.now += 6.0
        (ended,) = pool.wait(PATIENCE_S)
    assert ended.failure.kind is RunFailureKind.TIMED_OUT


def test_a_large_task_and_a_large_answer_come_through(doubles, carried_out):
    text = "x" * 30_000_000
    with WorkerPool(str.upper, size=1) as pool:
        assert carried_out(pool, {"large": (text,)})["large"].result == text.upper()


def test_what_a_worker_cannot_send_is_told(liars, carried_out):
    with WorkerPool(liars.act, size=1) as pool:
        ended = carried_out(pool, {name: (name,) for name in ("unpicklable", "long", "closes its descriptors")})

    assert "pickle" in ended["unpicklable"].failure.detail
    assert ended["long"].failure.detail.startswith("the result has 6815")
    assert ended["closes its descriptors"].failure.kind is RunFailureKind.CRASHED


def test_a_worker_whose_child_keeps_its_pipe_is_known_to_have_ended(liars, carried_out):
    with WorkerPool(liars.act, size=1) as pool:
        ended = carried_out(pool, {"child": ("leaves a child",)})
    assert ended["child"].failure.detail == "the worker ended with status 7"


def test_a_worker_that_prints_without_end_fills_nothing(liars, carried_out):
    with WorkerPool(liars.act, size=1) as pool:
        printed = carried_out(pool, {"prints": ("prints",)})["prints"].result
        assert carried_out(pool, {"who": ("who",)})["who"].failure is None
    assert printed == 16 * 1024 * 1024


def test_processes_that_the_system_does_not_allow_are_done_without(doubles, carried_out, monkeypatch):
    pool = WorkerPool(doubles.act, size=3)
    with pool:
        carried_out(pool, {"one": ("who",)})

        def refused():
            raise OSError(errno.EMFILE, "Too many open files")

        monkeypatch.setattr("rgss.sweep.workers.WorkerOutput", refused)
        ended = carried_out(pool, {str(number): ("who",) for number in range(4)})
        assert len({each.result for each in ended.values()}) == 1
    with pytest.raises(SimulationError) as caught:
        pool.prepare_for(1)
    assert str(caught.value) == (
        "a worker process cannot start: Too many open files "
        "(see what else the machine is doing, or raise its limits ('ulimit -n', 'ulimit -u'))"
    )


def test_a_function_that_cannot_be_imported_is_refused_at_once():
    with pytest.raises((AttributeError, pickle.PicklingError), match="local object"):
        WorkerPool(lambda: None, size=1)


def test_a_pool_that_is_asked_for_nothing_starts_nothing(doubles):
    with WorkerPool(doubles.act, size=2) as pool:
        assert pool.wait(0.0) == []
        pool.prepare_for(0)
        assert pool.free == 0


def test_this_process_can_be_the_one_worker(doubles, carried_out):
    workers = InlineWorkers(doubles.act)
    ended = carried_out(workers, {name: (name,) for name in ("who", "fail", "refuse")})

    assert workers.size == 1
    assert ended["who"] == Ended(key="who", result=os.getpid(), failure=None, took_s=ended["who"].took_s)
    assert ended["fail"].failure == TaskError(
        kind=RunFailureKind.RAISED, detail="ZeroDivisionError: division by zero", may_pass=True
    )
    assert not ended["refuse"].failure.may_pass
    with contextlib.closing(workers):
        assert workers.free == 1
