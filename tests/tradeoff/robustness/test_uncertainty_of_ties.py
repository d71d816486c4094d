"""Ties by value and by feasibility, compared with a direct count over the draws."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from rgss.requirements import Comparison
from rgss.tradeoff.problem import EvidenceTable, Threshold
from rgss.tradeoff.robustness.posterior_outcomes import PosteriorOutcomes
from rgss.tradeoff.robustness.uncertainty import choice_uncertainty


def found_of(totals, feasible, *thresholds):
    """Posterior draws as the uncertainty reads them, of one measure that is the value."""
    weighting = SimpleNamespace(weights={"v": 1.0}, deciding_measures=("v",))
    return SimpleNamespace(
        totals=totals,
        outcomes=SimpleNamespace(feasible=feasible),
        preferences=SimpleNamespace(weighting=weighting, thresholds=thresholds),
        table=EvidenceTable.of(np.arange(totals.shape[1]), {"v": totals.mean(axis=0)}),
        as_required=lambda row: feasible[:, row],
    )


@pytest.fixture
def drawn():
    """The choice is worth 0.1 more than the second and is feasible in two draws of three; the third is near."""
    generator = np.random.default_rng(3)
    totals = np.column_stack([np.full(900, 0.6), np.full(900, 0.5), 0.595 + 0.02 * generator.standard_normal(900)])
    feasible = np.ones((900, 3), dtype=bool)
    feasible[::3, 0] = False
    return totals, feasible


def rivals(drawn, counts):
    totals, feasible = drawn
    single = np.array([[0.6], [0.5], [0.595]])
    one = choice_uncertainty(
        found_of(totals, feasible), 0, margin=0.01, replicates=counts, estimated=np.ones(3, dtype=bool), single=single
    )
    return {rival.row: rival for rival in one.rivals}, one


def test_who_is_ahead_only_where_the_choice_is_infeasible_gets_no_number(drawn):
    found, _ = rivals(drawn, np.array([30, 30, 30]))
    _, feasible = drawn
    assert found[1].probability == pytest.approx(np.mean(feasible[:, 1] & ~feasible[:, 0]))
    assert (found[1].by_feasibility, found[1].replicates) == (True, None)
    assert not found[2].by_feasibility
    assert found[2].replicates is not None


def test_a_lead_of_the_estimates_by_luck_does_not_count_as_separated():
    """The estimates are 0.1 apart, the draws 0.01 with a spread of 0.03: 10 trials do not separate them."""
    generator = np.random.default_rng(5)
    totals = np.column_stack([np.full(2000, 0.5), 0.49 + 0.03 * generator.standard_normal(2000)])
    one = choice_uncertainty(
        found_of(totals, np.ones((2000, 2), dtype=bool)),
        0,
        margin=0.001,
        replicates=np.array([10, 10]),
        estimated=np.ones(2, dtype=bool),
        single=np.array([[0.5], [0.4]]),
    )
    (rival,) = one.rivals
    assert rival.replicates == pytest.approx(10 * (1.645 * 0.03 / 0.01) ** 2, rel=0.15)


def test_a_tie_by_the_margin_alone_that_the_evidence_separates_gets_no_number():
    """0.04 apart with a spread of 0.02 after 50 trials: 34 would have separated them, and the margin is 0.05."""
    generator = np.random.default_rng(5)
    totals = np.column_stack([np.full(2000, 0.5), 0.46 + 0.02 * generator.standard_normal(2000)])
    one = choice_uncertainty(
        found_of(totals, np.ones((2000, 2), dtype=bool)),
        0,
        margin=0.05,
        replicates=np.array([50, 50]),
        estimated=np.ones(2, dtype=bool),
        single=np.array([[0.5], [0.46]]),
    )
    (rival,) = one.rivals
    assert rival.probability < 0.05
    assert (rival.within_margin, rival.separated, rival.replicates) == (True, True, None)


@pytest.mark.parametrize(
    ("comparison", "value", "counts", "scarce"),
    [
        (Comparison.AT_LEAST, 0.9, [49, 50], ("SYS-1",)),
        (Comparison.AT_LEAST, 0.9, [50, 51], ()),
        (Comparison.AT_LEAST, 0.98, [150, 150], ("SYS-1",)),
        (Comparison.AT_MOST, 0.1, [49, 50], ("SYS-1",)),
        (Comparison.AT_LEAST, 1.0, [50, 50], ()),
    ],
)
def test_trials_too_few_for_a_share_are_named(drawn, comparison, value, counts, scarce):
    totals, feasible = (each[:, :2] for each in drawn)
    threshold = Threshold(requirement="SYS-1", measure="v", unit="1", comparison=comparison, value=value)
    for proportions, expected in ((("v",), scarce), ((), ())):
        one = choice_uncertainty(
            found_of(totals, feasible, threshold.tolerated(0.1)),
            0,
            margin=0.01,
            replicates=np.array(counts),
            estimated=np.ones(2, dtype=bool),
            single=np.array([[0.6], [0.5]]),
            proportions=proportions,
        )
        assert one.scarce == expected


def test_the_fewer_of_two_numbers_of_replicates_count(drawn):
    equal, _ = rivals(drawn, np.array([30, 30, 30]))
    fewer, _ = rivals(drawn, np.array([30, 30, 10]))
    assert equal[2].replicates / fewer[2].replicates == pytest.approx(3.0, rel=0.01)


def test_what_is_feasible_as_required_is_counted_without_the_tolerance():
    shares = np.linspace(0.80, 0.999, 200)
    threshold = Threshold(requirement="SYS-1", measure="S", unit="1", comparison=Comparison.AT_LEAST, value=0.9)
    costs = np.where(np.arange(200) % 2 == 0, 9.0, 12.0)
    limit = Threshold(requirement="SYS-2", measure="C", unit="1", comparison=Comparison.AT_MOST, value=10.0)
    found = PosteriorOutcomes(
        preferences=SimpleNamespace(conditions=(threshold.tolerated(0.1), limit)),
        table=range(1),
        drawn={"S": shares[:, None], "C": costs[:, None]},
        outcomes=SimpleNamespace(feasible=((shares >= 0.81) & (costs <= 10.0))[:, None]),
        picks=np.zeros((200, 0), dtype=np.int64),
        proportions=frozenset({"S"}),
    )

    assert (threshold.tolerated(0.1).value, threshold.tolerated(0.1).demand) == (
        pytest.approx(0.81),
        "S >= 0.81 (required: 0.9)",
    )
    assert threshold.tolerated(0.0) is threshold
    assert found.as_required(0).tolist() == ((shares >= 0.9) & (costs <= 10.0)).tolist()
