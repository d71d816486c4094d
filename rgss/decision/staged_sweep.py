"""The stages of a sweep: screening where the study has one, what decides of the designs that go on, the verdicts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from rgss.assessment import record_after_sweep
from rgss.decision.screening import screen, screening_specs, surviving_specs
from rgss.decision.screening_result import ScreeningResult
from rgss.designs import DesignVariant
from rgss.evidence import EvidenceStore
from rgss.studies import Project, trial_specs
from rgss.trials.pieces import TrialSpec

RunStage = Callable[[Sequence[TrialSpec]], Collection[int]]
"""Makes the trials that the store has not, and returns the variants of which one was run."""


def sweep_in_stages(
    project: Project, variants: Sequence[DesignVariant], store: EvidenceStore, run: RunStage
) -> ScreeningResult | None:
    """Run one stage after the other, and record the verdicts of what was run.

    Args:
        project: The project with its study.
        variants: The variants whose trials are run.
        store: The evidence.
        run: Runs a stage: first the trials that screen, if there are any, then those that decide.

    Returns:
        What became of every design in screening; None if the study has none.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged, or the verdicts cannot be written.
    """
    screened = None
    specs = trial_specs(project, variants=variants)
    first = screening_specs(project, variants=variants)
    if first:
        run(first)
        screened = screen(project, store)
    if screened is not None:
        specs = surviving_specs(project, screened, variants=variants)
    run_now = run(specs)
    if run_now:
        record_after_sweep(project, store, run_now)
    return screened
