"""Serialisation of an execution, exact to the bit."""

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
    """Write an execution as canonical JSON.

    Args:
        execution: The phases that ran, in order.

    Raises:
        DefinitionError: A number is not finite.
    """
    return canonical_json(to_plain(_Execution(phases=execution)))


def execution_from_json(text: str) -> tuple[PhaseResult, ...]:
    """Read an execution that `execution_to_json` wrote.

    Args:
        text: The text.

    Raises:
        EvidenceError: It is no such text.
    """
    return read_json(text, _Execution, "execution").phases
