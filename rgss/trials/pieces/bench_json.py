"""Serialisation of the result of a payload bench, exact to the bit."""

from __future__ import annotations

from rgss.documents import canonical_json
from rgss.errors import EvidenceError
from rgss.evidence import read_json
from rgss.trials.payload_bench import PayloadResult
from rgss.trials.pieces.plain_values import to_plain


def bench_to_json(result: PayloadResult) -> str:
    """Write the result of a bench as canonical JSON.

    Args:
        result: The result.
    """
    return canonical_json(to_plain(result))


def bench_from_json(text: str) -> PayloadResult:
    """Read the result of a bench that `bench_to_json` wrote.

    Args:
        text: The text.

    Raises:
        EvidenceError: It is no such text.
    """
    result = read_json(text, PayloadResult, "bench")
    if len(result.bracket_kg) != 2:
        raise EvidenceError("the bench has no bracket of two masses")
    return result
