"""What suppositions change: the decision before and after, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.cli.trade.words import amount, ids_text, variants_text

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.decision.what_if import Scenario
    from rgss.studies import Project
    from rgss.tradeoff import Decision


def print_what_if(
    scenario: Scenario,
    before: tuple[Project, Sequence[VariantMeasures], Decision],
    after: tuple[Project, Sequence[VariantMeasures], Decision],
) -> None:
    """Say what is supposed, what follows, and what becomes of the decision."""
    print("What if")
    for change in scenario.changes:
        print(f"  {change.id}: {amount(change.before, change.unit)} → {amount(change.after, change.unit)}")
    if scenario.rescaled:
        told = ", ".join(
            f"{change.id.partition('.')[2]} {change.before:.3g} → {change.after:.3g}" for change in scenario.rescaled
        )
        print(f"  The other weights keep their proportions, so that all sum to 1: {told}.")
    if scenario.dropped:
        print(f"  The rules of the design space would no longer allow {variants_text(scenario.dropped)}.")
    if scenario.simulated:
        print(
            f"  The trials were simulated with the present {', '.join(scenario.simulated)}; what they showed is held."
        )
    print()
    _print_sides(before, after)
    _print_verdict(before[2], after[2])


def _print_sides(
    before: tuple[Project, Sequence[VariantMeasures], Decision],
    after: tuple[Project, Sequence[VariantMeasures], Decision],
) -> None:
    from rgss.cli.output import number, print_table

    sides = (before, after)
    rows = [
        ["chosen", "", *(str(decision.chosen or "none") for _, _, decision in sides)],
        ["as good", "", *(ids_text(decision.ties[1:]) or "–" for _, _, decision in sides)],
        ["runner-up", "", *(str(decision.runner_up or "–") for _, _, decision in sides)],
        ["value", "", *(_value(decision, decision.chosen) for _, _, decision in sides)],
        ["lead", "", *(_lead(decision) for _, _, decision in sides)],
        ["feasible variants", "", *(str(decision.counts.feasible) for _, _, decision in sides)],
    ]
    for measure in before[0].study.trade_off.weighting.weights:
        unit = before[0].measures.measure(measure).unit
        rows.append([measure, unit, *(number(_estimate(side, measure)) for side in sides)])
    print_table(["", "unit", "before", "after"], rows, right=(2, 3))


def _print_verdict(before: Decision, after: Decision) -> None:
    if after.chosen == before.chosen:
        print("The decision stays the same.")
        return
    was = "nothing" if before.chosen is None else f"variant {before.chosen}"
    now = "nothing" if after.chosen is None else f"variant {after.chosen}"
    print(f"The decision changes from {was} to {now}.")
    if before.chosen is not None:
        value = _value(after, before.chosen)
        lost = next((one for one in after.infeasible if one.variant == before.chosen), None)
        if lost is not None:
            print(f"Variant {before.chosen} would violate {', '.join(lost.requirements)}.")
        elif value != "–":
            print(f"Variant {before.chosen} would be worth {value}.")


def _estimate(side: tuple[Project, Sequence[VariantMeasures], Decision], measure: str) -> float | None:
    _, measured, decision = side
    return next((entry.estimates[measure].value for entry in measured if entry.variant.id == decision.chosen), None)


def _value(decision: Decision, variant: int | None) -> str:
    found = next((one.value for one in decision.ranking if one.variant == variant), None)
    return "–" if found is None else f"{found:.4f}"


def _lead(decision: Decision) -> str:
    values = {one.variant: one.value for one in decision.ranking}
    best, next_best = values.get(decision.chosen or 0), values.get(decision.runner_up or 0)
    return "–" if best is None or next_best is None else f"{best - next_best:.4f}"
