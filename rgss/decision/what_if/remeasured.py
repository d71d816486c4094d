"""Estimates of the variants under suppositions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rgss.assessment import VariantMeasures
from rgss.decision.what_if.numbers import model_numbers, symbols_of, variant_with
from rgss.decision.what_if.scenario import Scenario
from rgss.designs import sources
from rgss.measures import Estimate, design_values, evaluate
from rgss.studies import Project


def measured_in(scenario: Scenario, measured: Sequence[VariantMeasures]) -> tuple[VariantMeasures, ...]:
    """Estimates of every variant under suppositions, from the stored trials.

    Args:
        scenario: The suppositions.
        measured: Every variant with its estimates and records, without the suppositions.
    """
    project = scenario.project
    numbers = {number.id: number for number in model_numbers(project)}
    changed = [(numbers[change.id], change.after) for change in scenario.changes if change.id in numbers]
    symbols = frozenset().union(*(symbols_of(project.measures, number) for number, _ in changed))
    read = frozenset(reading.measure for reading in scenario.readings)
    affected = frozenset(
        name for name, used in project.measures.used.items() if name in read or (symbols | read) & used
    )
    found = []
    for entry in measured:
        if entry.variant.id in scenario.dropped:
            continue
        if not changed and not read:
            found.append(entry)
            continue
        variant = entry.variant
        for number, value in changed:
            variant = variant_with(variant, number, value)
        estimates = _estimates(project, replace(entry, variant=variant), affected)
        found.append(replace(entry, variant=variant, estimates=estimates))
    return tuple(found)


def _estimates(project: Project, entry: VariantMeasures, affected: frozenset[str]) -> Mapping[str, Estimate]:
    """A variant's estimates, of which only some measures are affected."""
    measures = project.measures
    fixed = sources(entry.variant)
    if any(measures.measure(name).from_trials for name in affected):
        return {
            **entry.estimates,
            **evaluate(
                measures,
                fixed=fixed,
                trials=[record.metrics for record in entry.records],
                variant=entry.variant.id,
                over_looks=project.study.is_sequential,
                only=affected,
            ),
        }
    # Measures that follow from the design alone need no interval; the others are unchanged.
    values = design_values(measures, fixed=fixed, variant=entry.variant.id)
    changed = {
        name: Estimate.exact(values[name] / measures.measure(name).si_per_unit, measures.measure(name).unit)
        for name in affected
    }
    return {name: changed.get(name, estimate) for name, estimate in entry.estimates.items()}
