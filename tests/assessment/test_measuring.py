"""Estimates and verdicts from records, against what one computes by hand."""

from __future__ import annotations

from statistics import mean

import pytest
from scipy.stats import binom

from rgss.assessment.measuring import judged_measures, measure_variants, require_complete, requirements_with_criteria
from rgss.errors import EvidenceError
from rgss.measures import Verdict
from rgss.studies.expansion import trial_specs
from rgss.sweep.trial_keys import key_of


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    """Every variant takes longer than the one before and each replicate longer; seed 2 of every fifth fails."""

    def record_for(spec):
        return record_of(
            spec,
            success=not (spec.seed == 2 and spec.variant % 5 == 0),
            planning_s=0.1 * spec.seed,
            path_m=0.01 * spec.variant,
            motion_s=float(spec.variant + spec.seed),
        )

    return measure_variants(shipped, filled(shipped, record_for))


@pytest.mark.verifies("SYS-036")
def test_every_variant_with_its_trials_in_the_order_of_their_seeds(shipped, measured):
    specs = trial_specs(shipped)

    assert [entry.variant.id for entry in measured] == list(range(1, 73))
    for entry in measured:
        assert entry.missing == 0
        assert [record.seed for record in entry.records] == [1, 2, 3]
        assert entry.trials == tuple(key_of(spec) for spec in specs if spec.variant == entry.variant.id)
        assert set(entry.estimates) == {measure.id for measure in shipped.measures.measures}


@pytest.mark.verifies("SYS-036")
def test_times_by_the_equations(measured):
    for entry in measured:
        succeeded = [seed for seed in (1, 2, 3) if not (seed == 2 and entry.variant.id % 5 == 0)]
        speed = entry.variant.parameters["d7"]
        planning_s = [5 * 0.1 * seed for seed in succeeded]
        motion_s = 0.048 / entry.variant.parameters["d4"] + 5 * 0.01 * entry.variant.id / speed

        assert entry.estimates["t_p"].value == pytest.approx(mean(planning_s))
        assert entry.estimates["t_e"].value == pytest.approx(mean(planning_s) + motion_s)
        assert entry.estimates["t_p"].n == entry.estimates["t_e"].n == len(succeeded)
        simulated = [entry.variant.id + seed + 5 * 0.1 * seed for seed in succeeded]
        assert entry.estimates["t_e_simulated"].value == pytest.approx(mean(simulated))


@pytest.mark.verifies("SYS-037")
def test_success_is_a_proportion_with_the_interval_of_clopper_and_pearson(measured):
    for entry in measured:
        successes, trials = (2, 3) if entry.variant.id % 5 == 0 else (3, 3)
        estimate = entry.estimates["S"]

        assert (estimate.value, estimate.n) == (successes / trials, trials)
        # Each limit is the share at which so many successes, or so few, have a probability of 2.5 %.
        assert binom.sf(successes - 1, trials, estimate.low) == pytest.approx(0.025)
        assert (
            estimate.high == 1.0
            if successes == trials
            else binom.cdf(successes, trials, estimate.high) == (pytest.approx(0.025))
        )
        assert entry.estimates["S_mean"].value == pytest.approx((successes + (trials - successes) * 3 / 8) / trials)


def test_what_follows_from_the_design_stands_on_no_trial(measured):
    for entry in measured:
        payload, values = entry.estimates["P_max_g"], entry.variant.parameters

        assert payload.n == 0
        assert payload.value == payload.low == payload.high
        force_n = values["d1"] * values["d5"]
        assert payload.value == pytest.approx(values["d6"] * force_n / (1.5 * (9.81 + 1.2)))


def test_verdicts_on_every_requirement_with_a_criterion(shipped, measured):
    ids = [requirement.id for requirement in requirements_with_criteria(shipped)]

    assert ids
    for entry in measured:
        assert list(entry.verdicts) == ids
        assert Verdict.NOT_RUN not in entry.verdicts.values()


def test_estimates_do_not_depend_on_the_order_of_what_is_stored(shipped, filled, record_of, measured):
    again = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, planning_s=0.1 * spec.seed)))
    once_more = measure_variants(shipped, filled(shipped, lambda spec: record_of(spec, planning_s=0.1 * spec.seed)))

    assert [entry.estimates for entry in again] == [entry.estimates for entry in once_more]


def test_without_evidence_nothing_is_known(shipped, filled):
    measured = measure_variants(shipped, filled(shipped, lambda _: None))

    for entry in measured:
        assert (entry.records, entry.trials, entry.missing) == ((), (), 3)
        assert entry.estimates["S"].value is None
        assert entry.estimates["t_e"].value is None
        assert entry.estimates["C_total"].value is not None
        assert entry.verdicts["SYS-024"] is Verdict.NOT_RUN


def test_trials_that_are_missing(shipped, filled, record_of):
    def only_the_first(spec):
        return record_of(spec) if spec.seed == 1 else None

    measured = measure_variants(shipped, filled(shipped, only_the_first))

    assert {entry.missing for entry in measured} == {2}
    with pytest.raises(EvidenceError) as caught:
        require_complete(measured)
    assert caught.value.message == "144 of 216 trials have no evidence for the project as it is now"
    assert caught.value.hint == "run 'rgss sweep' first"


def test_complete_evidence_is_accepted(measured):
    require_complete(measured)


def test_evidence_of_another_project_is_not_used(shipped, filled, record_of):
    store = filled(shipped, record_of)
    other = shipped.with_replicates(4)

    assert {entry.missing for entry in measure_variants(other, store)} == {1}


def test_a_choice_is_judged_by_its_measures_of_effectiveness_and_those_of_criteria(shipped):
    bounded = {one.criterion.measure for one in requirements_with_criteria(shipped)}
    assert judged_measures(shipped) == bounded | {"P_max", "C_total", "t_e", "t_p", "S"}
    assert "t_gc_simulated" in bounded
