"""Closest rivals, and what would change the decision, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.robustness import Part, WeightRobustness, not_computed_lines
from rgss.decision.study_decision import LimitMove, RobustnessFindings, StudyDecision
from rgss.reports.decision.limit_sentences import limit_sentences
from rgss.reports.decision.sensitivity_sentences import tied_by_weights_sentence
from rgss.reports.decision.text.assumptions import assumption_lines
from rgss.reports.decision.text.contenders import contender_lines
from rgss.reports.decision.words import UNKNOWN, amount, moves_text, variants_text
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import share_in_words


def robustness_lines(made: StudyDecision) -> Iterator[str]:
    """The robustness of a decision; each part that was not computed with its reason."""
    found = made.robustness
    if found is None:
        return
    missing = not_computed_lines(found.analysis.not_computed)
    if made.decision.chosen is None:
        yield from ("", *missing) if missing else ()
        return
    if not made.is_alone:
        yield from ("", "What nearly won")
        yield from contender_lines(found, tolerance=made.tolerance)
    yield from ("", "What would change it")
    weighting = found.analysis.weighting
    if made.is_alone:
        yield "Weights: none changes the choice, as no other variant is compared."
    elif weighting is not None:
        yield from _weights(found, weighting)
    chosen = next((one.value for one in made.decision.ranking if one.variant == made.decision.chosen), None)
    yield from _limits(found, chosen or 0.0, made.tolerance)
    if weighting is not None:
        yield from assumption_lines(found)
    if not made.is_alone:
        yield _reversals(found)
    yield from (f"Not analysed: {name}: {reason}." for name, reason in found.analysis.refused.items())
    yield from missing
    if not found.is_missing(Part.EFFECTS):
        yield from _drivers(found)


def _weights(found: RobustnessFindings, weighting: WeightRobustness) -> Iterator[str]:
    move = found.nearest_move
    if weighting.shifts is None:
        yield "Weights: the nearest that change the choice were not computed."
    elif found.tied_by_weights:
        yield f"Weights: {tied_by_weights_sentence(found.tied_by_weights)}"
        if move is not None:
            yield f"Of the others {variants_text(move.winners)} can win, by moving {move.moved:.3f} of weight."
    elif move is None:
        yield f"Weights: no other variant wins for any {'elicited ' if weighting.elicited else ''}weights."
    else:
        winners = variants_text(move.winners)
        yield (f"Weights: moving {move.moved:.3f} of weight lets {winners} win: {moves_text(move.before, move.after)}.")
    if weighting.ranges is None:
        yield "Range of each weight: not computed."
        return
    rows = []
    weights = found.analysis.weights.tolist()
    for measure, weight, one in zip(found.analysis.measures, weights, weighting.ranges, strict=True):
        below, above = (variants_text(found.variants(ends)) if ends else UNKNOWN for ends in (one.below, one.above))
        rows.append([measure, f"{weight:.3g}", f"{one.low:.3f}", f"{one.high:.3f}", below, above])
    titles = ["weight", "is", "stays best from", "to", "below wins", "above wins"]
    yield from aligned_table(titles, rows, right=(1, 2, 3))
    yield "(one weight moves, the others keep their proportions)"


def _limits(found: RobustnessFindings, value: float, tolerance: float) -> Iterator[str]:
    """The next change of the choice on either side of each limit."""
    if found.is_missing(Part.PRICES):
        yield from ("", "Price of each requirement: not computed.")
    if not found.limits:
        return

    def cell(move: LimitMove | None, unit: str, bound: str = "") -> str:
        if move is None:
            return UNKNOWN
        gain = "" if move.value is None and bound else f" ({(move.value or 0.0) - value:+.4f})"
        return f"{bound}{amount(move.limit, unit)}: {variants_text(move.winners)}{gain}"

    rows = [
        [
            one.requirement,
            one.demand,
            cell(one.looser, one.unit),
            cell(one.tighter, one.unit, "> " if one.at_least else "< "),
        ]
        for one in found.limits
    ]
    yield ""
    yield from aligned_table(["threshold", "demands", "loosened to", "tightened to"], rows)
    yield "(which variant would then win, and what its value gains or loses)"
    yield from limit_sentences(found.limits, tolerance=tolerance)


def _reversals(found: RobustnessFindings) -> str:
    if found.is_missing(Part.REVERSALS):
        return "Rank reversal: not computed."
    analysis = found.analysis
    if analysis.reversals:
        removed = variants_text(found.variants(tuple(one.removed for one in analysis.reversals)))
        return f"Rank reversal: the order of the others changes without {removed}."
    none = "Rank reversal: none, whichever variant is removed."
    if found.is_missing(Part.STRETCHED):
        return f"{none} Of values stretched over the sample it was not computed."
    count = len(analysis.stretched)
    would = (
        f"{count} removal{'s' if count > 1 else ''} would reverse ranks"
        if count
        else "no removal would reverse ranks either"
    )
    return f"{none} Had values been stretched over the sample, {would}."


def _drivers(found: RobustnessFindings) -> Iterator[str]:
    part = "explains alone" if found.sampled else "takes part in"
    yield from ("", f"What drives the measures (share of the differences between designs that a factor {part})")
    rows = []
    for one in found.drivers:
        shares = ", ".join(f"{factor} {share_in_words(share)}" for factor, share in one.shares.items())
        # No factor of a sample need explain a share alone, though designs differ.
        none = "not computed" if one.not_computed else "none" if found.sampled else "no differences"
        rows.append([one.measure, shares or none, ", ".join(one.left_out) or UNKNOWN])
    yield from aligned_table(["measure", "factors", "left out, for lack of an estimate"], rows)
    for reason in dict.fromkeys(one.not_computed for one in found.drivers if one.not_computed):
        measures = ", ".join(one.measure for one in found.drivers if one.not_computed == reason)
        yield f"Not computed for {measures}: {reason}."
    if found.sampled:
        yield (
            "(estimated from a sample of designs: shares need not sum to 100 %, and factors are left out whose share "
            "chance alone gives in one of twenty such samples)"
        )
    effects = found.analysis.effects
    notes = [f"{factor.id} sets {' and '.join(factor.parameters)}" for factor in effects.factors]
    if effects.constants:
        notes.append(f"{', '.join(effects.constants)} {'do' if len(effects.constants) > 1 else 'does'} not vary")
    if notes:
        yield f"({'; '.join(notes)})"
