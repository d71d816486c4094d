"""Stored trials that the studies of a project name, with the present project and code."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from rgss.assessment import read_specs
from rgss.decision.screening import screen, screening_specs, surviving_specs
from rgss.decision.screening_result import ScreeningResult
from rgss.errors import DefinitionError, DocumentError
from rgss.evidence import EvidenceStore, Fidelity
from rgss.findings import Finding
from rgss.studies import MOST_REPLICATES, Project, load_project, trial_specs
from rgss.sweep import trials_of
from rgss.trials.code import assume_engines
from rgss.trials.pieces import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedTrials:
    """Trials that a study names."""

    trials: frozenset[str]
    pieces: frozenset[str]


@dataclass(frozen=True, slots=True, kw_only=True)
class NamingStudy:
    """A study of the project with the trials that it names.

    Attributes:
        file: Its file, relative to the project.
        project: The project with this study.
        own: The trials that it needs, at its fidelity and with its number of replicates; for a study that
            replicates until decided also all up to its cap, as far as the evidence has the seeds.
        all: These, and those of ``--fidelity`` and ``--replicates`` as far as the evidence has the seeds.
    """

    file: str
    project: Project
    own: NamedTrials
    all: NamedTrials


def naming_studies(folder: Path, seeds: Mapping[str, Iterable[int]]) -> tuple[NamingStudy, ...]:
    """Every study of a project, in the order of the files, with the trials that it names.

    Args:
        folder: The project's folder.
        seeds: The seeds that the evidence has of each fidelity.

    Raises:
        DocumentError: Files are wrong, with the problems of all studies, since an unreadable study may
            name any trial.
        DefinitionError: There is no study.
    """
    names = sorted(path.relative_to(folder).as_posix() for path in (folder / "studies").glob("*.yaml"))
    if not names:
        raise DefinitionError("the project has no study", hint="a study is a file studies/NAME.yaml")
    projects: dict[str, Project] = {}
    findings: list[Finding] = []
    for name in names:
        try:
            projects[name] = load_project(folder, name)
        except DocumentError as error:  # noqa: PERF203 - all problems are reported at once
            findings += [finding for finding in error.findings if finding not in findings]
    if findings:
        raise DocumentError(findings)
    return tuple(_naming(name, project, seeds) for name, project in projects.items())


def asked_trials(study: NamingStudy, store: EvidenceStore | None) -> frozenset[str]:
    """Keys of the trials that a sweep would run or reuse; for a screened-out design only the screening trials.

    Args:
        study: The study.
        store: The evidence; None if there is none yet.

    Raises:
        EvidenceError: The store is damaged.
    """
    if study.project.study.is_sequential and study.project.study.screening is None:
        return frozenset(_keys_read(study.project, store))
    screened = screen(study.project, store)
    return study.own.trials if screened is None else _keys(_screened_specs(study.project, screened))


def asked_of(project: Project, store: EvidenceStore) -> frozenset[str]:
    """Keys of the trials that a sweep of a project would run or reuse, independent of its other studies.

    Args:
        project: The project with its study, its number of replicates and its fidelity.
        store: The evidence, on which a screening depends.

    Raises:
        EvidenceError: The store is damaged.
    """
    assume_engines(trial.provenance.versions for trial in store.iterate())
    if project.study.is_sequential and project.study.screening is None:
        return frozenset(_keys_read(project, store))
    screened = screen(project, store)
    return _keys(
        (*trial_specs(project), *screening_specs(project)) if screened is None else _screened_specs(project, screened)
    )


def _keys_read(project: Project, store: EvidenceStore | None) -> Iterator[str]:
    """Keys of the trials that an assessment reads, including missing trials of the study."""
    for keys in read_specs(project, store, project.designs.expand()).values():
        yield from keys


def _screened_specs(project: Project, screened: ScreeningResult) -> tuple[TrialSpec, ...]:
    return (*screening_specs(project), *surviving_specs(project, screened))


def _keys(specs: Sequence[TrialSpec]) -> frozenset[str]:
    return frozenset(trial.key for trial in trials_of(specs))


def _naming(name: str, project: Project, seeds: Mapping[str, Iterable[int]]) -> NamingStudy:
    study = project.study
    own = (*trial_specs(project), *screening_specs(project))
    if study.is_sequential:
        last = study.seed + study.until_decided.cap
        added = sorted(seed for seed in seeds.get(study.fidelity.value, ()) if study.seeds[-1] < seed < last)
        own = (*own, *trial_specs(project, seeds=added))
    every = {spec.seed for spec in own}
    first = study.seed
    more: list[TrialSpec] = []
    for fidelity in Fidelity:
        replicates = every | {seed for seed in seeds.get(fidelity.value, ()) if 0 <= seed - first < MOST_REPLICATES}
        more += trial_specs(project.with_fidelity(fidelity.value), seeds=sorted(replicates))
    return NamingStudy(file=name, project=project, own=_named(own), all=_named((*own, *more)))


def _named(specs: Sequence[TrialSpec]) -> NamedTrials:
    trials = trials_of(specs)
    return NamedTrials(
        trials=frozenset(trial.key for trial in trials),
        pieces=frozenset(digest for trial in trials for digest in trial.digests.as_mapping().values()),
    )
