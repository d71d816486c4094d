from __future__ import annotations

import dataclasses
import random
from types import SimpleNamespace

import pytest

from rgss.assessment import measure_variants
from rgss.decision import choose, measure_survivors, promoted_by_screening, until_decided
from rgss.decision.robustness import robustness
from rgss.decision.until_decided import replicate_until_decided, trial_twins
from rgss.designs import sources
from rgss.errors import EvidenceError, TradeoffError
from rgss.evidence import EvidenceStore, Fidelity, Provenance
from rgss.reports.decision.until_decided import open_paragraph, until_decided_summary
from rgss.studies import Promotion, Screening
from rgss.studies.expansion import trial_specs
from rgss.sweep.trial_keys import key_of, keys_of
from rgss.tradeoff.sequential import Reason, SequentialRule

NONE = Provenance(inputs={}, versions={})
RULE = SequentialRule(pilot=4, batch=4, cap=12, verdict_cap=4)


@pytest.fixture
def store(tmp_path):
    with EvidenceStore.open(tmp_path / "evidence.sqlite") as opened:
        yield opened


@pytest.fixture
def runner(store, record_of):
    """Runs trials without a simulation: STRIDE always fails, the others take their time."""
    asked = []

    def run(specs):
        rows = []
        for spec, key in zip(specs, keys_of(specs), strict=True):
            asked.append((spec.variant, spec.seed))
            chance = random.Random(f"{spec.planner} {spec.seed}")  # noqa: S311 - a sample, no secret
            success = spec.planner != "STRIDE"
            record = record_of(spec, success=success, planning_s=0.5 + chance.random())
            rows.append((key, record, NONE))
        store.put_many(trials=rows)

    run.asked = asked
    return run


def test_replicates_go_where_they_can_change_the_decision(shipped, store, runner):
    looks = []
    result = replicate_until_decided(shipped, store, runner, rule=RULE, on_look=lambda *seen: looks.append(seen))
    stride = {spec.variant for spec in trial_specs(shipped, seeds=(1,)) if spec.planner == "STRIDE"}
    assert result.variant in result.contenders
    assert not stride & set(result.contenders)
    assert max(result.trials[variant] for variant in stride) < RULE.cap == result.trials[result.variant]
    assert result.reason is Reason.CAP
    assert len(runner.asked) == len(set(runner.asked)) == result.total
    assert looks[0] == (1, 72 * 4)
    assert looks[-1] == (result.looks, result.total)
    # Every variant has the same seeds, from the study's on.
    first = shipped.study.seed
    assert set(runner.asked) == {
        (variant, seed) for variant, count in result.trials.items() for seed in range(first, first + count)
    }
    assert 0.0 <= result.probability <= 1.0
    assert set(result.verdicts) == set(result.trials)
    # The pages judge the same trials alike.
    study = dataclasses.replace(shipped.study, replicates=RULE.pilot, is_sequential=True, until_decided=RULE)
    read = measure_variants(dataclasses.replace(shipped, study=study), store)
    assert {entry.variant.id: entry.verdicts for entry in read} == result.verdicts
    assert {entry.variant.id: len(entry.records) for entry in read} == result.trials
    again = replicate_until_decided(shipped, store, lambda specs: None, rule=RULE)
    assert again == result
    text = until_decided_summary(result)
    assert text.startswith(f"variant {result.variant}: cap reached with {len(result.contenders)} contenders")
    assert f"{result.total} trials in {result.looks} looks" in text


def test_requirements_that_no_trial_gives_a_value_are_named(shipped, store, record_of):
    def run(specs):
        rows = [(key, record_of(spec, success=False), NONE) for spec, key in zip(specs, keys_of(specs), strict=True)]
        store.put_many(trials=rows)

    result = replicate_until_decided(shipped, store, run, rule=SequentialRule(pilot=2, batch=2, cap=4, verdict_cap=2))

    assert result.variant is None
    assert "SYS-005" in result.unobserved
    assert "SYS-024" not in result.unobserved


