"""Place and contents of the evidence."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.decision import NamingStudy
    from rgss.evidence.store import Contents


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidencePlace:
    """Place of the evidence.

    Attributes:
        folder: The project's folder.
        path: The file of the store.
        label: Its name in messages.
    """

    folder: Path
    path: Path
    label: str


def trials_by_study(store: EvidencePlace, studies: Sequence[NamingStudy]) -> list[frozenset[str]]:
    """Keys of the trials of each study, as far as its screening is known."""
    from rgss.decision import asked_trials
    from rgss.evidence import EvidenceStore

    if not store.path.exists():
        return [asked_trials(study, None) for study in studies]
    with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
        return [asked_trials(study, evidence) for study in studies]


def contents_and_studies(store: EvidencePlace) -> tuple[Contents, tuple[NamingStudy, ...]]:
    """Contents of the store, and the studies with the trials and pieces that they name."""
    from rgss.decision import naming_studies
    from rgss.evidence import EvidenceStore
    from rgss.evidence.store import contents_of
    from rgss.trials.code import assume_engines

    with EvidenceStore.open(store.path, create=False, label=store.label) as evidence:
        contents = contents_of(evidence.database)
        assume_engines(trial.provenance.versions for trial in evidence.iterate())
    seeds: dict[str, set[int]] = {}
    for trial in contents.trials:
        seeds.setdefault(trial.fidelity, set()).add(trial.seed)
    return contents, naming_studies(store.folder, seeds)


def named_trials(studies: Iterable[NamingStudy], *, strict: bool) -> set[str]:
    """Keys of the trials that studies name; with `strict`, without those of other replicates or fidelities."""
    return {key for study in studies for key in (study.own if strict else study.all).trials}
