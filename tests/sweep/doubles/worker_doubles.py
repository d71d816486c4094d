"""What workers make in tests instead of simulations: quick pieces, and pieces that cost a worker.

Workers import these functions by their name, so this folder must be on their path.
"""

from __future__ import annotations

import os
import signal
from pathlib import Path

from task_doubles import FOLDER, allocate_without_end, die_of_segmentation, fail, hang, is_first_time, refuse

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