@pytest.mark.parametrize("success", [True, False])
def test_it_ends_after_the_pilot_where_no_trial_gives_a_measure_a_value(shipped, store, record_of, success):
    """Before, the whole budget was spent."""

    def run(specs):
        records = [record_of(spec, success=success) for spec in specs]
        blind = [dataclasses.replace(one, metrics={**one.metrics, "planning_time_s": None}) for one in records]
        store.put_many(trials=[(key, one, NONE) for key, one in zip(keys_of(specs), blind, strict=True)])

    rule = SequentialRule(pilot=2, batch=2, cap=8, verdict_cap=2, budget=400, finalists=4)
    result = replicate_until_decided(shipped, store, run, rule=rule)

    assert (result.reason, result.variant, result.total, result.looks) == (Reason.NO_VALUE, None, 144, 1)
    assert "t_p" in result.valueless
    assert "no trial gives a value of " in until_decided_summary(result)
    said = open_paragraph(result, command="rgss sweep")
    assert ("144 succeeded. Trials at this fidelity do not observe it" if success else "none succeeded") in said


def test_of_screened_designs_only_the_promoted_are_replicated(shipped, store, runner):
    rule = dataclasses.replace(RULE, budget=300)
    screening = Screening(fidelity=Fidelity.KINEMATIC, promotion=Promotion())
    study = dataclasses.replace(
        shipped.study, screening=screening, replicates=RULE.pilot, is_sequential=True, until_decided=rule
    )
    project = dataclasses.replace(shipped, study=study)
    stages = []

    def run(specs):
        stages.append({(spec.fidelity, spec.variant) for spec in specs})
        runner(specs)

    promoted, screened = promoted_by_screening(project, store, run)
    result = replicate_until_decided(project, store, run, rule=rule, variants=promoted)

    stride = {spec.variant for spec in trial_specs(shipped, seeds=(1,)) if spec.planner == "STRIDE"}
    assert stages[0] == {(Fidelity.KINEMATIC, one.id) for one in project.designs.expand()}
    assert {fidelity for stage in stages[1:] for fidelity, _ in stage} == {Fidelity.CONTACT}
    replicated = {variant for stage in stages[1:] for _, variant in stage}
    assert replicated == set(screened.survivors) == {one.id for one in promoted} == set(result.trials)
    assert not stride & replicated
    # The pages choose from the same designs with the same trials.
    measured, read = measure_survivors(project, store)
    assert read == screened
    assert {entry.variant.id: len(entry.records) for entry in measured} == result.trials
    assert choose(project, measured).chosen == result.variant


def replace_levels(factor, count):
    return dataclasses.replace(factor, levels=factor.levels[:count])


def test_the_sweep_and_the_decision_state_the_same_probability(shipped, store, record_of, monkeypatch):
    """More resamples of nine replicates exist than are enumerated."""
    # Two levels of three factors, so that the test is quick.
    factors = [replace_levels(factor, 2 if place < 3 else 1) for place, factor in enumerate(shipped.designs.factors)]

    def run(specs):
        chance = random.Random(f"{specs[0].seed}")  # noqa: S311 - a sample, no secret
        rows = [
            (
                key_of(spec),
                record_of(spec, success=chance.random() < 0.9, planning_s=chance.lognormvariate(0.0, 1.0)),
                NONE,
            )
            for spec in specs
        ]
        store.put_many(trials=rows)

    margin = 0.002
    rule = SequentialRule(pilot=9, cap=9, verdict_cap=9, margin=margin)
    trade_off = dataclasses.replace(shipped.study.trade_off, practical_margin=margin)
    study = dataclasses.replace(
        shipped.study, replicates=9, is_sequential=True, until_decided=rule, trade_off=trade_off
    )
    designs = dataclasses.replace(shipped.designs, factors=tuple(factors))
    project = dataclasses.replace(shipped, study=study, designs=designs)
    result = replicate_until_decided(project, store, run)
    for part in ("assumption_findings", "cost_box", "study_effects", "requirement_prices", "smaa2"):
        monkeypatch.setattr(robustness, part, lambda *_, **__: None)
    measured = measure_variants(project, store)
    found = robustness.analyse_robustness(project, measured, SimpleNamespace(chosen=result.variant))
    uncertainty = found.weighting.uncertainty

    assert found.variants[uncertainty.chosen] == result.variant
    assert not found.all_resamples
    assert uncertainty.good == result.probability
    assert 0.05 < result.probability < 0.95


