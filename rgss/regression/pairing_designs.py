"""Pairing of the designs of a baseline with the present ones: by their levels, since numbers follow the files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TypeVar

from rgss.regression.baseline import Baseline, BaselineRun, DecisionState

Value = TypeVar("Value")

_MOST_LISTED = 8

Levels = Mapping[str, str]
"""The id of the level of each factor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedBaseline:
    """A baseline whose designs have their present numbers.

    Attributes:
        baseline: The baseline. A design without counterpart has its former number with a minus sign.
        former: The number in the file of each design that has a present number, by that number.
        notes: Differences between the numbers, in words.
    """

    baseline: Baseline
    former: Mapping[int, int] = field(hash=False)
    notes: tuple[str, ...]


def paired_by_levels(baseline: Baseline, designs: Mapping[int, Levels]) -> PairedBaseline:
    """Pair the designs of a baseline with the present designs.

    A design is paired with the one that has the same levels. If none has, or the baseline lacks levels, it is paired
    by its number, unless that is the number of another design of the baseline now.

    Args:
        baseline: The baseline as read.
        designs: The levels of every present design, by number.
    """
    known: dict[int, Levels | None] = {
        variant: run.designs.get(str(variant)) for run in baseline.runs.values() for variant in run.variants
    }
    present = {_key(levels): number for number, levels in sorted(designs.items(), reverse=True)}
    numbers = {variant: variant for variant, levels in known.items() if levels and designs.get(variant) == levels}
    taken = set(numbers)
    for variant, levels in sorted(known.items()):
        now = present.get(_key(levels)) if levels and variant not in numbers else None
        if now is not None and now not in taken:
            numbers[variant] = now
            taken.add(now)
    by_number = [variant for variant in sorted(known) if variant not in numbers and variant not in taken]
    numbers |= {variant: variant for variant in by_number}
    numbers |= {variant: -variant for variant in known if variant not in numbers}
    return PairedBaseline(
        baseline=_renumbered(baseline, numbers),
        former={now: variant for variant, now in numbers.items()},
        notes=tuple(_notes(numbers, [variant for variant in by_number if variant in designs and known[variant]])),
    )


def _notes(numbers: Mapping[int, int], by_number: list[int]) -> list[str]:
    notes = []
    moved = [f"{variant} is {now}" for variant, now in sorted(numbers.items()) if now > 0 and now != variant]
    if moved:
        notes.append(
            f"designs have other numbers than in the baseline and are paired by their levels: {_listed(moved)}"
        )
    if by_number:
        names = _listed([str(variant) for variant in by_number])
        notes.append(f"no design has the levels that the baseline has for {names}; paired by number")
    return notes


def _listed(names: list[str]) -> str:
    rest = len(names) - _MOST_LISTED
    return ", ".join(names[:_MOST_LISTED]) + (f" and {rest} more" if rest > 0 else "")


def _renumbered(baseline: Baseline, numbers: Mapping[int, int]) -> Baseline:
    if all(variant == now for variant, now in numbers.items()):
        return baseline
    runs = {name: _run(run, numbers) for name, run in baseline.runs.items()}
    decision = baseline.decision
    return replace(baseline, runs=runs, decision=None if decision is None else _decision(decision, numbers))


def _run(run: BaselineRun, numbers: Mapping[int, int]) -> BaselineRun:
    values = {
        metric: {phase: _rows(rows, numbers) for phase, rows in phases.items()} for metric, phases in run.values.items()
    }
    return replace(
        run,
        values=values,
        fingerprints=_rows(run.fingerprints, numbers),
        inputs=_rows(run.inputs, numbers),
        designs=_rows(run.designs, numbers),
    )


def _decision(decision: DecisionState, numbers: Mapping[int, int]) -> DecisionState:
    chosen = decision.chosen
    return replace(
        decision,
        chosen=None if chosen is None else numbers.get(chosen, chosen),
        pareto=tuple(sorted(numbers.get(variant, variant) for variant in decision.pareto)),
        verdicts=_rows(decision.verdicts, numbers),
        measures=_rows(decision.measures, numbers),
    )


def _rows(rows: Mapping[str, Value], numbers: Mapping[int, int]) -> dict[str, Value]:
    names = {str(variant): str(now) for variant, now in numbers.items()}
    return {names.get(variant, variant): row for variant, row in rows.items()}


def _key(levels: Levels) -> tuple[tuple[str, str], ...]:
    return tuple(sorted(levels.items()))
