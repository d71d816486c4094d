"""Main effects and interactions on the measures of effectiveness, as tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.cli.trade.words import percent

if TYPE_CHECKING:
    from rgss.decision.robustness import MeasureEffects, StudyEffects
    from rgss.studies import Project
    from rgss.tradeoff.robustness import Effect

LEAST_INTERACTION = 0.005
"""Interactions with a smaller share are left to --json."""


def print_effects(project: Project, effects: StudyEffects) -> None:
    """Show what each level of each factor does to each measure of effectiveness."""
    from rgss.measures import MeasureKind

    shown = {measure.id for measure in project.measures.of_kind(MeasureKind.EFFECTIVENESS)}
    for one in effects.measures:
        if one.measure in shown:
            _print_measure(one)


def _print_measure(one: MeasureEffects) -> None:
    from rgss.cli.output import number, print_table

    unit = "" if one.unit == "1" else f" [{one.unit}]"
    print(f"\nEffects on {one.measure}{unit}", end="")
    if one.analysis is None:
        _print_sampled(one)
        return
    left_out = f" without {', '.join(one.left_out)}" if one.left_out else ""
    print(f": mean {number(one.analysis.mean)} of {one.designs} designs{left_out}")
    rows = []
    levels = {factor.id: factor.levels for factor in one.factors}
    for effect in one.analysis.effects:
        if len(effect.factors) == 1:
            factor = effect.factors[0]
            for place, level in enumerate(levels[factor]):
                first = [factor, _share(effect)] if place == 0 else ["", ""]
                rows.append([*first, level, _number(effect, place), _interval(effect, place)])
        elif effect.share >= LEAST_INTERACTION:
            rows.append([" × ".join(effect.factors), _share(effect), "", "", ""])
    print_table(["factor", "share", "level", "effect", "interval of 95 %"], rows, right=(3,))
    if one.analysis.rest >= LEAST_INTERACTION:
        print(f"Interactions of three and more factors: {percent(one.analysis.rest)}")
    if 0.0 < one.analysis.used < 1.0 - 1e-9:
        print(f"Intervals stand on the {percent(one.analysis.used)} of resamples that leave every design a success.")


def _print_sampled(one: MeasureEffects) -> None:
    from rgss.cli.output import print_table

    if not one.sampled:
        print(": too few designs have estimates")
        return
    print(f": {one.designs} designs of a sample")
    rows = [
        [factor, percent(max(0.0, index.share)), f"{percent(max(0.0, index.low))} – {percent(max(0.0, index.high))}"]
        for factor, index in one.sampled.items()
    ]
    print_table(["factor", "share alone", "interval of 95 %"], rows, right=(1,))


def _share(effect: Effect) -> str:
    if effect.share_low is None or effect.share_high is None:
        return percent(effect.share)
    return f"{percent(effect.share)} ({percent(effect.share_low)} – {percent(effect.share_high)})"


def _number(effect: Effect, place: int) -> str:
    return f"{float(effect.levels[place]):+.4g}"


def _interval(effect: Effect, place: int) -> str:
    if effect.low is None or effect.high is None:
        return ""
    return f"{float(effect.low[place]):+.4g} … {float(effect.high[place]):+.4g}"
