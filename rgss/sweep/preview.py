"""Dry run: the results that a sweep would compute, with the causes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from rgss.evidence import EvidenceStore, PieceKind, StoredTrial
from rgss.studies import CODE, named_inputs
from rgss.sweep.input_changes import ABSENT, input_changes
from rgss.sweep.task_queue import Trial
from rgss.sweep.trial_keys import trials_of
from rgss.trials.code import versions
from rgss.trials.pieces import TrialSpec

_SOURCE = "rgss-"


class Reason(str, Enum):
    """Reason for which a trial would be run."""

    NEW = "new"
    INPUT = "changed input"
    ENGINE = "changed engine"
    CODE = "changed code"
    FAILED = "failed before"
    UNKNOWN = "inputs not recorded"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """Cause of a computation.

    Attributes:
        reason: The kind of cause.
        name: Dotted name of the input, name of the engine or of the module, or the piece that failed; may be empty.
        then: Its former value, or the failure; may be empty.
        now: Its present value; may be empty.
    """

    reason: Reason
    name: str = ""
    then: str = ""
    now: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class DueTrials:
    """Trials that would be run for the same causes.

    Attributes:
        causes: The causes.
        pieces: The kinds of pieces that would be made for them; empty if their records need only be put together.
        trials: Variant and seed of each.
    """

    causes: tuple[Cause, ...]
    pieces: tuple[PieceKind, ...]
    trials: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class PieceCount:
    """The pieces of one kind that the trials to be run need.

    Attributes:
        make: Number that would be made.
        stored: Number that the store has already.
        uses: Number of those trials that need one.
    """

    make: int
    stored: int
    uses: int


@dataclass(frozen=True, slots=True, kw_only=True)
class DryRun:
    """Plan of a sweep.

    Attributes:
        trials: Number of trials of the study.
        kept: Number of them with a record.
        pieces: The pieces that the others need, by kind.
        due: The others, by the causes.
    """

    trials: int
    kept: int
    pieces: Mapping[PieceKind, PieceCount]
    due: tuple[DueTrials, ...]

    @property
    def run(self) -> int:
        """Number of trials that would get a record."""
        return self.trials - self.kept


def dry_run(specs: Sequence[TrialSpec], store: EvidenceStore | None, *, share: bool = True, study: str = "") -> DryRun:
    """List the results that a sweep would compute, with the causes, without computing anything.

    Args:
        specs: The trials.
        store: The evidence; None if there is none yet.
        share: Whether pieces would be shared; otherwise each trial makes its own.
        study: File of the study by its name in the project; evidence of others is no earlier evidence of its trials.

    Raises:
        DefinitionError: A planning limit is longer than the search.
        EvidenceError: The store cannot be read.
    """
    trials = trials_of(specs)
    there = set() if store is None else store.has(trial.key for trial in trials)
    missing = [trial for trial in trials if trial.key not in there]
    uses = {kind: Counter(trial.pieces[kind] for trial in missing if kind in trial.pieces) for kind in PieceKind}
    stored: set[str] = set()
    if share and store is not None:
        stored = store.has_pieces(digest for counts in uses.values() for digest in counts)
    present = versions() if missing and store is not None else {}
    groups: dict[tuple[tuple[Cause, ...], tuple[PieceKind, ...]], list[tuple[int, int]]] = {}
    for trial in missing:
        causes = (Cause(reason=Reason.NEW),) if store is None else _causes(trial, store, study, present)
        due = tuple(kind for kind, digest in trial.pieces.items() if digest not in stored)
        groups.setdefault((causes, due), []).append((trial.spec.variant, trial.spec.seed))
    return DryRun(
        trials=len(trials),
        kept=len(there),
        pieces={kind: _count(counts, stored, share=share) for kind, counts in uses.items() if counts},
        due=tuple(
            DueTrials(causes=causes, pieces=due, trials=tuple(members)) for (causes, due), members in groups.items()
        ),
    )


def _count(uses: Counter[str], stored: set[str], *, share: bool) -> PieceCount:
    make = len(uses.keys() - stored) if share else uses.total()
    return PieceCount(make=make, stored=len(uses.keys() & stored), uses=uses.total())


def _causes(trial: Trial, store: EvidenceStore, study: str, present: Mapping[str, str]) -> tuple[Cause, ...]:
    failures = store.failures([trial.key, *trial.pieces.values()])
    if failures:
        return tuple(
            Cause(reason=Reason.FAILED, name=failure.what, then=f"{failure.kind.value}: {failure.detail}")
            for failure in failures.values()
        )
    of_number = store.trials_of(trial.spec.variant, trial.spec.seed, trial.spec.fidelity)
    before = [stored for stored in of_number if _is_of(study, trial, stored, store)]
    if not before:
        return (Cause(reason=Reason.NEW),)
    candidates = [_differences(trial, stored, store, present) for stored in before]
    # Of several earlier studies the one that differs least shows what the user has just changed.
    return min(candidates, key=lambda causes: (Cause(reason=Reason.UNKNOWN) in causes, len(causes)))


def _is_of(study: str, trial: Trial, stored: StoredTrial, store: EvidenceStore) -> bool:
    """True if a stored trial of the same number was run for the study, as far as is recorded."""
    if study and stored.provenance.study:
        return stored.provenance.study == study
    # An earlier release did not record the study; the studies of one project mostly have different scenes.
    then = _inputs_of(stored, store)
    return then is None or then["scene"]["id"] == trial.spec.scene.id


def _differences(
    trial: Trial, stored: StoredTrial, store: EvidenceStore, present: Mapping[str, str]
) -> tuple[Cause, ...]:
    past = stored.provenance.versions
    engines = _changed(Reason.ENGINE, _engines(past), _engines(present))
    then, now = _inputs_of(stored, store), dict(named_inputs(trial.spec).values)
    if then is None:
        code = _changed(Reason.CODE, _sources(past), _sources(present))
        return (*engines, *code, Cause(reason=Reason.UNKNOWN))
    code = _changed(Reason.CODE, then.pop(CODE, {}), now.pop(CODE))
    inputs = [
        Cause(reason=Reason.INPUT, name=change.name, then=change.then, now=change.now)
        for change in input_changes(then, now)
    ]
    return (*inputs, *engines, *code) or (Cause(reason=Reason.UNKNOWN),)


def _inputs_of(stored: StoredTrial, store: EvidenceStore) -> dict[str, Any] | None:
    known_by = stored.provenance.inputs_digest
    found = store.inputs(known_by) if known_by else None
    return None if found is None else dict(found)


def _changed(reason: Reason, then: Mapping[str, str], now: Mapping[str, str]) -> list[Cause]:
    return [
        Cause(reason=reason, name=name, then=then.get(name, ABSENT), now=now.get(name, ABSENT))
        for name in sorted({*then, *now})
        if then.get(name) != now.get(name)
    ]


def _engines(found: Mapping[str, str]) -> dict[str, str]:
    return {name: version for name, version in found.items() if not name.startswith(_SOURCE)}


def _sources(found: Mapping[str, str]) -> dict[str, str]:
    return {name: version for name, version in found.items() if name.startswith(_SOURCE)}
