"""Measures and designs of a study as input of the plots."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.api.argument_terms import text_argument
from rgss.assessment import VariantMeasures
from rgss.errors import DefinitionError
from rgss.measures import Measure, estimate_ranges
from rgss.studies import Project
from rgss.tradeoff import Decision

if TYPE_CHECKING:
    from rgss.reports.study_plots import PlottedDesigns, PlottedMeasure

_MOST_NEAR = 3
"""Most measures that a hint names."""


def measure_named(project: Project, name: str, *, argument: str) -> Measure:
    """A measure of a study that is a single number.

    Args:
        project: The project with the study.
        name: Its id.
        argument: The argument that names it.

    Raises:
        DefinitionError: There is no measure of that id, or it is a row of numbers.
    """
    text_argument(argument, name, hint="give the id of a measure")
    known = {one.id: one for one in project.measures.measures if _is_single(one)}
    if name not in known:
        hint = _near_measures(name, list(known.values()))
        raise DefinitionError(f"{argument}: {name!r} is not a measure with one value for each design", hint=hint)
    return known[name]


def _near_measures(name: str, measures: Sequence[Measure]) -> str:
    """Hint for an unknown measure: those of a similar id or name, and where all are listed."""
    everything = f"study.measures has all {len(measures)}"
    plain = {one.id.lower(): one.id for one in measures} | {one.name.lower(): one.id for one in measures}
    sought = name.lower().replace("_", " ")
    near = [plain[one] for text in (name.lower(), sought) for one in difflib.get_close_matches(text, plain, n=1)]
    near += [plain[one] for one in plain if len(sought) > 1 and sought in one]
    found = list(dict.fromkeys(near))[:_MOST_NEAR]
    return f"did you mean {' or '.join(map(repr, found))}? {everything}" if found else everything


def plotted_measure(project: Project, measured: Sequence[VariantMeasures], measure: Measure) -> PlottedMeasure:
    """A measure with the estimate of each design, and the limits that requirements set to it.

    Args:
        project: The project with the study.
        measured: Every design with its estimates.
        measure: The measure.
    """
    from rgss.reports.study_plots import Limit, PlottedMeasure

    limits = [
        Limit(requirement=one.id, criterion=one.criterion, value=one.criterion.threshold_in(measure.unit))
        for one in project.requirements.system
        if one.criterion is not None and one.criterion.measure == measure.id
    ]
    return PlottedMeasure(
        id=measure.id,
        name=measure.name,
        unit=measure.unit,
        better=measure.better,
        estimates={one.variant.id: one.estimates[measure.id] for one in measured if measure.id in one.estimates},
        limits=tuple(limits),
        within=estimate_ranges(project.measures)[measure.id],
    )


def plotted_designs(project: Project, measured: Sequence[VariantMeasures], decision: Decision | None) -> PlottedDesigns:
    """The designs with their roles in the decision.

    Args:
        project: The project with the study.
        measured: Every design with its estimates.
        decision: The decision; None if trials are missing, so that there is none yet.
    """
    from rgss.reports.study_plots import PlottedDesigns, Role

    study = project.study
    label = f"{study.id}, {study.fidelity.value} fidelity"
    ids = sorted(one.variant.id for one in measured)
    if decision is None:
        missing = sum(one.missing for one in measured)
        note = f"not judged: {missing} trials have no evidence yet"
        return PlottedDesigns(study=label, roles=dict.fromkeys(ids, Role.UNJUDGED), note=note)
    roles = dict.fromkeys(ids, Role.FEASIBLE)
    roles |= {one.variant: Role.INFEASIBLE for one in decision.infeasible}
    if decision.runner_up is not None:
        roles[decision.runner_up] = Role.RUNNER_UP
    roles |= dict.fromkeys((*decision.near_ties, *decision.ties), Role.TIED)
    if decision.chosen is None:
        return PlottedDesigns(study=label, roles=roles, note="no design meets every requirement by its estimates")
    return PlottedDesigns(study=label, roles=roles | {decision.chosen: Role.CHOSEN})


def deciding_measures(project: Project, *, among: Sequence[str]) -> list[Measure]:
    """The measures that decide: those with a weight, the heaviest first, then those with a limit.

    Args:
        project: The project with the study.
        among: Ids of the weighted measures, the heaviest first.
    """
    limited = [one.criterion.measure for one in project.requirements.system if one.criterion is not None]
    known = {one.id: one for one in project.measures.measures if _is_single(one)}
    return [known[name] for name in dict.fromkeys((*among, *limited)) if name in known]


def _is_single(measure: Measure) -> bool:
    return measure.length is None or measure.summary is not None
