"""Records of trials under another charge of a check or other limits, read off stored searches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from rgss.evidence import EvidenceStore, Piece, PieceKind, TrialRecord
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
    """Searches that a study's trials left in the store; each piece is read once."""

    def __init__(self, store: EvidenceStore, settings: PlanningSettings) -> None:
        """Begin with no piece read.

        Args:
            store: The evidence.
            settings: Settings of the searches.
        """
        self._store = store
        self._settings = settings
        self._versions = versions()
        self._pieces: dict[str, Piece | None] = {}
        self._plans: dict[str, TaskPlan] = {}

    def find(self, specs: Sequence[TrialSpec]) -> FoundTrials:
        """Records of trials, if all are stored or can be derived; else the missing ones.

        A derived record equals that of running the trial.

        Args:
            specs: The trials.

        Raises:
            EvidenceError: The store is damaged.
            DefinitionError: A planning limit is longer than the search.
        """
        trials = trials_of(specs)
        there = self._store.has(trial.key for trial in trials)
        read: dict[str, _Pieces] = {}
        for trial in trials:
            pieces = None if trial.key in there else self._pieces_of(trial.spec)
            if pieces is not None:
                read[trial.key] = pieces
        missing = tuple(trial.spec for trial in trials if trial.key not in there and trial.key not in read)
        # Records are of no use where some are missing, and take the most time.
        records = {} if missing else dict(self._store.records(there))
        if not missing:
            for trial in trials:
                if trial.key in read:
                    plan, pieces_of_trial = read[trial.key]
                    records[trial.key] = record_with_plan(trial.spec, plan, pieces_of_trial)
        return FoundTrials(
            records=records,
            keys={(trial.spec.variant, trial.spec.seed): trial.key for trial in trials},
            stored=len(there),
            read_off=len(read),
            missing=missing,
        )

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
