"""Records of trials under another charge of a check or other limits, read off stored searches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from rgss.evidence import EvidenceStore, Piece, PieceKind, TrialRecord
from rgss.sweep.trial_keys import trials_of
from rgss.trials import PlanningSettings
from rgss.trials.code import versions
from rgss.trials.pieces import TrialSpec, digests_of, plan_from_json, record_under
from rgss.trials.planning import TaskPlan, plan_under, with_limits_of


@dataclass(frozen=True, slots=True, kw_only=True)
class FoundTrials:
    """Trials that are known without a simulation, and those that are not.

    Attributes:
        records: The records that are known, by variant and seed.
        keys: The keys of all trials in the store, by variant and seed.
        stored: Number of them that the store has as they are.
        missing: The trials that would have to be run.
    """

    records: dict[tuple[int, int], TrialRecord] = field(hash=False)
    keys: dict[tuple[int, int], str] = field(hash=False)
    stored: int
    missing: tuple[TrialSpec, ...]

    @property
    def read_off(self) -> int:
        """Number of those that were read off searches with other limits."""
        return len(self.records) - self.stored


class StoredSearches:
    """Searches that a study's trials left in the store; each piece is read once."""

    def __init__(self, store: EvidenceStore, settings: PlanningSettings) -> None:
        """Begin with no piece read.

        Args:
            store: The evidence.
            settings: How the searches were made.
        """
        self._store = store
        self._settings = settings
        self._versions = versions()
        self._pieces: dict[str, Piece | None] = {}
        self._plans: dict[str, TaskPlan] = {}

    def find(self, specs: Sequence[TrialSpec]) -> FoundTrials:
        """The records of trials as far as they are stored or can be read off.

        A record that is read off equals the one that running the trial gives.

        Args:
            specs: The trials.

        Raises:
            EvidenceError: The store is damaged.
            DefinitionError: A planning limit is longer than the search.
        """
        trials = trials_of(specs)
        stored = self._store.records([trial.key for trial in trials])
        records, missing = {}, []
        for trial in trials:
            record = stored.get(trial.key) or self._read_off(trial.spec)
            if record is None:
                missing.append(trial.spec)
            else:
                records[trial.spec.variant, trial.spec.seed] = record
        keys = {(trial.spec.variant, trial.spec.seed): trial.key for trial in trials}
        return FoundTrials(records=records, keys=keys, stored=len(stored), missing=tuple(missing))

    def _read_off(self, spec: TrialSpec) -> TrialRecord | None:
        """The record of a trial whose pieces are there under the study's own clock and limits; None if they are not."""
        wanted = spec.settings.planning
        own = replace(spec, settings=replace(spec.settings, planning=with_limits_of(wanted, self._settings)))
        digests = digests_of(own, self._versions)
        made = self._plan(digests.plan)
        if made is None:
            return None
        plan = plan_under(made, self._settings, wanted, limit_s=spec.planning_limit_s)
        timing, execution = self._piece(digests.timing), self._piece(digests.execution)
        bench = self._piece(digests.bench) if digests.bench else None
        if plan is None or timing is None or execution is None or (digests.bench and bench is None):
            return None
        pieces = {PieceKind.TIMING: timing, PieceKind.EXECUTION: execution}
        return record_under(spec, plan, pieces if bench is None else {**pieces, PieceKind.BENCH: bench})

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
