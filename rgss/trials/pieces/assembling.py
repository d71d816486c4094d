"""Assembly of a trial's record from a plan under other limits and the stored pieces."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from rgss.evidence import Failure, Piece, PieceKind, TrialRecord
from rgss.trials.phase_result import PhaseResult
from rgss.trials.pieces.bench_json import bench_from_json
from rgss.trials.pieces.execution_json import execution_from_json
from rgss.trials.pieces.timing_json import timing_from_json
from rgss.trials.planning import TaskPlan
from rgss.trials.record import assemble_record
from rgss.trials.trial_spec import TrialSpec

_READ_KEPT = 512


def record_with_plan(spec: TrialSpec, plan: TaskPlan, pieces: Mapping[PieceKind, Piece]) -> TrialRecord:
    """Assemble the record of a trial from a plan and the other pieces.

    Args:
        spec: The trial.
        plan: Its plan, with the paths from which the pieces were made.
        pieces: Its timing, its execution and, if its fidelity has one, its bench.

    Raises:
        EvidenceError: A piece is damaged.
    """
    bench = pieces.get(PieceKind.BENCH)
    return assemble_record(
        spec,
        plan,
        _timing_failures(pieces[PieceKind.TIMING].text),
        _execution(pieces[PieceKind.EXECUTION].text),
        bench_payload_kg=None if bench is None else bench_from_json(bench.text).payload_kg,
    )


# One piece serves many trials, and all varied assumptions.
@lru_cache(maxsize=_READ_KEPT)
def _timing_failures(text: str) -> Mapping[str, tuple[Failure, str]]:
    return timing_from_json(text).failures


@lru_cache(maxsize=_READ_KEPT)
def _execution(text: str) -> tuple[PhaseResult, ...]:
    return execution_from_json(text)
