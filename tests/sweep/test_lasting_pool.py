"""The pool for several sweeps: its processes stay from one to the next, and none stays at the end."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from rgss.sweep.persistent_pool import PersistentWorkerPool
from tests.fixtures.processes import PATIENCE_S

DOUBLES = Path(__file__).parent / "doubles"
LIMITS = {"time_limit_s": PATIENCE_S, "memory_limit_bytes": 0}


@pytest.fixture
def doubles(monkeypatch):
    monkeypatch.syspath_prepend(DOUBLES)
    import task_doubles

    return task_doubles


def is_there(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_process_stays_from_one_sweep_to_the_next_and_ends_with_the_last(doubles, carried_out):
    pids = []
    with PersistentWorkerPool(size=1, **LIMITS) as lasting:
        for name in ("one", "two"):
            workers = lasting.workers(doubles.act)
            assert workers.size == 1
            pids.append(carried_out(workers, {name: ("who",)})[name].result)
            workers.close()
            assert is_there(pids[-1])

    assert pids[0] == pids[1]
    assert not is_there(pids[0])


def test_a_sweep_that_stops_in_the_middle_leaves_no_process_at_its_task(doubles, carried_out):
    with PersistentWorkerPool(size=1, **LIMITS) as lasting:
        workers = lasting.workers(doubles.act)
        pid = carried_out(workers, {"one": ("who",)})["one"].result
        workers.begin("two", ("hang",))
        workers.close()

        # The task has no end, so that closing has not waited for it.
        assert not is_there(pid)
        after = carried_out(lasting.workers(doubles.act), {"three": ("who",)})["three"]
        assert after.result not in {None, pid}


def test_another_function_has_another_process(doubles, carried_out):
    with PersistentWorkerPool(size=1, **LIMITS) as lasting:
        first = carried_out(lasting.workers(doubles.act), {"one": ("who",)})["one"].result
        other = carried_out(lasting.workers(os.getpid), {"two": ()})["two"].result

        assert other != first
        assert not is_there(first)
