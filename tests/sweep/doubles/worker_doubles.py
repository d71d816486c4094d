"""What workers are given to do in tests instead of simulations: quick pieces, and every way to fail.

Workers import these functions by their name, so this folder must be on their path.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from pathlib import Path

import numpy as np

from rgss.errors import SimulationError
from rgss.evidence import Piece, PieceKind, PlanOutcome, TrialRecord
from rgss.motion import PlanningClock
from rgss.trials.payload_bench.bench import PayloadResult
from rgss.trials.payload_bench.rig import PayloadLimit
from rgss.trials.pieces.bench_json import bench_to_json
from rgss.trials.pieces.execution_json import execution_to_json
from rgss.trials.pieces.input_digests import TrialDigests
from rgss.trials.pieces.pieces import Task, TrialTask, make_piece, record_of, tasks_of
from rgss.trials.pieces.plan_json import plan_to_json
from rgss.trials.pieces.timing_json import timing_to_json
from rgss.trials.planning import PlannedMove, TaskPlan
from rgss.trials.timing import TaskTiming
from tests.fixtures.eight_states import Phase

FOLDER = "WORKER_DOUBLES_FOLDER"
"""Names the folder in which workers leave their marks."""

MIB = 1024 * 1024


def quick(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Pieces of a trial whose planner finds nothing in the time that it has."""
    if isinstance(task, TrialTask):
        bench = "d" * 64 if task.spec.fidelity.value == "contact" else ""
        digests = TrialDigests(plan="a" * 64, timing="b" * 64, execution="c" * 64, bench=bench, trial="e" * 64)
        return record_of(
            task.spec, {each.kind: quick(each, dict.fromkeys(each.needs)) for each in tasks_of(task.spec, digests)}
        )
    assert {*needed} == {*task.needs}
    limit_s = task.spec.settings.planning.search_limit_s
    clock = PlanningClock(charge_s=0.001)
    move = PlannedMove(
        phase=Phase.MOVE_TO_GRASP,
        outcome=PlanOutcome.BUDGET_SPENT,
        checks=clock.checks_within(limit_s),
        simplification_checks=0,
        search_time_s=limit_s,
        time_s=limit_s,
        path_rad=None,
        path_length_m=None,
    )
    text = {
        PieceKind.PLAN: lambda: plan_to_json(TaskPlan(moves={move.phase: move}, direct={}, clock=clock)),
        PieceKind.TIMING: lambda: timing_to_json(TaskTiming(trajectories={}, failures={}, qualities={})),
        PieceKind.EXECUTION: lambda: execution_to_json(()),
        PieceKind.BENCH: lambda: bench_to_json(
            PayloadResult(
                payload_kg=1.0,
                limited_by=PayloadLimit.RATED,
                bracket_kg=(1.0, 1.0),
                theory_kg=1.0,
                eq_4_8_kg=1.0,
                probes=(),
            )
        ),
    }[task.kind]()
    return Piece(digest=task.digest, kind=task.kind, text=text)


def is_first_time(name: str) -> bool:
    """Tell whether this is asked for the first time, by whatever process."""
    try:
        (Path(os.environ[FOLDER]) / name).touch(exist_ok=False)
    except FileExistsError:
        return False
    return True


def troubled(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Every seed has its own failure with its plan, and seed 7 with its execution."""
    kind = "trial" if isinstance(task, TrialTask) else task.kind.value
    failure = {
        ("plan", 2): die_of_segmentation,
        ("plan", 3): hang,
        ("plan", 4): allocate_without_end,
        ("plan", 5): refuse,
        ("plan", 6): lambda: is_first_time("six") and os.kill(os.getpid(), signal.SIGKILL),
        ("execution", 7): fail,
    }.get((kind, task.spec.seed))
    if failure is not None:
        failure()
    return quick(task, needed)


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
    from rgss.motion.parametrization import RateConstraints, fastest_rates

    grid, ones = np.linspace(0.0, 1.0, 11), np.ones((11, 1))
    limits = RateConstraints(first=ones, second=0.0 * ones, rows=np.array([[1.0], [-1.0]]), bounds=np.ones(2))
    assert fastest_rates(grid, np.full(11, 4.0), [limits]) is not None
    hang()


def refuse() -> None:
    """Raise an error of ours, which another attempt would raise again."""
    raise SimulationError("the mass of the workpiece must be positive, got 0", hint="give it some")


def fail() -> None:
    """Raise an error of somebody else's."""
    raise ZeroDivisionError("division\nby zero")


def changed_result(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """Another bench than `quick` gives."""
    made = quick(task, needed)
    if isinstance(made, Piece) and made.kind is PieceKind.BENCH:
        return Piece(digest=made.digest, kind=made.kind, text=made.text.replace("1.0", "2.0"))
    return made


def noted(task: Task, needed: dict[str, Piece]) -> Piece | TrialRecord:
    """A real piece whose making leaves a mark."""
    (Path(os.environ[FOLDER]) / f"{task.kind.value}-{task.digest}").touch(exist_ok=False)
    return make_piece(task, needed)


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
        "time_and_hang": time_and_hang,
        "fail": fail,
        "refuse": refuse,
        "allocate": allocate_without_end,
        "die": die_of_segmentation,
        "memory_limit": memory_limit,
        "exit": lambda: os._exit(7),
        "threads": lambda: os.environ["OMP_NUM_THREADS"],
        "interrupted": lambda: signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ()),
    }[name]()
