"""Changes since the evidence: of each trial that is missing, and of each verdict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from rgss.assessment.recorded_verdicts import Basis, RecordedVerdict
from rgss.designs import DesignVariant, sources
from rgss.documents import digest
from rgss.evidence import EvidenceStore
from rgss.measures import StaleCause, definition_digest
from rgss.requirements import Criterion, Requirement
from rgss.studies import Project
from rgss.sweep import Reason, dry_run
from rgss.trace.evidence import verification_digest
from rgss.trials.pieces import TrialSpec

_CAUSES: Mapping[Reason, StaleCause] = MappingProxyType(
    {
        Reason.INPUT: StaleCause.MODEL,
        Reason.ENGINE: StaleCause.ENGINES,
        Reason.CODE: StaleCause.CODE,
        # There is evidence under another key, so an input differs, but which one was not recorded.
        Reason.UNKNOWN: StaleCause.MODEL,
    }
)


def outdated_trials(
    missing: Sequence[TrialSpec], store: EvidenceStore
) -> Mapping[tuple[int, int], tuple[StaleCause, ...]]:
    """The missing trials of which there is older evidence, and what changed since.

    Args:
        missing: Trials without evidence for the project as it is now.
        store: The evidence.

    Returns:
        The causes by variant and seed. A trial that was never run is not among them, nor is one
        that is missing because its run failed.

    Raises:
        EvidenceError: The store is damaged.
    """
    if not missing:
        return {}
    found: dict[tuple[int, int], tuple[StaleCause, ...]] = {}
    for due in dry_run(missing, store).due:
        there = {_CAUSES[cause.reason] for cause in due.causes if cause.reason in _CAUSES}
        if there:
            causes = tuple(cause for cause in StaleCause if cause in there)
            found.update(dict.fromkeys(due.trials, causes))
    return found


class BasisReader:
    """Inputs of verdicts as the project is now; each digest is made once."""

    def __init__(self, project: Project) -> None:
        """Digests of a project."""
        self._project = project
        self._measures: dict[str, str] = {}
        self._requirements: dict[str, str] = {}

    def basis(self, requirement: Requirement, criterion: Criterion, variant: DesignVariant) -> Basis:
        """Inputs of the verdict on a requirement, for one variant.

        Args:
            requirement: The requirement.
            criterion: Its criterion.
            variant: The variant.
        """
        measures = self._project.measures
        if criterion.measure not in self._measures:
            self._measures[criterion.measure] = definition_digest(measures, criterion.measure)
        if requirement.id not in self._requirements:
            self._requirements[requirement.id] = verification_digest(requirement)
        values = sources(variant)
        used = {name: values.get(name) for name in measures.sources(criterion.measure) if not name.startswith("trial.")}
        return Basis(
            requirement=self._requirements[requirement.id],
            measure=self._measures[criterion.measure],
            design=digest(used),
        )


def causes_since(recorded: RecordedVerdict | None, now: Basis) -> tuple[StaleCause, ...]:
    """Inputs that changed since a verdict was recorded; none if no verdict was.

    Args:
        recorded: The recorded verdict.
        now: Its inputs today.
    """
    if recorded is None:
        return ()
    then = recorded.basis
    pairs = (
        (StaleCause.REQUIREMENT, then.requirement, now.requirement),
        (StaleCause.MEASURE, then.measure, now.measure),
        (StaleCause.MODEL, then.design, now.design),
    )
    return tuple(cause for cause, before, after in pairs if before != after)
