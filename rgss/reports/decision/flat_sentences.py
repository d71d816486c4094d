"""Sentences on weights that do not separate the designs."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.sensitivity import FlatRemedy, FlatWeight
from rgss.reports.decision.words import amount


def flat_sentences(flat: tuple[FlatWeight, ...], *, decides: bool = True) -> Iterator[str]:
    """Sentences on weights that do not separate the designs, with advice."""
    for one in flat:
        among = "feasible variants" if one.among_feasible else "variants"
        yield (
            f"{one.measure} is worth the same for all {among}, so its weight of {one.weight:.3g} has no effect: "
            f"{_remedy(one)}"
        )
    if decides and len(flat) and flat[0].effective:
        effective = flat[0].effective
        deciding = (
            f"{effective[0][0]} decides alone"
            if len(effective) == 1
            else f"what decides is {', '.join(f'{name} {weight:.3g}' for name, weight in effective)}"
        )
        total = sum(one.weight for one in flat)
        others = "the others" if len(flat) > 1 else "it"
        what = f"Weights of {total:.3g} in all separate" if len(flat) > 1 else f"The weight of {total:.3g} separates"
        yield f"{what} nothing; {deciding}, and without {others} the order is the same."


def _remedy(one: FlatWeight) -> str:
    if one.remedy is FlatRemedy.MOVE_ENDS:
        low, high = amount(one.low, one.unit), amount(one.high, one.unit)
        return f"set worst and best to the swing that is there, {low} to {high}, and weigh that swing again."
    everyone = ""
    if one.all_low < one.all_high and one.among_feasible:
        everyone = f" (all variants: {amount(one.all_low, one.unit)} to {amount(one.all_high, one.unit)})"
    if one.remedy is FlatRemedy.VARY_THE_WORLD:
        return (
            f"all are at {amount(one.high, one.unit)}{everyone}; let the world vary or make the task harder until "
            "designs differ, or drop the measure."
        )
    if one.remedy is FlatRemedy.EASE_THE_TASK:
        return (
            f"all are at {amount(one.high, one.unit)}{everyone}, the worst; make the task easier, or raise the limits "
            "at which trials fail, until designs differ."
        )
    return (
        f"all are at {amount(one.high, one.unit)}{everyone}; leave it to its requirement and drop the measure, "
        "or add designs that differ in it."
    )