def test_a_sweep_that_is_interrupted_goes_on_to_the_same_end(shipped, tmp_path, runner, store, record_of):
    rule = SequentialRule(pilot=2, batch=2, cap=12, verdict_cap=2, budget=190)
    whole = replicate_until_decided(shipped, store, runner, rule=rule)
    assert whole.reason is Reason.BUDGET
    assert whole.total <= 190
    assert whole.unsettled
    records = {trial.key: trial.record for trial in store.all()}

    class InterruptError(Exception):
        pass

    with EvidenceStore.open(tmp_path / "other.sqlite") as other:
        left = 0

        def interrupted(specs):
            # In another order, and ended after so many trials of a look that has more.
            nonlocal left
            keys = keys_of(specs[::-1])
            there = other.has(keys)
            missing = [key for key in keys if key not in there]
            made, left = missing[:left], left - min(left, len(missing))
            other.put_many(trials=[(key, records[key], NONE) for key in made])
            if len(made) < len(missing):
                raise InterruptError

        for allowed in (100, 45, 2):
            left = allowed
            with pytest.raises(InterruptError):
                replicate_until_decided(shipped, other, interrupted, rule=rule)
        assert len(other) == 147 < whole.total
        left = 1_000
        assert replicate_until_decided(shipped, other, interrupted, rule=rule) == whole
        assert {trial.key: trial.record for trial in other.all()} == records


def test_a_budget_below_the_pilot_is_refused_before_anything_is_run(shipped, store, runner):
    rule = dataclasses.replace(RULE, budget=72 * RULE.pilot - 1)
    with pytest.raises(TradeoffError, match="a budget of 287 trials is less than the pilot of 4 replicates of 72"):
        replicate_until_decided(shipped, store, runner, rule=rule)
    assert runner.asked == []


def test_trials_that_were_not_run_are_told(shipped, store):
    with pytest.raises(EvidenceError, match="the trial of variant 1 with seed 1 was not run"):
        replicate_until_decided(shipped, store, lambda specs: None, rule=RULE)


@pytest.mark.parametrize(
    ("valued", "apart_by"), [(None, ("d1", "d2", "d3", "d7")), ("P_max_simulated", ("d1", "d2", "d3"))]
)
def test_variants_of_equal_trials_are_apart_if_a_measure_of_trials_takes_something_from_the_design(
    shipped, read_trade_off_of, monkeypatch, valued, apart_by
):
    """If trials were the same for all, equation 4.3 would still depend on the speed, the payload on the hand."""
    monkeypatch.setattr(until_decided, "keys_of", lambda specs: ["the same"] * len(specs))
    project, variants = shipped, shipped.designs.expand()
    if valued is not None:
        study = read_trade_off_of("values:", f"  - {{measure: {valued}, weight: 1.0, worst: 0.8 kg, best: 1.4 kg}}")
        project = dataclasses.replace(shipped, study=study)
    twins = trial_twins(project, variants)
    alike = {}
    for one in variants:
        values = sources(one)
        alike.setdefault(tuple(values[f"design.{name}"] for name in apart_by), set()).add(one.id)
    assert {frozenset(ids) for ids in alike.values()} == {
        frozenset(one for one in twins if twins[one] == first) for first in set(twins.values())
    }
