"""The pool of workers: what becomes of a task that ends well, badly or never."""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import time
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.evidence import RunFailureKind
from rgss.studies.inline_workers import InlineWorkers
from rgss.studies.workers import Ended, Trouble, WorkerPool

DOUBLES = Path(__file__).parent / "doubles"
GIB = 1024**3


@pytest.fixture
def doubles(monkeypatch):
    monkeypatch.syspath_prepend(DOUBLES)
    import worker_doubles

    return worker_doubles


def test_one_pool_goes_on_whatever_becomes_of_its_tasks(doubles, carried_out, troubles_of_tasks):
    names = ["who", "die", "memory_limit", "exit", "fail", "refuse", "allocate", "hang", "threads", "interrupted"]
    with WorkerPool(doubles.act, size=2, time_limit_s=5.0, memory_limit_bytes=1 * GIB) as pool:
        assert (pool.size, pool.free) == (2, 0)
        ended = carried_out(pool, {name: (name,) for name in names})
        again = carried_out(pool, {"again": ("who",)})

    assert ended["who"].trouble is None
    assert ended["who"].result != os.getpid()
    assert ended["who"].took_s >= 0.0
    assert again["again"].result is not None
    assert ended["memory_limit"].result == GIB
    assert ended["threads"].result == "1"
    assert ended["interrupted"].result is True
    troubles = {name: each.trouble for name, each in ended.items() if each.trouble is not None}
    assert troubles == {
        **troubles_of_tasks,
        "allocate": Trouble(kind=RunFailureKind.OUT_OF_MEMORY, detail="MemoryError", may_pass=True),
    }


def test_a_worker_keeps_what_it_has_loaded_for_the_next_task(doubles, carried_out):
    with WorkerPool(doubles.act, size=1) as pool:
        first = carried_out(pool, {"one": ("who",), "two": ("who",)})
        pid = first["one"].result
        os.kill(pid, signal.SIGKILL)
        after = carried_out(pool, {"three": ("who",)})

    assert first["two"].result == pid
    # Killed while it had nothing to do, or just as it was given something: told once, and never as another's.
    trouble = after["three"].trouble
    assert trouble is None or trouble.detail == "the worker was killed by SIGKILL"


def test_no_more_processes_are_started_than_there_are_tasks(doubles, carried_out):
    with WorkerPool(doubles.act, size=8) as pool:
        carried_out(pool, {"one": ("who",)})
        assert pool.free == 1
        pool.want(0)
        assert pool.free == 1


def test_closing_stops_at_once_and_leaves_no_process(doubles, tmp_path, carried_out):
    with WorkerPool(doubles.act, size=1) as pool:
        pid = carried_out(pool, {"who": ("who",)})["who"].result
        pool.begin("hang", ("hang",))
        begun = time.monotonic()
    assert time.monotonic() - begun < 1.0
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    pool.close()


def test_a_worker_that_cannot_start_is_an_error(doubles):
    with WorkerPool(doubles.act, size=1, memory_limit_bytes=1024) as pool:
        pool.want(1)
        with pytest.raises(SimulationError, match=r"^a worker process cannot start: .* \(is its memory limit too low"):
            pool.wait(60.0)


def test_a_function_that_cannot_be_imported_is_refused_at_once():
    with pytest.raises((AttributeError, pickle.PicklingError), match="local object"):
        WorkerPool(lambda: None, size=1)


def test_a_pool_that_is_asked_for_nothing_starts_nothing(doubles):
    with WorkerPool(doubles.act, size=2) as pool:
        assert pool.wait(0.0) == []
        pool.want(0)
        assert pool.free == 0


def test_this_process_can_be_the_one_worker(doubles, carried_out):
    workers = InlineWorkers(doubles.act)
    ended = carried_out(workers, {name: (name,) for name in ("who", "fail", "refuse")})

    assert workers.size == 1
    assert ended["who"] == Ended(key="who", result=os.getpid(), trouble=None, took_s=ended["who"].took_s)
    assert ended["fail"].trouble == Trouble(
        kind=RunFailureKind.RAISED, detail="ZeroDivisionError: division by zero", may_pass=True
    )
    assert not ended["refuse"].trouble.may_pass
    with contextlib.closing(workers):
        assert workers.free == 1
