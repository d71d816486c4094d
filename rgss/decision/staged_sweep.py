"""Stages of a sweep: screening if the study has one, deciding trials of the promoted designs, verdicts."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rgss.assessment import record_after_sweep, record_before_sweep
from rgss.decision.screening import screen, screening_specs
from rgss.decision.screening_result import ScreeningResult
from rgss.designs import DesignVariant
from rgss.evidence import EvidenceStore
from rgss.studies import Project, trial_specs
from rgss.trials.pieces import TrialSpec

RunStage = Callable[[Sequence[TrialSpec]], object]
"""Function that runs the missing ones of some trials."""


def sweep_in_stages(
    project: Project, variants: Sequence[DesignVariant], store: EvidenceStore, run: RunStage
) -> ScreeningResult | None:
    """Run the stages in sequence, and record the verdicts on new evidence, and missing ones.

    Args:
        project: The project with its study.
        variants: The variants whose trials are run.
        store: The evidence.
        run: Function that runs a stage: first the screening trials, if there are any, then the deciding ones.

    Returns:
        The outcome of screening; None if the study has none.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged, or the verdicts cannot be written.
    """
    record_before_sweep(project, store)
    promoted, screened = promoted_by_screening(project, store, run, variants=variants)
    run(trial_specs(project, variants=promoted))
    record_after_sweep(project, store)
    return screened


def promoted_by_screening(
    project: Project,
    store: EvidenceStore,
    run: RunStage,
    *,
    variants: Sequence[DesignVariant] | None = None,
) -> tuple[Sequence[DesignVariant], ScreeningResult | None]:
    """Run the screening trials, if the study has a screening, and select the variants that it promotes.

    Args:
        project: The project with its study.
        store: The evidence.
        run: Function that runs the missing ones of some trials.
        variants: The variants to select from; all by default.

    Returns:
        The promoted variants, and the outcome of screening; all of them and None if the study has none.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged.
    """
    among = project.designs.expand() if variants is None else variants
    if project.study.screening is not None:
        run(screening_specs(project, variants=among))
    screened = screen(project, store)
    return among if screened is None else screened.promoted(among), screened
