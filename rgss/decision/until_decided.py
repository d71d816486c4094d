"""Replication until decided: replicates where they can still change the decision or a verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from rgss.assessment import VariantMeasures, requirements_with_criteria, verdicts_on
from rgss.decision.choosing import proportion_measures, trade_problem
from rgss.decision.level_structure import level_numbers
from rgss.decision.replication_check import require_sequential_rule
from rgss.designs import DesignVariant, sources
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, TrialRecord
from rgss.measures import Range, Verdict, evaluate, replicate_ranges
from rgss.studies import Project, trial_specs
from rgss.sweep import keys_of
from rgss.tradeoff import Alternative
from rgss.tradeoff.sequential import (
    Decided,
    Forecast,
    Progress,
    Reason,
    SequentialEvidence,
    SequentialRule,
    ended_without_values,
    forecast,
    next_batch_with_reserve,
    valueless_measures,
)
from rgss.trials.pieces import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class UntilDecided:
    """Result of replication until decided.

    Attributes:
        reason: Reason for the end.
        variant: The chosen variant; None if none meets every requirement.
        contenders: The variants that may be the best one; if it is decided, by less than the margin.
        verdicts: By variant, the verdict on each requirement, valid at any number of looks.
        trials: Number of trials of each variant.
        probability: Posterior probability that the choice is good; see
            `rgss.tradeoff.sequential.probability.probability_of_good_selection`.
        looks: Number of looks.
        rule: The stopping rule.
        unsettled: The variants that may be worth more than the choice by the margin.
        forecast: The replicates that would settle it; None if the decision is settled, or nothing chosen.
        unobserved: The requirements whose measure no trial of any variant observes; none if a variant is chosen.
        valueless: The measures that decide and have no value in any trial of any variant.
        succeeded: Number of successful trials.
    """

    reason: Reason
    variant: int | None
    contenders: tuple[int, ...]
    verdicts: Mapping[int, Mapping[str, Verdict]] = field(hash=False)
    trials: Mapping[int, int] = field(hash=False)
    probability: float
    looks: int
    rule: SequentialRule
    unsettled: tuple[int, ...] = ()
    forecast: Forecast | None = None
    unobserved: tuple[str, ...] = ()
    valueless: tuple[str, ...] = ()
    succeeded: int = 0

    @property
    def open_requirements(self) -> tuple[str, ...]:
        """Ids of the requirements whose verdict on the choice is inconclusive."""
        verdicts = {} if self.variant is None else self.verdicts.get(self.variant, {})
        return tuple(name for name, verdict in verdicts.items() if verdict is Verdict.INCONCLUSIVE)

    @property
    def total(self) -> int:
        """Number of all trials."""
        return sum(self.trials.values())

    @property
    def reserve_spent(self) -> int:
        """Number of trials beyond the budget."""
        return 0 if self.rule.budget is None else max(0, self.total - self.rule.budget)


def replicate_until_decided(
    project: Project,
    store: EvidenceStore,
    run: Callable[[Sequence[TrialSpec]], None],
    *,
    rule: SequentialRule | None = None,
    variants: Sequence[DesignVariant] | None = None,
    on_look: Callable[[int, int], None] | None = None,
) -> UntilDecided:
    """Replication of a study until it is decided or a cap is reached.

    Replicate r of every variant has the study's seed + r, so that variants are compared on common
    random numbers. Trials that the store has already are not run again; those beyond the
    rule's numbers are ignored, so that an interrupted sweep ends in the same state.

    Args:
        project: The project; its study's number of replicates is ignored.
        store: The evidence.
        run: Function that runs missing trials, and returns when their records are stored.
        rule: The stopping rule; the study's if None.
        variants: The variants to choose from, such as those that screening promotes; all by default.
        on_look: Callback after each look, with its number and the number of trials so far.

    Raises:
        EvidenceError: The store is damaged, or trials were not run.
        TradeoffError: The program of the trade-off has no sequential rule, or the budget is less than the pilot.
    """
    from rgss.tradeoff.sequential import check_pilot, probability_of_good_selection

    rule = rule or project.study.until_decided
    variants = project.designs.expand() if variants is None else variants
    require_sequential_rule(project)
    check_pilot(rule, len(variants))
    read = _Evidence(project, store, variants)
    wanted = {variant.id: rule.pilot for variant in variants}
    progress = Progress()
    proportions = proportion_measures(project)
    twins = trial_twins(project, variants)
    levels = level_numbers(project.designs, sorted(variant.id for variant in variants))
    known: dict[int, tuple[VariantMeasures, Alternative]] = {}
    while True:
        read.run_missing(wanted, run)
        evidence = SequentialEvidence.of(
            trade_problem(project, read.measured(), tolerant=False, known=known),
            proportions,
            twins=twins,
            levels=levels,
            tolerance=project.study.trade_off.tolerance,
            last_of_equals=project.study.trade_off.last_of_equals,
            bounds=read.ranges(),
        )
        answer = next_batch_with_reserve(evidence, rule, progress, seed=project.study.seed)
        answer = ended_without_values(evidence, rule, answer, succeeded=read.succeeded)
        progress = answer.progress
        if on_look is not None:
            on_look(progress.looks, sum(wanted.values()))
        if isinstance(answer, Decided):
            break
        wanted = {**wanted, **answer.replicates}
    return UntilDecided(
        reason=answer.reason,
        variant=answer.variant,
        contenders=answer.contenders,
        verdicts={entry.variant.id: verdicts_on(project, entry) for entry in read.measured()},
        trials=wanted,
        probability=probability_of_good_selection(
            evidence, answer.variant, margin=rule.margin, seed=project.study.seed
        ),
        looks=progress.looks,
        rule=rule,
        unsettled=tuple(sorted(answer.unsettled)),
        forecast=None
        if answer.reason is Reason.DECIDED or answer.variant is None
        else forecast(evidence, rule, progress, answer.variant, answer.unsettled),
        unobserved=() if answer.variant is not None else _unobserved(project, read.measured()),
        valueless=valueless_measures(evidence),
        succeeded=read.succeeded,
    )


def _unobserved(project: Project, measured: Sequence[VariantMeasures]) -> tuple[str, ...]:
    """The requirements whose measure no trial of any variant observes."""
    from rgss.tradeoff.infeasibility import unmeasured_requirements
    from rgss.tradeoff.problem import tabulated

    problem = trade_problem(project, measured)
    return unmeasured_requirements(problem, tabulated(problem.alternatives))


def trial_twins(project: Project, variants: Sequence[DesignVariant]) -> Mapping[int, int]:
    """Variants with the same trials for every seed, which differ only in properties that trials do not use.

    Returns:
        By variant, the first variant with the same trials.
    """
    first: dict[object, int] = {}
    found = {}
    beside = _design_beside_trials(project)
    fixed = {one.id: sources(one) for one in variants}
    specs = trial_specs(project, variants=variants, seeds=[project.study.seed])
    for key, spec in zip(keys_of([replace(spec, variant=0) for spec in specs]), specs, strict=True):
        design = tuple(fixed[spec.variant].get(source) for source in beside)
        found[spec.variant] = first.setdefault((key, design), spec.variant)
    return found


def _design_beside_trials(project: Project) -> tuple[str, ...]:
    """Sources of the design that the decision's measures of trials use too; they separate designs of equal trials."""
    measures = project.measures
    deciding = {one.criterion.measure for one in requirements_with_criteria(project) if one.criterion is not None}
    used = [measures.used[name] for name in {*deciding, *project.study.trade_off.weighting.weights}]
    observed = {one.id for one in measures.inputs if one.from_trial}
    beside = frozenset[str]().union(*(each for each in used if each & observed))
    return tuple(sorted(one.source for one in measures.inputs if one.id in beside and not one.from_trial))


