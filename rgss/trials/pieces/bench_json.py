"""Bit-exact serialisation of the result of a payload bench."""

from __future__ import annotations

from rgss.documents import canonical_json
from rgss.errors import EvidenceError
from rgss.evidence import read_json
from rgss.trials.payload_bench import PayloadResult
from rgss.trials.pieces.plain_values import to_plain


def bench_to_json(result: PayloadResult) -> str:
    """Result of a bench as canonical JSON."""
    return canonical_json(to_plain(result))


def bench_from_json(text: str) -> PayloadResult:
    """Result of a bench from the output of `bench_to_json`.

    Raises:
        EvidenceError: The text is not valid.
    """
    result = read_json(text, PayloadResult, "bench")
    if len(result.bracket_kg) != 2:
        raise EvidenceError("the bracket of the bench must have two masses")
    return result
