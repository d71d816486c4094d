"""The second half of the trade-off's page: what nearly won, and what would change the decision."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rgss.cli.trade.words import amount, ids_text, moves_text, percent, variants_text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.decision.robustness import AssumptionFinding, Robustness, WeightRobustness
    from rgss.studies import Project
    from rgss.tradeoff import Decision

LEAST_SHOWN = 0.005
"""Alternatives that are first in a smaller share of the draws are left to --json."""

MOST_GROUPS = 10


def print_robustness(project: Project, decision: Decision, found: Robustness) -> None:
    """Show what nearly won and what would change the decision."""
    from rgss.decision.robustness import Part, not_computed_lines

    missing = found.not_computed
    if decision.chosen is None:
        print("".join(f"\n{line}" for line in not_computed_lines(missing)), end="\n" if missing else "")
        return
    print("\nWhat nearly won")
    _print_contenders(decision, found)
    print("\nWhat would change it")
    if found.weighting is not None:
        _print_weights(found, found.weighting)
    _print_prices(decision, found)
    if found.weighting is not None:
        _print_assumptions(found)
    _print_reversals(found)
    for name, reason in found.refused.items():
        print(f"Not analysed: {name}: {reason}.")
    for line in not_computed_lines(missing):
        print(line)
    if Part.EFFECTS in missing:
        return
    part = "explains alone" if project.designs.sample is not None else "takes part in"
    print(f"\nWhat drives the measures (share of the differences between designs that a factor {part})")
    _print_drivers(project, found)


def _print_contenders(decision: Decision, found: Robustness) -> None:
    from rgss.cli.output import print_table
    from rgss.decision.robustness import Part
    from rgss.tradeoff.robustness import Support
    from rgss.tradeoff.weights import Drawing

    front = [point for point in found.front.points if point.support is not Support.DOMINATED]
    unsupported = [found.variants[one.row] for one in front if one.support is Support.UNSUPPORTED]
    if Part.PARETO in found.not_computed:
        print("Pareto front: not computed.")
    else:
        none = (
            f"; no weights choose {variants_text(unsupported)}." if unsupported else "; each is best for some weights."
        )
        print(f"Pareto front: {variants_text([found.variants[one.row] for one in front])}{none}")
    weighting = found.weighting
    if weighting is None:
        return
    if weighting.acceptability is None:
        print("Acceptability and confidence: not computed.")
        return
    indices = weighting.acceptability
    places = {point.row: point.support.value.replace("_", " ") for point in found.front.points}
    shifts = {row: shift for shift in weighting.shifts or () for row in shift.rows}
    rows = []
    groups = _groups(found, indices.first)
    for members in groups[:MOST_GROUPS]:
        row = members[0]
        region = None if weighting.regions is None else weighting.regions[row]
        shift = shifts.get(row)
        chance = indices.confidence[row]
        rows.append(
            [
                ids_text(found.variants[member] for member in members),
                places.get(row, "–" if found.feasible[row] else "not feasible"),
                "–" if region is None else percent(region.share),
                percent(float(indices.first[row])),
                "–" if math.isnan(chance) else percent(float(chance)),
                percent(float(1.0 - indices.unranked[row])),
                "–" if shift is None else f"{shift.sum_distance / 2.0:.3f}",
            ]
        )
    titles = ["variants", "Pareto", "weights", "first", "confidence", "feasible", "weight to move"]
    print_table(titles, rows, right=(2, 3, 4, 5, 6))
    bounded = "the elicited weights" if weighting.elicited else "all weights"
    noise = (
        f"and {'all ' if found.all_resamples else ''}{found.resamples} resamples of the replicates"
        if weighting.with_noise
        else "alone, for the replicates tell nothing of noise"
    )
    error = max(float(indices.rank_errors[:, 0].max()), 1e-4)
    shares = max((region.share_error for region in weighting.regions or ()), default=0.0)
    counted = f" (counted, ± {shares:.2g})" if shares else ""
    print(f"weights: share of {bounded} at which they are best by the evidence as it is{counted}")
    print(f"first: share of {indices.iterations:,} draws of {bounded} {noise} in which none is better (± {error:.2g})")
    if indices.drawn_by is Drawing.HIT_AND_RUN:
        print("(weights are drawn by random walks, hit-and-run: uniform up to an error that is tested, not proven)")
    print("confidence: probability that they are best at their own typical weights; feasible: in how many draws")
    if decision.chosen is not None and len(groups) > MOST_GROUPS:
        print(f"And {len(groups) - MOST_GROUPS} more that are first in some draws (--json has them).")


def _groups(found: Robustness, first: NDArray[np.float64]) -> list[list[int]]:
    """The rows that are ever first or on the front, together where they are alike, the most acceptable first."""
    from rgss.tradeoff.robustness import Support

    shown = {row for row in range(len(found.variants)) if first[row] >= LEAST_SHOWN}
    shown |= {point.row for point in found.front.points if point.support is not Support.DOMINATED}
    groups: dict[tuple[object, ...], list[int]] = {}
    for row in sorted(shown):
        alike = (float(first[row]), bool(found.feasible[row]), *(round(value, 12) for value in found.values[row]))
        groups.setdefault(alike, []).append(row)
    return sorted(groups.values(), key=lambda members: (-float(first[members[0]]), members))


def _print_weights(found: Robustness, weighting: WeightRobustness) -> None:
    from rgss.cli.output import print_table

    before = dict(zip(found.measures, found.weights.tolist(), strict=True))
    others = [shift for shift in (weighting.shifts or ())[1:] if shift.distance > 0.0]
    if weighting.shifts is None:
        print("Weights: the nearest that change the choice were not computed.")
    elif others:
        nearest = min(others, key=lambda shift: (shift.sum_distance, shift.rows))
        after = dict(zip(found.measures, nearest.nearest_in_sum.tolist(), strict=True))
        winners = variants_text([found.variants[row] for row in nearest.rows])
        moved = f"moving {nearest.sum_distance / 2.0:.3f} of weight"
        print(f"Weights: {moved} lets {winners} win: {moves_text(before, after)}.")
    else:
        print(f"Weights: no other variant wins for any {'elicited ' if weighting.elicited else ''}weights.")
    if weighting.ranges is None:
        print("Range of each weight: not computed.")
        return
    rows = []
    for measure, one in zip(found.measures, weighting.ranges, strict=True):
        below = variants_text([found.variants[row] for row in one.below]) if one.below else "–"
        above = variants_text([found.variants[row] for row in one.above]) if one.above else "–"
        rows.append([measure, f"{before[measure]:.3g}", f"{one.low:.3f}", f"{one.high:.3f}", below, above])
    print_table(["weight", "is", "stays best from", "to", "below wins", "above wins"], rows, right=(1, 2, 3))
    print("(one weight moves, the others keep their proportions)")


def _print_prices(decision: Decision, found: Robustness) -> None:
    """What each requirement costs: the next change of the choice on either side of its limit."""
    from rgss.cli.output import print_table
    from rgss.decision.robustness import Part
    from rgss.tradeoff.problem import Comparison
    from rgss.tradeoff.robustness import changes_of_best, step_at

    values = {ranked.variant: ranked.value for ranked in decision.ranking}
    now = values.get(decision.chosen or 0) or 0.0
    rows = []
    for price in found.prices:
        condition = price.condition
        at_least = condition.sense is Comparison.AT_LEAST
        steps = changes_of_best(price.steps)
        # A quantity that equals the limit up to one part in 10⁹ meets it.
        slack = 1e-9 * max(1.0, abs(condition.limit))
        here = step_at(steps, condition.limit - slack if at_least else condition.limit + slack, at_least=at_least)
        place = steps.index(here)
        looser = "–"
        if place > 0:
            other = steps[place - 1]
            looser = (
                f"{amount(other.tightest, condition.limit_unit)}: "
                f"{variants_text([found.variants[row] for row in other.best])} ({(other.value or 0.0) - now:+.4f})"
            )
        tighter = "–"
        if place + 1 < len(steps):
            other = steps[place + 1]
            wins = variants_text([found.variants[row] for row in other.best])
            gain = "" if other.value is None else f" ({other.value - now:+.4f})"
            bound = ">" if at_least else "<"
            tighter = f"{bound} {amount(here.tightest, condition.limit_unit)}: {wins}{gain}"
        rows.append([condition.requirement, condition.demand, looser, tighter])
    if Part.PRICES in found.not_computed:
        print("\nPrice of each requirement: not computed.")
    if rows:
        print()
        print_table(["threshold", "asks for", "loosened to", "tightened to"], rows)
        print("(which variant would then win, and what its value gains or loses)")


def _print_assumptions(found: Robustness) -> None:
    from rgss.cli.output import print_table
    from rgss.decision.robustness import Part

    print()
    if Part.ASSUMPTIONS in found.not_computed:
        print("Assumptions: not computed.")
    if Part.COSTS in found.not_computed:
        print("All assumed costs together: not computed.")
    decisive = [one for one in found.assumptions if one.range is not None and not one.range.always]
    rows = [
        [
            one.number.id,
            amount(one.number.value, one.number.unit),
            *_ends(one),
            variants_text([found.variants[row] for row in one.range.below]) if _has(one, low=True) else "–",
            variants_text([found.variants[row] for row in one.range.above]) if _has(one, low=False) else "–",
        ]
        for one in decisive
        if one.range is not None
    ]
    if rows:
        titles = ["assumption", "is", "stays best from", "to", "below wins", "above wins"]
        print_table(titles, rows, right=(1, 2, 3))
    harmless = [one.number.id for one in found.assumptions if one.range is not None and one.range.always]
    if harmless:
        print(f"Alone, none of these changes the choice, however far it is followed: {', '.join(harmless)}.")
    simulated = [one.number.id for one in found.assumptions if one.simulated and one.columns]
    if simulated:
        print(f"The trials were simulated with {', '.join(simulated)}; what they showed is held.")
    _print_costs(found)


def _has(one: AssumptionFinding, *, low: bool) -> bool:
    return one.range is not None and (one.range.low if low else one.range.high) is not None


def _ends(one: AssumptionFinding) -> tuple[str, str]:
    span, unit = one.range, one.number.unit
    if span is None:
        return "–", "–"
    about = "" if span.exact else "≈ "
    # Where nothing changed as far as a scan went, the end of the scan is no end of the range.
    low = f"≤ {amount(span.lowest, unit)}" if not span.exact else amount(span.lowest, unit)
    high = "∞" if math.isinf(span.highest) else f"≥ {amount(span.highest, unit)}"
    return (
        low if span.low is None else about + amount(span.low, unit),
        high if span.high is None else about + amount(span.high, unit),
    )


def _print_costs(found: Robustness) -> None:
    box = found.costs
    if box is None:
        return
    if box.range.factor is None:
        print(f"All assumed costs together may be off by ±{100.0 * box.range.most:.0f} %, and the choice stands.")
        return
    winners = [found.variants[row] for row in box.range.overtaken_by]
    then = f"{variants_text(winners)} can win" if winners else "the choice can miss a threshold"
    factor = f"±{100.0 * box.range.factor:.2f} %"
    print(f"All assumed costs together may be off by {factor}; beyond that, {then}{_corner_text(found)}.")
    if box.unmoved:
        print(f"(no percentage moves what is assumed to cost nothing: {', '.join(box.unmoved)})")


def _corner_text(found: Robustness) -> str:
    box = found.costs
    if box is None or box.range.corner is None:
        return ""
    moved = [
        f"{one.component} at {amount(float(value), 'USD')}"
        for one, value in zip(box.numbers, box.range.corner, strict=True)
        if abs(value - one.value) > 1e-6 * max(1.0, one.value)
    ]
    return f" (with {', '.join(moved)})" if moved else ""


def _print_reversals(found: Robustness) -> None:
    from rgss.decision.robustness import Part

    if Part.REVERSALS in found.not_computed:
        print("Rank reversal: not computed.")
    elif found.reversals:
        removed = variants_text([found.variants[one.removed] for one in found.reversals])
        print(f"Rank reversal: the order of the others changes without {removed}.")
    else:
        print("Rank reversal: none, whichever variant is taken away.", end=" ")
        if Part.STRETCHED in found.not_computed:
            print("Of values stretched over the sample it was not computed.")
            return
        count = len(found.stretched)
        would = f"{count} removals would reverse ranks" if count else "no removal would reverse ranks either"
        print(f"Had values been stretched over the sample, {would}.")


def _print_drivers(project: Project, found: Robustness) -> None:
    from rgss.cli.output import print_table
    from rgss.decision.robustness import leading_factors
    from rgss.measures import MeasureKind

    shown = {measure.id for measure in project.measures.of_kind(MeasureKind.EFFECTIVENESS)}
    rows = []
    for one in found.effects.measures:
        if one.measure in shown:
            shares = leading_factors(one)
            told = ", ".join(f"{factor} {percent(share)}" for factor, share in shares.items()) or "no differences"
            rows.append([one.measure, told, ", ".join(one.left_out) or "–"])
    print_table(["measure", "factors", "left out, for lack of success"], rows)
    joint = [f"{factor.id} sets {' and '.join(factor.parameters)}" for factor in found.effects.factors]
    held = f"; {', '.join(found.effects.constants)} do not vary" if found.effects.constants else ""
    print(f"({'; '.join(joint)}{held})")
