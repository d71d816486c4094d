"""Main effects and interactions on the measures of effectiveness, as tables for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rgss.decision.robustness import MeasureEffects
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import share_in_words, value_in_words
from rgss.tradeoff.robustness import LEAST_USED, Effect, FactorialAnalysis

LEAST_INTERACTION = 0.005
"""Least share of a shown interaction; --json has the others."""


def effects_lines(effects: Iterable[MeasureEffects]) -> Iterator[str]:
    """The effect of each level of each factor on each measure."""
    for one in effects:
        yield ""
        title = f"Effects on {one.measure}" + ("" if one.unit == "1" else f" [{one.unit}]")
        yield from _sampled(title, one) if one.analysis is None else _of_levels(title, one)


def _of_levels(title: str, one: MeasureEffects) -> Iterator[str]:
    analysis = one.analysis
    if analysis is None:
        return
    left_out = f" without {', '.join(one.left_out)}" if one.left_out else ""
    yield f"{title}: mean {value_in_words(analysis.mean)} of {one.designs} designs{left_out}"
    rows = []
    levels = {factor.id: factor.levels for factor in one.factors}
    for effect in analysis.effects:
        if len(effect.factors) == 1:
            factor = effect.factors[0]
            for place, level in enumerate(levels[factor]):
                first = [factor, _share(effect)] if place == 0 else ["", ""]
                rows.append([*first, level, f"{float(effect.levels[place]):+.4g}", _interval(effect, place)])
        elif effect.share >= LEAST_INTERACTION:
            rows.append([" × ".join(effect.factors), _share(effect), "", "", ""])
    yield from aligned_table(["factor", "share", "level", "effect", "interval of 95 %"], rows, right=(3,))
    if analysis.rest >= LEAST_INTERACTION:
        yield f"Interactions of three and more factors: {share_in_words(analysis.rest)}"
    if note := usable_resamples_sentence(analysis):
        yield note


def usable_resamples_sentence(analysis: FactorialAnalysis) -> str:
    """Sentence on the resamples of which the intervals are; empty if they are of all, or there are none."""
    if not 0.0 < analysis.used < 1.0 - 1e-9:
        return ""
    share = share_in_words(analysis.used)
    if analysis.used < LEAST_USED:
        return (
            f"No intervals: only {share} of the resamples of the replicates leave every design a success, too few for "
            f"intervals of these ({share_in_words(LEAST_USED)}); more replicates give them."
        )
    return f"Intervals are of the {share} of resamples that leave every design a success."


def _sampled(title: str, one: MeasureEffects) -> Iterator[str]:
    if not one.sampled:
        yield f"{title}: not computed, since {one.not_computed}"
        return
    yield f"{title}: {one.designs} designs of a sample"
    rows = []
    for factor, index in one.sampled.items():
        # An estimated share below 0 is sampling noise.
        share, low, high = (share_in_words(max(0.0, each)) for each in (index.share, index.low, index.high))
        rows.append([factor, share, f"{low} – {high}"])
    yield from aligned_table(["factor", "share alone", "interval of 95 %"], rows, right=(1,))


def _share(effect: Effect) -> str:
    share = share_in_words(effect.share)
    if effect.share_low is None or effect.share_high is None:
        return share
    return f"{share} ({share_in_words(effect.share_low)} – {share_in_words(effect.share_high)})"


def _interval(effect: Effect, place: int) -> str:
    if effect.low is None or effect.high is None:
        return ""
    return f"{float(effect.low[place]):+.4g} … {float(effect.high[place]):+.4g}"
