"""Bit-exact serialisation of an execution."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import canonical_json
from rgss.evidence import read_json
from rgss.trials.phase_result import PhaseResult
from rgss.trials.pieces.plain_values import to_plain


@dataclass(frozen=True, slots=True, kw_only=True)
class _Execution:
    phases: tuple[PhaseResult, ...]


def execution_to_json(execution: tuple[PhaseResult, ...]) -> str:
    """Execution as canonical JSON.

    Args:
        execution: The phases that ran, in order.

    Raises:
        DefinitionError: A number is not finite.
    """
    return canonical_json(to_plain(_Execution(phases=execution)))


def execution_from_json(text: str) -> tuple[PhaseResult, ...]:
    """Execution from the output of `execution_to_json`.

    Raises:
        EvidenceError: The text is not valid.
    """
    return read_json(text, _Execution, "execution").phases
