"""Estimates under suppositions that change trials, from stored trials or from stored searches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.decision.what_if.remeasured import measured_in
from rgss.decision.what_if.scenario import Scenario
from rgss.designs import DesignVariant, sources
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.measures import evaluate
from rgss.studies import Project, trial_settings, trial_specs
from rgss.sweep import FoundTrials, StoredSearches
from rgss.trials.pieces import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenarioEvidence:
    """Evidence under suppositions.

    Attributes:
        measured: Every variant with its estimates; empty if any trial is missing.
        trials: Number of trials that the decision needs.
        read_off: Number of those that follow from stored searches.
        missing: The trials that would have to be run.
    """

    measured: tuple[VariantMeasures, ...]
    trials: int
    read_off: int
    missing: tuple[TrialSpec, ...]

    @property
    def lack(self) -> str:
        """Phrase on the number of missing trials."""
        return f"the suppositions need {len(self.missing)} trials of {self.trials} that were not run"

    def require_whole(self) -> None:
        """Check that no trial is missing.

        Raises:
            EvidenceError: Trials are missing.
        """
        if self.missing:
            raise EvidenceError(self.lack, hint="add --run to run them")


class ScenarioEvidenceReader:
    """Reader of the evidence of scenarios of one study, which reads each stored piece once."""

    def __init__(self, project: Project, measured: Sequence[VariantMeasures], store: EvidenceStore) -> None:
        """Create a reader.

        Args:
            project: The project without suppositions.
            measured: Every variant with its estimates and records, which determine the seeds.
            store: The evidence.
        """
        self._measured = tuple(measured)
        known = {key: record for one in measured for key, record in zip(one.trials, one.records, strict=True)}
        self._searches = StoredSearches(store, trial_settings(project).planning, known)

    def read(self, scenario: Scenario) -> ScenarioEvidence:
        """The evidence of a scenario, without a simulation.

        Raises:
            EvidenceError: The store is damaged.
            DefinitionError: A measure is not defined for a design, or a design is incomplete.
        """
        if not scenario.settings:
            measured = measured_in(scenario, self._measured)
            return ScenarioEvidence(
                measured=measured, trials=sum(len(one.records) for one in measured), read_off=0, missing=()
            )
        variants = {variant.id: variant for variant in scenario.project.designs.expand()}
        entries = [one for one in self._measured if one.variant.id in variants]
        specs = _specs(scenario.project, variants, entries)
        found = self._searches.find(specs)
        return ScenarioEvidence(
            measured=()
            if found.missing
            else tuple(_measures(scenario.project, variants[one.variant.id], _seeds(one), found) for one in entries),
            trials=len(specs),
            read_off=found.read_off,
            missing=found.missing,
        )


def _seeds(entry: VariantMeasures) -> tuple[int, ...]:
    return tuple(record.seed for record in entry.records)


def _specs(
    project: Project, variants: dict[int, DesignVariant], entries: Sequence[VariantMeasures]
) -> tuple[TrialSpec, ...]:
    """The trials under the suppositions: every variant with the seeds of its trials."""
    by_seeds: dict[tuple[int, ...], list[DesignVariant]] = {}
    for entry in entries:
        by_seeds.setdefault(_seeds(entry), []).append(variants[entry.variant.id])
    return tuple(
        spec for seeds, members in by_seeds.items() for spec in trial_specs(project, variants=members, seeds=seeds)
    )


def _measures(project: Project, variant: DesignVariant, seeds: tuple[int, ...], found: FoundTrials) -> VariantMeasures:
    keys = tuple(found.keys[variant.id, seed] for seed in seeds)
    records = tuple(found.records[key] for key in keys)
    return VariantMeasures(
        variant=variant,
        trials=keys,
        records=records,
        missing=0,
        estimates=evaluate(
            project.measures,
            fixed=sources(variant),
            trials=[record.metrics for record in records],
            variant=variant.id,
            over_looks=project.study.is_sequential,
        ),
        verdicts={},
    )
