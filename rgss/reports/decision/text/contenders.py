"""Variants that nearly won, for a terminal."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rgss.decision.robustness import Part, WeightRobustness
from rgss.decision.study_decision import Contender, RobustnessFindings
from rgss.reports.decision.meanings import meanings
from rgss.reports.decision.words import UNKNOWN, ids_text, variants_text
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import share_in_words
from rgss.tradeoff.robustness import Acceptability, Support
from rgss.tradeoff.weights import Drawing

LEAST_SHOWN = 0.005
"""Least share of draws in which a shown variant is first; --json has the others."""

MOST_GROUPS = 10


def contender_lines(found: RobustnessFindings, *, tolerance: float) -> Iterator[str]:
    """The Pareto front, and the acceptability of the variants that come first for some weights.

    Args:
        found: The robustness of the decision.
        tolerance: Share of a threshold by which the choice may miss it.
    """
    yield _front(found)
    weighting = found.analysis.weighting
    if weighting is None:
        return
    if weighting.acceptability is None:
        yield "Acceptability and confidence: not computed."
        return
    groups = _groups(found.contenders)
    titles = ["variants", "Pareto", "weights", "first", "confidence", "feasible", "weight to move"]
    rows = [_row(group, with_noise=weighting.with_noise) for group in groups[:MOST_GROUPS]]
    yield from aligned_table(titles, rows, right=(2, 3, 4, 5, 6))
    yield from _legend(found, weighting, weighting.acceptability, tolerance=tolerance)
    if len(groups) > MOST_GROUPS:
        yield f"And {len(groups) - MOST_GROUPS} more that are first in some draws (--json has them)."


def _front(found: RobustnessFindings) -> str:
    if found.is_missing(Part.PARETO):
        return "Pareto front: not computed."
    analysis = found.analysis
    front = [point for point in analysis.front.points if point.support is not Support.DOMINATED]
    unsupported = [analysis.variants[one.row] for one in front if one.support is Support.UNSUPPORTED]
    none = f"; no weights choose {variants_text(unsupported)}." if unsupported else "; each is best for some weights."
    if len(front) == 1:
        none = " alone, the best at all weights."
    return f"Pareto front: {variants_text([analysis.variants[one.row] for one in front])}{none}"


def _groups(contenders: tuple[Contender, ...]) -> list[list[Contender]]:
    """Contenders that are shown, those that do not differ together, the most acceptable first."""
    groups: dict[tuple[object, ...], list[Contender]] = {}
    for one in contenders:
        if one.first >= LEAST_SHOWN or one.on_front:
            groups.setdefault((one.first, one.feasible, one.single_values), []).append(one)
    return list(groups.values())


def _row(members: list[Contender], *, with_noise: bool) -> list[str]:
    one = members[0]
    outside = UNKNOWN if one.feasible else "not feasible"
    return [
        ids_text(member.variant for member in members),
        outside if one.support is None else one.support.value.replace("_", " "),
        UNKNOWN if one.region is None else share_in_words(one.region),
        share_in_words(one.first),
        UNKNOWN if math.isnan(one.confidence) or not with_noise else share_in_words(one.confidence),
        share_in_words(one.feasible_share) if with_noise else UNKNOWN,
        UNKNOWN if one.weight_to_move is None else f"{one.weight_to_move:.3f}",
    ]


def _legend(
    found: RobustnessFindings, weighting: WeightRobustness, indices: Acceptability, *, tolerance: float
) -> Iterator[str]:
    bounded = "the elicited weights" if weighting.elicited else "all weights"
    noise = "and of the evidence" if weighting.with_noise else "alone (without noise)"
    error = max((one.first_error for one in found.contenders), default=0.0)
    shares = max((region.share_error for region in weighting.regions or ()), default=0.0)
    counted = f" (counted, with a standard error of up to {_points(shares)})" if shares else ""
    yield f"weights: share of {bounded} at which they are best by the evidence as it is{counted}"
    source = "over studies of this size" if weighting.with_noise else "by the number of draws"
    yield (
        f"first: share of {indices.iterations:,} draws of {bounded} {noise} in which none is better "
        f"(standard error {source}: up to {_points(max(error, 1e-4))})"
    )
    if indices.drawn_by is Drawing.HIT_AND_RUN:
        yield "(weights are drawn by random walks, hit-and-run: uniform up to an error that is tested, not proven)"
    if weighting.with_noise:
        yield "confidence: probability that they are best at their own typical weights"
        within = " within the tolerance of the choice" if tolerance else ""
        draws = found.analysis.draws
        yield f"feasible: probability that they meet every requirement{within}, by {draws:,} posterior draws"
    yield from (
        "In other words,",
        *(f"  {meaning}" for meaning in meanings(with_noise=weighting.with_noise)),
    )


def _points(share: float) -> str:
    """A difference of shares, which are printed in per cent."""
    return f"{100.0 * share:.2g} percentage points"
