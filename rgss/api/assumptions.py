"""Measures under suppositions, and the table of the modelling assumptions, for the Python interface."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.api.frames import described_frame
from rgss.api.sweep import run_trials
from rgss.assessment import VariantMeasures, require_complete
from rgss.decision.assumptions import assumption_outcomes
from rgss.decision.what_if import Scenario, ScenarioEvidenceReader, measured_in
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.studies import Project

if TYPE_CHECKING:
    import pandas as pd


def scenario_measures(
    project: Project, scenario: Scenario, measured: tuple[VariantMeasures, ...], *, run: bool, jobs: int | None
) -> tuple[VariantMeasures, ...]:
    """Every variant under suppositions.

    Args:
        project: The project without them.
        scenario: The suppositions.
        measured: Every variant without them.
        run: True to run missing trials.
        jobs: Number of worker processes for that.

    Raises:
        EvidenceError: Trials are missing.
        SimulationError: Trials could not be run.
    """
    if not scenario.settings:
        return measured_in(scenario, measured)
    require_complete(measured)
    with EvidenceStore.open(project.evidence, create=False) as store:
        found = ScenarioEvidenceReader(project, measured, store).read(scenario)
        if found.missing and run:
            run_trials(project, found.missing, store, jobs=jobs)
            found = ScenarioEvidenceReader(project, measured, store).read(scenario)
    if found.missing:
        raise EvidenceError(found.lack, hint="call trade(…, run=True) to run them")
    return found.measured


def assumptions_frame(project: Project, measured: tuple[VariantMeasures, ...]) -> pd.DataFrame:
    """One row for each alternative of each modelling assumption.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
    """
    require_complete(measured)
    with EvidenceStore.open(project.evidence, create=False) as store:
        outcomes = assumption_outcomes(project, measured, store)
    rows = [
        {
            "assumption": one.question.about,
            "alternative": one.question.alternative,
            "taken_as": one.taken_as,
            "chosen": one.chosen,
            "feasible": one.feasible if one.is_same is not None else None,
            "changes_choice": None if one.is_same is None else not one.is_same,
            "trials": one.trials,
            "missing": one.missing,
            "read_off": one.read_off,
            "reason": one.reason,
        }
        for one in outcomes
    ]
    return described_frame("assumptions", rows)
