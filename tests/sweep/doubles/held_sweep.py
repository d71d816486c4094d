"""The command line with workers that stop at a known point, for tests that interrupt or kill a sweep.

``held_sweep.py FOLDER TASKS PIECES VERB …`` runs a verb of rgss whose workers carry out that many tasks
between them. Each worker that is given one more leaves a mark in the folder and waits there, until
the test opens the gate or ends it. The pieces are ``real``, or ``quick`` doubles where it is not the engines
that a test is about. Workers import this script too, since it is the main module of the process that starts them.
"""

from __future__ import annotations

import contextlib
import itertools
import os
import sys
from pathlib import Path

import rgss.sweep.running as sweep_module
from rgss.cli.main import main
from rgss.evidence import Piece, TrialRecord
from rgss.trials.pieces.pieces import Task

# The doubles use what the tests share.
sys.path.append(str(Path(__file__).resolve().parents[3]))

FOLDER, TASKS, PIECES = Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
GATE = "gate"


def held_make(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Make a piece if it is among the first; otherwise wait for the gate to be opened."""
    if not take_turn():
        (FOLDER / f"held-{os.getpid()}").touch()
        # Opening a named pipe waits for the other end.
        (FOLDER / GATE).read_bytes()
    if PIECES == "quick":
        from worker_doubles import quick

        return quick(task, needed)
    from rgss.trials.pieces.run import make

    return make(task, needed)


def take_turn() -> bool:
    """Claim the next number below the number of tasks; False if all are taken."""
    for number in itertools.islice(itertools.count(), TASKS):
        with contextlib.suppress(FileExistsError):
            (FOLDER / f"turn-{number}").touch(exist_ok=False)
            return True
    return False


if __name__ == "__main__":
    sweep_module.sweep.__kwdefaults__["maker"] = held_make
    sys.exit(main(sys.argv[4:]))
