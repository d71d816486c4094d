"""Workers of any kind, and what becomes of the troubled tasks of `doubles/task_doubles.py`."""

from __future__ import annotations

import time

import pytest

from rgss.evidence import RunFailureKind
from rgss.sweep.task_end import TaskError
from tests.fixtures.processes import PATIENCE_S


@pytest.fixture(scope="session")
def carried_out():
    """Carries out tasks on workers of any kind."""

    def carry_out(workers, tasks, *, patience_s=PATIENCE_S):
        """Carry out tasks by their keys; return how each ended."""
        left, ended = dict(tasks), {}
        end = time.monotonic() + patience_s
        while len(ended) < len(tasks):
            assert time.monotonic() < end, f"no end of {set(tasks) - set(ended)}"
            workers.prepare_for(len(tasks) - len(ended))
            while workers.free and left:
                key = next(iter(left))
                workers.begin(key, left.pop(key))
            for each in workers.wait(1.0):
                assert each.key not in ended
                ended[each.key] = each
        return ended

    return carry_out


@pytest.fixture(scope="session")
def troubles_of_tasks() -> dict[str, TaskError]:
    """What becomes of the troubled tasks of `task_doubles.act`, whoever carries them out within 5 s."""
    return {
        "die": TaskError(
            kind=RunFailureKind.CRASHED,
            detail="the worker was killed by SIGSEGV: free(): invalid next size",
            may_pass=True,
        ),
        "exit": TaskError(kind=RunFailureKind.CRASHED, detail="the worker ended with status 7", may_pass=True),
        "fail": TaskError(kind=RunFailureKind.RAISED, detail="ZeroDivisionError: division by zero", may_pass=True),
        "refuse": TaskError(
            kind=RunFailureKind.RAISED,
            detail="the mass of the workpiece must be positive, got 0 (give it some)",
            may_pass=False,
        ),
        "hang": TaskError(kind=RunFailureKind.TIMED_OUT, detail="not done after 5 s", may_pass=True),
    }
