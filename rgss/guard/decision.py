"""Decision of the watched trials, and the share of a change that their own noise explains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.decision import choose, trade_problem
from rgss.designs import DesignVariant, sources
from rgss.errors import EvidenceError, TradeoffError
from rgss.evidence import TrialRecord
from rgss.guard.runs import WatchedTrials
from rgss.measures import Estimate, Verdict, evaluate, judge
from rgss.regression import FEWEST_SEEDS, DecisionState, adjusted_p_values
from rgss.studies import Project
from rgss.tradeoff import AdditiveValue
from rgss.tradeoff.problem import FEWEST_REPLICATES, bootstrap, nondominated
from rgss.tradeoff.programs import enumerate_alternatives, single_values
from rgss.tradeoff.robustness import common_replicates, noisy_outcomes, pareto_front

RESAMPLES = 1_000
"""Number of resamples of the seeds, if there are too many distinct ones to enumerate."""

VERDICT_RESAMPLES = 300
"""Number of resamples for verdicts, each of which needs the intervals of all measures."""

_TIE = 1e-9


def measured_of(trials: WatchedTrials, records: Mapping[int, Mapping[int, TrialRecord]]) -> Sequence[VariantMeasures]:
    """Every variant of a run with its estimates and verdicts.

    Raises:
        EvidenceError: A trial has no record.
    """
    project = trials.project
    number = max(len(row) for row in records.values())
    measured = []
    for variant in sorted(trials.variants, key=lambda one: one.id):
        rows = [record for _, record in sorted(records[variant.id].items())]
        if len(rows) < number:
            raise EvidenceError(f"trials of variant {variant.id} have no record", hint="see which trials failed")
        estimates, verdicts = _judged(project, variant, rows)
        measured.append(
            VariantMeasures(
                variant=variant,
                trials=(),
                records=tuple(rows),
                missing=0,
                estimates=estimates,
                verdicts=verdicts,
            )
        )
    return measured


def decision_of(trials: WatchedTrials, records: Mapping[int, Mapping[int, TrialRecord]]) -> DecisionState:
    """Decision among the variants of a run by its records.

    Raises:
        EvidenceError: A trial has no record.
        TradeoffError: The choice is ill posed.
        DefinitionError: As for `rgss.decision.choosing.trade_problem`.
    """
    measured = measured_of(trials, records)
    problem = trade_problem(trials.project, measured)
    enumeration = enumerate_alternatives(problem)
    table = enumeration.table
    front = pareto_front(single_values(problem, table), enumeration.feasible)
    criteria = [requirement.criterion for requirement in requirements_with_criteria(trials.project)]
    names = {criterion.measure for criterion in criteria if criterion is not None}
    names |= {*problem.weighting.deciding_measures}
    return DecisionState(
        run=trials.run.id,
        chosen=choose(trials.project, measured).chosen,
        pareto=tuple(sorted(int(table.variants[row]) for row in front.rows)),
        verdicts={
            str(one.variant.id): {name: verdict.value for name, verdict in one.verdicts.items()} for one in measured
        },
        measures={str(one.variant.id): _by_seed(trials.project, one, sorted(names)) for one in measured},
    )


def p_values(project: Project, before: DecisionState, now: DecisionState) -> dict[str, float]:
    """P-values of the changes in the decision under the noise of the seeds.

    A verdict depends on its measure of its variant, the choice and the front on every measure of
    every variant. Measures are compared with those of the baseline, paired by seed.

    Args:
        project: The study.
        before: The former decision.
        now: The present decision.

    Returns:
        P-values, adjusted for multiplicity, by ``chosen``, ``pareto`` and ``verdict N REQUIREMENT``; none if
        there are too few seeds.
    """
    differences: dict[str, list[float]] = {}
    for variant in before.measures.keys() & now.measures.keys():
        was, is_now = before.measures[variant], now.measures[variant]
        for measure in was.keys() & is_now.keys():
            pairs = zip(was[measure], is_now[measure], strict=False)
            differences[f"{variant} {measure}"] = [
                0.0 if old is None or new is None else new - old for old, new in pairs
            ]
    if not differences or min(map(len, differences.values())) < FEWEST_SEEDS:
        return {}
    by_measure = adjusted_p_values({name: differences[name] for name in sorted(differences)})
    least = min(by_measure.values())
    found = {"chosen": least, "pareto": least}
    for requirement in requirements_with_criteria(project):
        if requirement.criterion is not None:
            for variant in now.verdicts:
                p_value = by_measure.get(f"{variant} {requirement.criterion.measure}", 0.0)
                found[f"verdict {variant} {requirement.id}"] = p_value
    return found


def as_before(project: Project, before: DecisionState, now: DecisionState) -> frozenset[str]:
    """Parts of the decision of which every value is that of the baseline, so that no seed can have changed them.

    A measure that decides only now has no value in the baseline; that it decides is a change of the study.

    Args:
        project: The study.
        before: The former decision.
        now: The present decision.

    Returns:
        ``chosen``, ``pareto`` and ``verdict N REQUIREMENT``, as far as they have their former values.
    """
    known = {
        (variant, measure)
        for variant in before.measures.keys() & now.measures.keys()
        for measure in before.measures[variant].keys() & now.measures[variant].keys()
    }
    kept = {pair for pair in known if _values(before, pair) == _values(now, pair)}
    whole = {"chosen", "pareto"} if kept == known and before.measures.keys() == now.measures.keys() else set()
    return frozenset(whole) | {
        f"verdict {variant} {requirement.id}"
        for requirement in requirements_with_criteria(project)
        for variant in now.verdicts
        if requirement.criterion is not None and (variant, requirement.criterion.measure) in kept
    }


def _values(state: DecisionState, pair: tuple[str, str]) -> tuple[float | None, ...]:
    variant, measure = pair
    return tuple(state.measures[variant][measure])


def _by_seed(project: Project, measured: VariantMeasures, names: Sequence[str]) -> dict[str, tuple[float | None, ...]]:
    rows = [_judged(project, measured.variant, [record])[0] for record in measured.records]
    return {name: tuple(row[name].value if name in row else None for row in rows) for name in names}


def explained_by_noise(
    trials: WatchedTrials,
    records: Mapping[int, Mapping[int, TrialRecord]],
    before: DecisionState,
    now: DecisionState,
) -> dict[str, float]:
    """Probability of the former state of each changed part of the decision, over the noise of the seeds.

    The seeds are resampled with replacement, the same for all variants, and the decision and the
    verdicts are made again. A former choice also counts if it is within the study's practical margin of
    the best.

    Returns:
        Probabilities by ``chosen`` and ``pareto N``, which are absent if the study does not choose by a
        weighted value, and by ``verdict N REQUIREMENT``; none if there is no noise.
    """
    return {
        **_choice_explained(trials, records, before, now),
        **_verdicts_explained(trials, records, before, now),
    }


def _choice_explained(
    trials: WatchedTrials,
    records: Mapping[int, Mapping[int, TrialRecord]],
    before: DecisionState,
    now: DecisionState,
) -> dict[str, float]:
    if (now.chosen, now.pareto) == (before.chosen, before.pareto):
        return {}
    problem = trade_problem(trials.project, measured_of(trials, records))
    if not isinstance(problem.program, AdditiveValue):
        return {}
    table = enumerate_alternatives(problem).table
    try:
        number = common_replicates(table)
        resamples = bootstrap(number, draws=RESAMPLES, generator=np.random.default_rng(trials.project.study.seed))
    except TradeoffError:
        return {}
    outcomes = noisy_outcomes(problem, table, resamples)
    deciding = problem.weighting.deciding_measures
    weights = np.array([problem.weighting.weights[measure] for measure in deciding])
    rows = {int(variant): row for row, variant in enumerate(table.variants)}
    worth = np.where(outcomes.feasible, outcomes.values @ weights, -np.inf)
    margin = trials.project.study.trade_off.practical_margin + _TIE
    best = worth.max(axis=1)
    if before.chosen is None:
        as_it_was = ~outcomes.feasible.any(axis=1)
    elif before.chosen in rows:
        row = rows[before.chosen]
        as_it_was = outcomes.feasible[:, row] & (worth[:, row] >= best - margin)
    else:
        as_it_was = np.zeros(len(worth), dtype=np.bool_)
    found = {"chosen": float(outcomes.probabilities @ as_it_was)}
    on_front = np.zeros(outcomes.feasible.shape, dtype=np.bool_)
    for draw, (values, feasible) in enumerate(zip(outcomes.values, outcomes.feasible, strict=True)):
        if feasible.any():
            on_front[draw, np.flatnonzero(feasible)] = nondominated(values[feasible])
    for variant in set(before.pareto) ^ set(now.pareto):
        if variant in rows:
            was = on_front[:, rows[variant]] == (variant in before.pareto)
            found[f"pareto {variant}"] = float(outcomes.probabilities @ was)
    return found


def _verdicts_explained(
    trials: WatchedTrials,
    records: Mapping[int, Mapping[int, TrialRecord]],
    before: DecisionState,
    now: DecisionState,
) -> dict[str, float]:
    generator = np.random.default_rng(trials.project.study.seed)
    found = {}
    for variant in trials.variants:
        was, is_now = (state.verdicts.get(str(variant.id), {}) for state in (before, now))
        moved = [name for name in was.keys() & is_now.keys() if was[name] != is_now[name]]
        rows = [record for _, record in sorted(records[variant.id].items())]
        if not moved or len(rows) < FEWEST_REPLICATES:
            continue
        resamples = bootstrap(len(rows), draws=VERDICT_RESAMPLES, generator=generator)
        counts, shares = resamples.counts, resamples.probabilities
        if len(counts) > VERDICT_RESAMPLES:
            counts = counts[generator.choice(len(counts), size=VERDICT_RESAMPLES, p=shares)]
            shares = np.full(VERDICT_RESAMPLES, 1.0 / VERDICT_RESAMPLES)
        as_it_was = dict.fromkeys(sorted(moved), 0.0)
        for count, share in zip(counts, shares, strict=True):
            drawn = [row for row, often in zip(rows, count, strict=True) for _ in range(int(often))]
            _, verdicts = _judged(trials.project, variant, drawn)
            for name in moved:
                if verdicts[name].value == was[name]:
                    as_it_was[name] += float(share)
        found.update({f"verdict {variant.id} {name}": share for name, share in as_it_was.items()})
    return found


def _judged(
    project: Project, variant: DesignVariant, records: Sequence[TrialRecord]
) -> tuple[dict[str, Estimate], dict[str, Verdict]]:
    """Estimates of a variant's measures from some trials, and the verdict on each criterion."""
    estimates = evaluate(
        project.measures,
        fixed=sources(variant),
        trials=[record.metrics for record in records],
        variant=variant.id,
    )
    verdicts: dict[str, Verdict] = {}
    for requirement in requirements_with_criteria(project):
        if requirement.criterion is not None:
            verdict = judge(requirement.criterion, estimates[requirement.criterion.measure])
            # A measure without a value in any trial gives no verdict.
            verdicts[requirement.id] = Verdict.INCONCLUSIVE if verdict is Verdict.NOT_RUN else verdict
    return estimates, verdicts
