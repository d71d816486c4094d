"""Missing trials of suppositions: counted, or run if the options say so."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.counted import counted

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.decision.assumptions import AssumptionOutcome
    from rgss.decision.what_if import Scenario
    from rgss.evidence import EvidenceStore
    from rgss.studies import Project
    from rgss.trials.pieces import TrialSpec


def scenario_measures(
    options: argparse.Namespace,
    project: Project,
    scenario: Scenario,
    measured: Sequence[VariantMeasures],
    store: EvidenceStore,
) -> tuple[VariantMeasures, ...]:
    """Every variant under suppositions; missing trials are run if the options say so.

    Args:
        options: The options of the verb.
        project: The project without the suppositions.
        scenario: The suppositions.
        measured: Every variant without them.
        store: The evidence.

    Raises:
        EvidenceError: Trials of the study or of the suppositions are missing.
        SimulationError: Trials could not be run.
    """
    from rgss.assessment import require_complete
    from rgss.decision.what_if import ScenarioEvidenceReader

    require_complete(measured, sweep=project.command("sweep"))
    found = ScenarioEvidenceReader(project, measured, store).read(scenario)
    if found.missing and options.run:
        _run(options, project, found.missing, store)
        found = ScenarioEvidenceReader(project, measured, store).read(scenario)
    found.require_whole()
    return found.measured


def known_assumptions(
    options: argparse.Namespace, project: Project, measured: Sequence[VariantMeasures], store: EvidenceStore
) -> tuple[AssumptionOutcome, ...]:
    """The choice under each questioned assumption; missing trials are run if the options say so.

    Args:
        options: The options of the verb.
        project: The project with its study.
        measured: Every variant with its estimates.
        store: The evidence.

    Raises:
        EvidenceError: Trials of the study are missing.
        SimulationError: Trials could not be run.
    """
    from rgss.assessment import require_complete
    from rgss.decision.assumptions import assumption_outcomes, missing_trials

    require_complete(measured, sweep=project.command("sweep"))
    if options.run:
        _run(options, project, missing_trials(project, measured, store), store)
    return assumption_outcomes(project, measured, store)


def _run(options: argparse.Namespace, project: Project, specs: Sequence[TrialSpec], store: EvidenceStore) -> None:
    """Run trials into the store, with progress on standard error."""
    import os
    import sys

    from rgss.errors import DefinitionError, SimulationError
    from rgss.sweep import FinishedTrial, origin_of, sweep

    if options.jobs is not None and options.jobs < 1:
        raise DefinitionError(f"--jobs must be at least 1, got {options.jobs}")
    if not specs:
        return
    print(f"Running {counted(len(specs), 'trial')} for the suppositions.", file=sys.stderr)

    def on_finished(trial: FinishedTrial) -> None:
        """Single trials are not reported."""

    result = sweep(
        specs,
        store,
        jobs=options.jobs or os.cpu_count() or 1,
        on_finished=on_finished,
        origin=lambda: origin_of(project.folder, project.study.label),
    )
    if result.lost:
        lost = sum(len(one.trials) for one in result.lost)
        first = result.lost[0].failure
        raise SimulationError(
            f"{counted(lost, 'trial')} could not be run; first failure: {first.what}: {first.kind.value}: "
            f"{first.detail}",
            hint="the others are stored; run the command again to retry these",
        )