class _Evidence:
    """Records of the required replicates, each read once."""

    def __init__(self, project: Project, store: EvidenceStore, variants: Sequence[DesignVariant]) -> None:
        self._project = project
        self._store = store
        self._variants = variants
        self._records: dict[int, tuple[tuple[str, TrialRecord], ...]] = {variant.id: () for variant in variants}
        self._measured: dict[int, VariantMeasures] = {}
        self._ranges: dict[int, Mapping[str, Range]] = {}

    @property
    def succeeded(self) -> int:
        """Number of successful trials among those that were read."""
        return sum(record.success for rows in self._records.values() for _, record in rows)

    def run_missing(self, wanted: Mapping[int, int], run: Callable[[Sequence[TrialSpec]], None]) -> None:
        """Run the required trials that were not read yet, and read them."""
        specs = self._missing(wanted)
        run(specs)
        self._read(specs)

    def _missing(self, wanted: Mapping[int, int]) -> tuple[TrialSpec, ...]:
        """Required trials that were not read yet."""
        first = self._project.study.seed
        alike: dict[tuple[int, int], list[DesignVariant]] = {}
        for variant in self._variants:
            alike.setdefault((len(self._records[variant.id]), wanted[variant.id]), []).append(variant)
        return tuple(
            spec
            for (there, count), variants in sorted(alike.items())
            if there < count
            for spec in trial_specs(self._project, variants=variants, seeds=range(first + there, first + count))
        )

    def _read(self, specs: Sequence[TrialSpec]) -> None:
        """Read the records of trials.

        Raises:
            EvidenceError: A trial has none.
        """
        keys = dict(zip(keys_of(specs), specs, strict=True))
        found = self._store.records(list(keys))
        for key, spec in keys.items():
            if key not in found:
                raise EvidenceError(
                    f"the trial of variant {spec.variant} with seed {spec.seed} was not run",
                    hint="see what failed with 'rgss sweep', then run it again",
                )
            self._records[spec.variant] = (*self._records[spec.variant], (key, found[key]))
            self._measured.pop(spec.variant, None)
            self._ranges.pop(spec.variant, None)

    def measured(self) -> tuple[VariantMeasures, ...]:
        """Every variant with the estimates of its measures."""
        for variant in self._variants:
            if variant.id not in self._measured:
                self._measured[variant.id] = self._measure(variant)
        return tuple(self._measured[variant.id] for variant in self._variants)

    def ranges(self) -> dict[int, Mapping[str, Range]]:
        """Possible values of a trial, by variant and measure."""
        for entry in self.measured():
            if entry.variant.id not in self._ranges:
                self._ranges[entry.variant.id] = replicate_ranges(
                    self._project.measures,
                    fixed=sources(entry.variant),
                    estimates=entry.estimates,
                    variant=entry.variant.id,
                )
        return dict(self._ranges)

    def _measure(self, variant: DesignVariant) -> VariantMeasures:
        rows = self._records[variant.id]
        estimates = evaluate(
            self._project.measures,
            fixed=sources(variant),
            trials=[record.metrics for _, record in rows],
            variant=variant.id,
            over_looks=True,
        )
        return VariantMeasures(
            variant=variant,
            trials=tuple(key for key, _ in rows),
            records=tuple(record for _, record in rows),
            missing=0,
            estimates=estimates,
            verdicts={},
        )
