"""Assumed numbers that would change the choice, for a terminal."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rgss.decision.robustness import AssumptionFinding, Part
from rgss.decision.study_decision import RobustnessFindings
from rgss.reports.decision.words import UNKNOWN, amount, kept_amount, kept_share, variants_text
from rgss.reports.plain_text import aligned_table

_ALL = "All assumed costs of components together"


def assumption_lines(found: RobustnessFindings) -> Iterator[str]:
    """The range of each assumed number, and of all costs together."""
    yield ""
    if found.is_missing(Part.ASSUMPTIONS):
        yield "Assumptions: not computed."
    if found.is_missing(Part.COSTS):
        yield f"{_ALL}: not computed."
    if found.decisive:
        titles = ["assumption", "is", "stays best from", "to", "below wins", "above wins"]
        yield from aligned_table(titles, [_row(found, one) for one in found.decisive], right=(1, 2, 3))
    if found.harmless:
        yield f"None of these alone changes the choice, however far it moves: {', '.join(found.harmless)}."
    if found.simulated:
        yield f"The trials were simulated with {', '.join(found.simulated)}; what they showed is held."
    yield from _costs(found)


def _row(found: RobustnessFindings, one: AssumptionFinding) -> list[str]:
    span, unit = one.range, one.number.unit
    cells = [one.number.id, amount(one.number.value, unit)]
    if span is None:
        return [*cells, *[UNKNOWN] * 4]
    about = "" if span.exact else "≈ "
    # If nothing changed up to the end of the scan, that end is not a bound of the range.
    low = amount(span.lowest, unit) if span.exact else f"≤ {amount(span.lowest, unit)}"
    high = "∞" if math.isinf(span.highest) else f"≥ {amount(span.highest, unit)}"
    return [
        *cells,
        low if span.low is None else about + kept_amount(span.low, unit, is_least=True),
        high if span.high is None else about + kept_amount(span.high, unit, is_least=False),
        UNKNOWN if span.low is None else variants_text(found.variants(span.below)),
        UNKNOWN if span.high is None else variants_text(found.variants(span.above)),
    ]


def _costs(found: RobustnessFindings) -> Iterator[str]:
    box = found.analysis.costs
    if box is None:
        return
    if box.range.factor is None:
        yield f"{_ALL} may be off by ±{100.0 * box.range.most:.0f} %, and the choice stays best."
        return
    winners = found.variants(box.range.overtaken_by)
    then = f"{variants_text(winners)} can win" if winners else "the choice can miss a threshold"
    unit = box.numbers[0].unit
    moved = [f"{component} at {amount(value, unit)}" for component, value in found.corner.items()]
    corner = f" (with {', '.join(moved)})" if moved else ""
    yield f"{_ALL} may be off by ±{kept_share(box.range.factor, 2)}; beyond that, {then}{corner}."
    if box.unmoved:
        yield f"(no percentage moves what is assumed to cost nothing: {', '.join(box.unmoved)})"
