"""Outcome of screening for a terminal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.decision import ScreenedVariant, ScreeningResult


def screening_lines(result: ScreeningResult) -> list[str]:
    """Number of promoted designs, and the reason for each other one."""
    screening = result.screening
    rule = f"Screening at {screening.fidelity.value} fidelity ({screening.promotion})"
    lines = [f"{rule}: {len(result.survivors)} of {len(result.variants)} designs go on"]
    for reason, variants in _by_reason(result.screened_out).items():
        lines.append(f"  screened out: {', '.join(map(str, variants))}: {reason}")
    kept = [one for one in result.variants if one.goes_on and one.outcome.value != "promoted"]
    for reason, variants in _by_reason(kept).items():
        lines.append(f"  goes on all the same: {', '.join(map(str, variants))}: {reason}")
    return lines


def reopened_lines(variants: Sequence[int]) -> list[str]:
    """Designs that were screened out and would go on under suppositions; no line if there are none."""
    if not variants:
        return []
    ids = ", ".join(map(str, variants))
    text = f"  would go on under these suppositions, and is in no comparison above: {ids}"
    return [f"{text} (make that change in the study's file and run 'rgss sweep')"]


def _by_reason(variants: Sequence[ScreenedVariant]) -> Mapping[str, list[int]]:
    found: dict[str, list[int]] = {}
    for one in variants:
        found.setdefault(one.reason, []).append(one.variant)
    return found
