"""Records of trials under another charge of a check or other limits, read off stored searches."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from rgss.evidence import EvidenceStore, Piece, PieceKind, TrialRecord
from rgss.sweep.task_queue import Trial
from rgss.sweep.trial_keys import trials_of
from rgss.trials import PlanningSettings
from rgss.trials.code import versions
from rgss.trials.pieces import TrialSpec, digests_of, plan_from_json, record_with_plan
from rgss.trials.planning import TaskPlan, plan_with_limits, with_limits_of

_Pieces = tuple[TaskPlan, Mapping[PieceKind, Piece]]


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundTrials:
    """Trials that are known without a simulation, and those that are not.

    Attributes:
        records: The records by key; empty where any trial is missing.
        keys: The keys of all trials in the store, by variant and seed.
        stored: Number of trials that the store has as they are.
        read_off: Number of trials that can be read off searches with other limits.
        missing: The trials that would have to be run.
    """

    records: Mapping[str, TrialRecord] = field(hash=False)
    keys: Mapping[tuple[int, int], str] = field(hash=False)
    stored: int
    read_off: int
    missing: tuple[TrialSpec, ...]


class StoredSearches:
    """Searches that a study's trials left in the store; each piece and each known trial is read once."""

    def __init__(
        self, store: EvidenceStore, settings: PlanningSettings, known: Mapping[str, TrialRecord] = MappingProxyType({})
    ) -> None:
        """Begin with no piece read.

        Args:
            store: The evidence.
            settings: Settings of the searches.
            known: Records by key that were read from the store already.
        """
        self._store = store
        self._settings = settings
        self._known = known
        self._versions = versions()
        self._pieces: dict[str, Piece | None] = {}
        self._plans: dict[str, TaskPlan] = {}

    def find(self, specs: Sequence[TrialSpec]) -> FoundTrials:
        """Records of trials, if all are stored or can be derived; else the missing ones.

        A derived record equals that of running the trial.

        Raises:
            EvidenceError: The store is damaged.
            DefinitionError: A planning limit is longer than the search.
        """
        trials = trials_of(specs)
        there = self._store.has(trial.key for trial in trials)
        # Variants whose trials have the same inputs have the same record, but for their number.
        alike = {trial.digests.trial for trial in trials if trial.key in there}
        read: dict[str, _Pieces] = {}
        derived: set[str] = set()
        for trial in trials:
            if trial.key in there:
                continue
            if trial.digests.trial not in alike:
                pieces = self._pieces_of(trial.spec)
                if pieces is None:
                    continue
                read[trial.digests.trial] = pieces
                alike.add(trial.digests.trial)
            derived.add(trial.key)
        missing = tuple(trial.spec for trial in trials if trial.key not in there and trial.key not in derived)
        # Records are of no use where some are missing, and take the most time.
        records = {} if missing else self._records(trials, there, read)
        return FoundTrials(
            records=records,
            keys={(trial.spec.variant, trial.spec.seed): trial.key for trial in trials},
            stored=len(there),
            read_off=len(derived),
            missing=missing,
        )

    def _records(
        self, trials: Sequence[Trial], there: Collection[str], read: Mapping[str, _Pieces]
    ) -> dict[str, TrialRecord]:
        """Records of trials by key: the stored ones, and those that have the inputs of one that is stored or read."""
        records = {key: self._known[key] for key in there if key in self._known}
        records.update(self._store.records(key for key in there if key not in records))
        made = {trial.digests.trial: records[trial.key] for trial in trials if trial.key in records}
        for trial in trials:
            if trial.key in records:
                continue
            if trial.digests.trial not in made:
                made[trial.digests.trial] = record_with_plan(trial.spec, *read[trial.digests.trial])
            records[trial.key] = replace(made[trial.digests.trial], variant=trial.spec.variant)
        return records

    def _pieces_of(self, spec: TrialSpec) -> _Pieces | None:
        """The plan of a trial and its other pieces, made under the study's own clock and limits; None if they lack."""
        wanted = spec.settings.planning
        own = replace(spec, settings=replace(spec.settings, planning=with_limits_of(wanted, self._settings)))
        digests = digests_of(own, self._versions)
        made = self._plan(digests.plan)
        if made is None:
            return None
        plan = plan_with_limits(made, self._settings, wanted, planned=spec.task.planned, limit_s=spec.planning_limit_s)
        timing, execution = self._piece(digests.timing), self._piece(digests.execution)
        bench = self._piece(digests.bench) if digests.bench else None
        if plan is None or timing is None or execution is None or (digests.bench and bench is None):
            return None
        pieces = {PieceKind.TIMING: timing, PieceKind.EXECUTION: execution}
        return plan, (pieces if bench is None else {**pieces, PieceKind.BENCH: bench})

    def _plan(self, digest: str) -> TaskPlan | None:
        if digest not in self._plans:
            piece = self._piece(digest)
            if piece is None:
                return None
            self._plans[digest] = plan_from_json(piece.text)
        return self._plans[digest]

    def _piece(self, digest: str) -> Piece | None:
        if digest not in self._pieces:
            self._pieces[digest] = self._store.piece(digest)
        return self._pieces[digest]
