"""Effect of suppositions on the decision, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.study_decision import WhatIf
from rgss.reports.decision.words import UNKNOWN, amount, ids_text, score, variants_text
from rgss.reports.plain_text import aligned_table
from rgss.trace.views import value_in_words


def what_if_lines(what_if: WhatIf) -> Iterator[str]:
    """Lines on the suppositions, their consequences, and the decision before and after."""
    scenario = what_if.scenario
    yield "What if"
    for change in scenario.changes:
        yield f"  {change.id}: {amount(change.before, change.unit)} → {amount(change.after, change.unit)}"
    for setting in scenario.settings:
        yield f"  {setting.id}: {setting.before} → {setting.after}"
    for reading in scenario.readings:
        yield f"  {reading.supposition}: {reading.rationale}"
    if scenario.rescaled:
        weights = ", ".join(
            f"{change.id.partition('.')[2]} {change.before:.3g} → {change.after:.3g}" for change in scenario.rescaled
        )
        yield f"  The other weights keep their proportions, so that all sum to 1: {weights}."
    if scenario.dropped:
        yield f"  The rules of the design space would no longer allow {variants_text(scenario.dropped)}."
    if scenario.simulated:
        numbers = ", ".join(scenario.simulated)
        yield f"  The trials were simulated with the present {numbers}; what they showed is held."
    yield ""
    yield from _sides(what_if)
    yield from _verdict(what_if)


def _sides(what_if: WhatIf) -> list[str]:
    sides = (what_if.before, what_if.after)
    rows = [
        ["chosen", "", *(str(side.decision.chosen or "none") for side in sides)],
        ["as good", "", *(ids_text(side.decision.ties[1:]) or UNKNOWN for side in sides)],
        ["runner-up", "", *(str(side.decision.runner_up or UNKNOWN) for side in sides)],
        ["value", "", *(score(side.value) for side in sides)],
        ["lead", "", *(score(side.lead) for side in sides)],
        ["feasible variants", "", *(str(side.decision.counts.feasible) for side in sides)],
    ]
    for measure, unit in what_if.units.items():
        rows.append([measure, unit, *(value_in_words(side.estimates[measure]) for side in sides)])
    return aligned_table(["", "unit", "before", "after"], rows, right=(2, 3))


def _verdict(what_if: WhatIf) -> Iterator[str]:
    before, after = what_if.before.decision.chosen, what_if.after.decision.chosen
    if after == before:
        yield "The decision stays the same."
        return
    was, now = ("nothing" if chosen is None else f"variant {chosen}" for chosen in (before, after))
    if what_if.separated is False:
        yield f"Variant {after} takes the place of variant {before}, which the evidence does not show to be a change."
    else:
        yield f"The decision changes from {was} to {now}."
    if what_if.violated_by_former_choice:
        yield f"Variant {before} would violate {', '.join(what_if.violated_by_former_choice)}."
    elif what_if.value_of_former_choice is not None:
        yield f"Variant {before} would be worth {score(what_if.value_of_former_choice)}."
