"""Measures of a decision in which another term stands for one that the trials do not observe."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.decision.preference_model import deciding_measures
from rgss.designs import sources
from rgss.measures import Substitution, design_values, may_substitute, needed_symbols, substitutions_in, trial_values
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class DecidingSubstitution:
    """A substitution in a measure that the choice reads.

    Attributes:
        measure: The measure.
        requirements: Ids of the requirements that bound it.
        substitution: The terms.
        variants: The designs in whose trials it happens, in their order.
        trials: Number of these trials.
    """

    measure: str
    requirements: tuple[str, ...]
    substitution: Substitution
    variants: tuple[int, ...]
    trials: int


def deciding_substitutions(project: Project, measured: Sequence[VariantMeasures]) -> tuple[DecidingSubstitution, ...]:
    """The substitutions in measures that the choice reads."""
    return tuple(
        found
        for measure, requirements in _deciding(project).items()
        if may_substitute(project.measures, measure)
        for found in _of_measure(project, measured, measure, tuple(requirements))
    )


def _deciding(project: Project) -> dict[str, list[str]]:
    """The requirements on each deciding measure, by the measure."""
    found: dict[str, list[str]] = {measure: [] for measure in deciding_measures(project)}
    for requirement in requirements_with_criteria(project):
        if requirement.criterion is not None:
            found[requirement.criterion.measure].append(requirement.id)
    return found


def _of_measure(
    project: Project, measured: Sequence[VariantMeasures], measure: str, requirements: tuple[str, ...]
) -> Iterator[DecidingSubstitution]:
    measures = project.measures
    needed = needed_symbols(measures, [measure])
    trials: dict[Substitution, dict[int, int]] = defaultdict(dict)
    for entry in measured:
        variant = entry.variant.id
        design = design_values(measures, fixed=sources(entry.variant), variant=variant)
        for record in entry.records:
            values = trial_values(measures, design=design, trial=record.metrics, only=needed)
            for one in substitutions_in(measures, measure, values):
                trials[one][variant] = trials[one].get(variant, 0) + 1
    for substitution, counts in trials.items():
        yield DecidingSubstitution(
            measure=measure,
            requirements=requirements,
            substitution=substitution,
            variants=tuple(counts),
            trials=sum(counts.values()),
        )
