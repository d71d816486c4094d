"""Bit-exact serialisation of a plan."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import canonical_json
from rgss.errors import EvidenceError
from rgss.evidence import PlanOutcome, read_json
from rgss.motion import PlanningClock
from rgss.trials.pieces.float_array import Array, FloatArray
from rgss.trials.pieces.plain_values import to_plain
from rgss.trials.planning import PlannedMove, TaskPlan

_LARGEST_ARM = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class _Move:
    phase: str
    outcome: PlanOutcome
    checks: int
    simplification_checks: int
    search_time_s: float
    time_s: float
    path_rad: FloatArray | None
    path_length_m: float | None
    detail: str
    verification_checks: int
    repairs: int
    simplification_unlimited_from: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Direct:
    phase: str
    path_rad: FloatArray | None


@dataclass(frozen=True, slots=True, kw_only=True)
class _Plan:
    moves: tuple[_Move, ...]
    direct: tuple[_Direct, ...]
    clock: PlanningClock


def plan_to_json(plan: TaskPlan) -> str:
    """Plan as canonical JSON."""
    moves = tuple(
        _Move(
            phase=move.phase,
            outcome=move.outcome,
            checks=move.checks,
            simplification_checks=move.simplification_checks,
            search_time_s=move.search_time_s,
            time_s=move.time_s,
            path_rad=None if move.path_rad is None else FloatArray.of(move.path_rad),
            path_length_m=move.path_length_m,
            detail=move.detail,
            verification_checks=move.verification_checks,
            repairs=move.repairs,
            simplification_unlimited_from=move.simplification_unlimited_from,
        )
        for move in plan.moves.values()
    )
    direct = tuple(
        _Direct(phase=phase, path_rad=None if path is None else FloatArray.of(path))
        for phase, path in plan.direct.items()
    )
    return canonical_json(to_plain(_Plan(moves=moves, direct=direct, clock=plan.clock)))


def plan_from_json(text: str) -> TaskPlan:
    """Plan from the output of `plan_to_json`.

    Raises:
        EvidenceError: The text is not valid.
    """
    read = read_json(text, _Plan, "plan")
    moves = {
        move.phase: PlannedMove(
            phase=move.phase,
            outcome=move.outcome,
            checks=move.checks,
            simplification_checks=move.simplification_checks,
            search_time_s=move.search_time_s,
            time_s=move.time_s,
            path_rad=_path(move.path_rad),
            path_length_m=move.path_length_m,
            detail=move.detail,
            verification_checks=move.verification_checks,
            repairs=move.repairs,
            simplification_unlimited_from=move.simplification_unlimited_from,
        )
        for move in read.moves
    }
    direct = {move.phase: _path(move.path_rad) for move in read.direct}
    if len(moves) != len(read.moves) or len(direct) != len(read.direct) or not moves.keys().isdisjoint(direct):
        raise EvidenceError("the plan has two moves of one phase")
    if any((move.path_rad is not None) != (move.outcome is PlanOutcome.SOLVED) for move in moves.values()):
        raise EvidenceError("each move of the plan must have a path if and only if it is solved")
    return TaskPlan(moves=moves, direct=direct, clock=read.clock)


def _path(kept: FloatArray | None) -> Array | None:
    if kept is None:
        return None
    if len(kept.shape) != 2 or not (kept.shape[0] >= 1 and 1 <= kept.shape[1] <= _LARGEST_ARM):
        raise EvidenceError(f"a path cannot have the shape {kept.shape}")
    return kept.array()
