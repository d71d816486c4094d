"""Changes since the evidence was made, of missing trials and of verdicts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
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
        # There is evidence under another key, so that an input differs, but the record does not show which one.
        Reason.UNKNOWN: StaleCause.MODEL,
    }
)


def outdated_trials(
    missing: Sequence[TrialSpec], store: EvidenceStore, *, study: str = ""
) -> Mapping[tuple[int, int], tuple[StaleCause, ...]]:
    """Missing trials with older evidence, and the changes since then.

    Args:
        missing: Trials without evidence for the project as it is now.
        store: The evidence.
        study: As for `dry_run`.

    Returns:
        The causes by variant and seed, without trials that were never run and those whose run failed.

    Raises:
        EvidenceError: The store is damaged.
    """
    if not missing:
        return {}
    found: dict[tuple[int, int], tuple[StaleCause, ...]] = {}
    for due in dry_run(missing, store, study=study).due:
        there = {_CAUSES[cause.reason] for cause in due.causes if cause.reason in _CAUSES}
        if there:
            causes = tuple(cause for cause in StaleCause if cause in there)
            found.update(dict.fromkeys(due.trials, causes))
    return found


class BasisReader:
    """Digests of the present inputs of verdicts; each is computed once."""

    def __init__(self, project: Project) -> None:
        """Create a reader of a project."""
        self._project = project
        self._measures: dict[str, str] = {}
        self._requirements: dict[str, str] = {}

    def basis(self, requirement: Requirement, criterion: Criterion, variant: DesignVariant) -> Basis:
        """Inputs of the verdict on a requirement, for one variant."""
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


def causes_since(recorded: RecordedVerdict | None, now: Basis, trials: Iterable[str]) -> tuple[StaleCause, ...]:
    """Inputs that changed since a verdict was recorded; none without a recorded verdict on this evidence.

    Args:
        recorded: The recorded verdict.
        now: Its present inputs.
        trials: Keys of the trials that the present verdict is drawn from.
    """
    if recorded is None or recorded.is_older_than(trials):
        return ()
    then = recorded.basis
    pairs = (
        (StaleCause.REQUIREMENT, then.requirement, now.requirement),
        (StaleCause.MEASURE, then.measure, now.measure),
        (StaleCause.MODEL, then.design, now.design),
    )
    return tuple(cause for cause, before, after in pairs if before != after)
