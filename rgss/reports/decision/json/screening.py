"""Outcome of screening as plain values for JSON."""

from __future__ import annotations

from typing import Any

from rgss.decision import ScreeningResult


def screening_to_json(result: ScreeningResult) -> dict[str, Any]:
    """The rule, and the outcome of every design with its reason."""
    return {
        "fidelity": result.screening.fidelity.value,
        "promotion": str(result.screening.promotion),
        "survivors": list(result.survivors),
        "variants": [
            {
                "variant": one.variant,
                "fate": one.outcome.value,
                "reason": one.reason,
                "missed": list(one.missed),
                "best_value": one.best_value,
            }
            for one in result.variants
        ],
    }
