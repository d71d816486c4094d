"""Trials that a guard watches, with their records and metrics."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from rgss.designs import DesignVariant
from rgss.errors import DefinitionError, DocumentError
from rgss.evidence import EvidenceStore, Provenance, TrialRecord
from rgss.guard.designs import guard_findings, watched_designs
from rgss.regression import Baseline, fingerprint, observed
from rgss.studies import GuardedMetric, Project, RegressionGuard, WatchedRun, trial_specs
from rgss.sweep import keys_of
from rgss.trials.pieces import TrialSpec

RunTrials = Callable[[Sequence[TrialSpec]], None]
"""Function that runs missing trials, and returns when their records are stored."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WatchedTrials:
    """A run with its project and variants.

    Attributes:
        run: Its definition in the study.
        project: The project at the run's fidelity.
        variants: Its variants.
    """

    run: WatchedRun
    project: Project
    variants: tuple[DesignVariant, ...]

    @property
    def ids(self) -> tuple[int, ...]:
        """The ids of its variants, ascending."""
        return tuple(sorted(variant.id for variant in self.variants))

    def seeds(self, count: int) -> tuple[int, ...]:
        """The first seeds, from the study's on."""
        first = self.project.study.seed
        return tuple(range(first, first + count))

    def specs(self, count: int) -> tuple[TrialSpec, ...]:
        """The trials of the first seeds."""
        return trial_specs(self.project, variants=self.variants, seeds=self.seeds(count))


class Records:
    """The records of watched trials, each read once."""

    def __init__(self, store: EvidenceStore, run_trials: RunTrials) -> None:
        """Create an empty collection.

        Args:
            store: The evidence.
            run_trials: Function that runs missing trials.
        """
        self._store = store
        self._run_trials = run_trials
        self._found: dict[str, dict[tuple[int, int], TrialRecord]] = {}
        self._keys: dict[str, None] = {}

    def fetch(self, wanted: Sequence[tuple[WatchedTrials, int]]) -> None:
        """Run and read the trials of some runs.

        Raises:
            EvidenceError: The store is damaged.
        """
        # Runs of the same fidelity may share trials, which are run once and read for both.
        shared = [
            (trials.run.id, spec, key)
            for trials, count in wanted
            for spec, key in zip(trials.specs(count), keys_of(trials.specs(count)), strict=True)
        ]
        specs = {
            key: (run, spec) for run, spec, key in shared if (spec.variant, spec.seed) not in self._found.get(run, {})
        }
        self._run_trials([spec for _, spec in specs.values()])
        records = self._store.records(list(specs))
        for run, spec, key in shared:
            if key in records:
                self._keys[key] = None
                self._found.setdefault(run, {})[spec.variant, spec.seed] = records[key]

    def of(self, trials: WatchedTrials, count: int) -> Mapping[int, Mapping[int, TrialRecord]]:
        """The records of the first seeds of a run by variant and seed; without those that could not be run."""
        found = self._found.get(trials.run.id, {})
        return {
            variant: {seed: found[variant, seed] for seed in trials.seeds(count) if (variant, seed) in found}
            for variant in trials.ids
        }

    def provenances(self) -> tuple[Provenance, ...]:
        """The provenance of every record that was read.

        Raises:
            EvidenceError: The store is damaged.
        """
        stored = (self._store.get(key) for key in self._keys)
        return tuple(one.provenance for one in stored if one is not None)

    def lost(self, trials: WatchedTrials, count: int) -> tuple[tuple[int, int], ...]:
        """Variant and seed of each trial among the first seeds that could not be run."""
        found = self._found.get(trials.run.id, {})
        every = ((variant, seed) for variant in trials.ids for seed in trials.seeds(count))
        return tuple(one for one in every if one not in found)


def guard_of(project: Project) -> RegressionGuard:
    """Regression section of a study.

    Raises:
        DefinitionError: It guards nothing.
    """
    if project.study.regression is None:
        raise DefinitionError(
            f"{project.study.label} has no section 'regression'",
            hint="name the guarded metrics in it; see docs/regression.md",
        )
    return project.study.regression


def watched_trials(project: Project, guard: RegressionGuard) -> tuple[WatchedTrials, ...]:
    """The runs with their variants.

    Raises:
        DocumentError: A run names no variants.
    """
    findings = guard_findings(project)
    if findings:
        raise DocumentError(findings)
    return tuple(
        WatchedTrials(
            run=run,
            project=project.with_fidelity(run.fidelity.value),
            variants=watched_designs(project, run),
        )
        for run in guard.runs
    )


def series_of(
    records: Mapping[int, Mapping[int, TrialRecord]], metric: str, phase: str
) -> dict[int, dict[int, float | None]]:
    """The values of a metric by variant and seed."""
    return {
        variant: {seed: observed(record, metric, phase) for seed, record in row.items()}
        for variant, row in records.items()
    }


def fingerprints_of(
    records: Mapping[int, Mapping[int, TrialRecord]],
    baseline: Baseline | None = None,
    former: Mapping[int, int] = MappingProxyType({}),
) -> dict[int, dict[int, str]]:
    """The fingerprint of each record by variant and seed.

    Args:
        records: The records.
        baseline: The baseline whose fingerprints they are compared with: metrics that records have only since
            then are excluded. None to include all.
        former: The number of each variant in the baseline, where it is another: a record has the number of its
            variant.
    """
    metrics = None if baseline is None else baseline.record
    phase_metrics = None if baseline is None or not baseline.phase_record else baseline.phase_record
    return {
        variant: {
            seed: fingerprint(
                replace(record, variant=former.get(variant, variant)), metrics=metrics, phase_metrics=phase_metrics
            )
            for seed, record in row.items()
        }
        for variant, row in records.items()
    }


def subjects_of(guard: RegressionGuard, run: str) -> Iterable[tuple[GuardedMetric, str]]:
    """The metrics of a run with the phases in which they may be compared."""
    for metric in guard.metrics:
        if run in metric.runs:
            for phase in metric.phases:
                yield metric, phase
