"""What workers are given to do in tests instead of pieces: every way to end, and to say what they are.

Workers import these functions by their name, so this folder must be on their path. Nothing heavy is imported here:
what these tests are about is the end of a task, of which many cost a worker, and not what workers load.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from pathlib import Path

from rgss.errors import SimulationError

FOLDER = "WORKER_DOUBLES_FOLDER"
"""Names the folder in which workers leave their marks."""

MIB = 1024 * 1024


def is_first_time(name: str) -> bool:
    """Tell whether this is asked for the first time, by whatever process."""
    try:
        (Path(os.environ[FOLDER]) / name).touch(exist_ok=False)
    except FileExistsError:
        return False
    return True


def die_of_segmentation() -> None:
    """Say something and end like a program that reads where it must not."""
    sys.stderr.write("free(): invalid next size\n")
    sys.stderr.flush()
    os.kill(os.getpid(), signal.SIGSEGV)


def hang() -> None:
    """Leave a mark, where marks are left, and never come back."""
    if FOLDER in os.environ:
        (Path(os.environ[FOLDER]) / f"hanging-{os.getpid()}").touch()
    threading.Event().wait()


def allocate_without_end() -> None:
    """Take all memory that there is."""
    taken = []
    while True:
        taken.append(bytearray(64 * MIB))


def time_and_hang() -> None:
    """Time a motion as a piece does, with an engine that could draw it, and never come back."""
    import numpy as np

    from rgss.motion.parametrization import RateConstraints, fastest_rates

    grid, ones = np.linspace(0.0, 1.0, 11), np.ones((11, 1))
    limits = RateConstraints(first=ones, second=0.0 * ones, rows=np.array([[1.0], [-1.0]]), bounds=np.ones(2))
    assert fastest_rates(grid, np.full(11, 4.0), [limits]) is not None
    hang()


def hang_with_a_file() -> None:
    """Never come back while a file is in a temporary folder, as the physics engine's is while it reads it."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "robot.urdf").touch()
        hang()


def refuse() -> None:
    """Raise an error of ours, which another attempt would raise again."""
    raise SimulationError("the mass of the workpiece must be positive, got 0", hint="give it some")


def fail() -> None:
    """Raise an error of somebody else's."""
    raise ZeroDivisionError("division\nby zero")


def who() -> int:
    """The process that answers."""
    return os.getpid()


def memory_limit() -> int:
    """The limit under which a worker stands."""
    import resource

    return resource.getrlimit(resource.RLIMIT_DATA)[0]


def act(name: str) -> object:
    """Do what a name says; the name is one of this module's functions."""
    return {
        "who": who,
        "hang": hang,
        "hang_with_a_file": hang_with_a_file,
        "time_and_hang": time_and_hang,
        "fail": fail,
        "refuse": refuse,
        "allocate": allocate_without_end,
        "die": die_of_segmentation,
        "memory_limit": memory_limit,
        "exit": lambda: os._exit(7),
        "threads": lambda: os.environ["OMP_NUM_THREADS"],
        "interrupted": lambda: (
            {signal.SIGINT, signal.SIGTERM, signal.SIGHUP} <= signal.pthread_sigmask(signal.SIG_BLOCK, ())
        ),
    }[name]()
