"""What screening did, in words and as JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.decision import ScreenedVariant, ScreeningResult


def screening_lines(result: ScreeningResult) -> list[str]:
    """How many designs go on, and each that does not with the reason."""
    screening = result.screening
    rule = f"Screening at {screening.fidelity.value} fidelity ({screening.promotion})"
    lines = [f"{rule}: {len(result.survivors)} of {len(result.variants)} designs go on"]
    for reason, variants in _by_reason(result.screened_out).items():
        lines.append(f"  screened out: {', '.join(map(str, variants))}: {reason}")
    kept = [one for one in result.variants if one.goes_on and one.fate.value != "promoted"]
    for reason, variants in _by_reason(kept).items():
        lines.append(f"  goes on all the same: {', '.join(map(str, variants))}: {reason}")
    return lines


def reopened_lines(variants: Sequence[int]) -> list[str]:
    """That suppositions would let designs go on which were screened out; nothing if they would not."""
    if not variants:
        return []
    ids = ", ".join(map(str, variants))
    told = f"  would go on under these suppositions, and is in no comparison above: {ids}"
    return [f"{told} (change the study's file so, and run 'rgss sweep')"]


def screening_as_json(result: ScreeningResult) -> dict[str, Any]:
    """The rule, and every design with what became of it and why."""
    return {
        "fidelity": result.screening.fidelity.value,
        "promotion": str(result.screening.promotion),
        "survivors": list(result.survivors),
        "variants": [
            {
                "variant": one.variant,
                "fate": one.fate.value,
                "reason": one.reason,
                "missed": list(one.missed),
                "best_value": one.best_value,
            }
            for one in result.variants
        ],
    }


def _by_reason(variants: Sequence[ScreenedVariant]) -> Mapping[str, list[int]]:
    found: dict[str, list[int]] = {}
    for one in variants:
        found.setdefault(one.reason, []).append(one.variant)
    return found
