"""What engine processes beside Dask workers are given to do in tests."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path
from typing import TYPE_CHECKING

import task_doubles

if TYPE_CHECKING:
    from rgss.evidence import Piece, TrialRecord
    from rgss.trials.pieces.pieces import Task

LONGEST_WAIT_S = 300.0
"""So that a broken meeting ends a test instead of keeping the whole run."""


def act(name: str, mine: str = "") -> object:
    """Do what a name says."""
    if name == "meet":
        return meet(mine)
    if name == "rob":
        return rob()
    if name == "parent":
        return os.getppid()
    return task_doubles.act(name)


def meet(mine: str) -> int:
    """Leave a mark and wait until there is another; returns the process."""
    folder = Path(os.environ[task_doubles.FOLDER]) / "meeting"
    folder.mkdir(exist_ok=True)
    (folder / mine).touch()
    end = time.monotonic() + LONGEST_WAIT_S
    while len(list(folder.iterdir())) < 2:
        if time.monotonic() > end:
            raise TimeoutError(f"nobody else came to {folder}")
        time.sleep(0.01)
    return os.getpid()


def rob() -> None:
    """Kill the Dask worker that this engine process belongs to."""
    os.kill(os.getppid(), signal.SIGKILL)
    task_doubles.hang()


def robbed(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Quick pieces, but the first one to be made costs a Dask worker."""
    if task_doubles.is_first_time("robbed"):
        rob()
    import worker_doubles

    return worker_doubles.quick(task, needed)
