"""Chance and tail constraints against their definitions, by sampling and by another program."""

from __future__ import annotations

import math
from fractions import Fraction
from statistics import NormalDist

import cvxpy
import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import Alternative, ChanceBound, Comparison, TailBound, Threshold, decide
from rgss.tradeoff.problem.evidence_table import tabulated
from rgss.tradeoff.programs.columns import condition_column

CLOSED = (Comparison.AT_LEAST, Comparison.AT_MOST)


def chance(probability, value=25.0, sense=Comparison.AT_MOST):
    return ChanceBound(
        requirement="chance:R", measure="t", comparison=sense, value=value, unit="s", probability=probability
    )


def tail(share, value=30.0, sense=Comparison.AT_MOST):
    return TailBound(requirement="tail:R", measure="t", comparison=sense, value=value, unit="s", share=share)


def one(row, variant=1):
    known = [entry for entry in row if entry is not None]
    mean = sum(known) / len(known) if known else None
    return Alternative(variant=variant, measures={"t": mean}, samples={"t": tuple(row)})


@pytest.mark.parametrize(
    ("row", "sense", "share"),
    [
        ([20.0, 24.0, 25.0, 26.0], Comparison.AT_MOST, 0.75),
        ([20.0, 24.0, 25.0, 26.0], Comparison.AT_LEAST, 0.5),
        # A replicate without a time, because the task failed, does not meet it.
        ([20.0, None, None, 24.0], Comparison.AT_MOST, 0.5),
        ([25.0 * (1 + 5e-10)], Comparison.AT_MOST, 1.0),
    ],
)
def test_the_chance_is_the_share_of_all_replicates(row, sense, share):
    bound = chance(0.5, sense=sense)
    assert bound.statistic(one(row)) == share
    assert condition_column(bound, tabulated([one(row)])).tolist() == [share]


@pytest.mark.parametrize(
    ("row", "share", "sense", "mean"),
    [
        ([1.0, 2.0, 3.0, 4.0, 10.0], 0.2, Comparison.AT_MOST, 10.0),
        ([10.0, 3.0, 1.0, 4.0, 2.0], 0.4, Comparison.AT_MOST, 7.0),
        # Half of the second worst: (10 + 4 / 2) / 1.5.
        ([1.0, 2.0, 3.0, 4.0, 10.0], 0.3, Comparison.AT_MOST, 8.0),
        ([1.0, 2.0, 3.0, 4.0, 10.0], 0.3, Comparison.AT_LEAST, 2.0 / 1.5),
        ([7.0, 7.0, 7.0], 0.5, Comparison.AT_LEAST, 7.0),
    ],
)
def test_the_tail_is_the_mean_of_the_worst(row, share, sense, mean):
    bound = tail(share, sense=sense)
    assert bound.statistic(one(row)) == pytest.approx(mean)
    assert condition_column(bound, tabulated([one(row)])) == pytest.approx([mean])


def test_the_tail_of_an_alternative_with_an_unknown_replicate_is_unknown():
    assert tail(0.5).statistic(one([1.0, None])) is None
    assert math.isnan(condition_column(tail(0.5), tabulated([one([1.0, None]), one([1.0, 2.0], 2)]))[0])


@pytest.mark.parametrize("share", [0.1, 0.25, 0.37, 0.9])
@pytest.mark.parametrize("sense", CLOSED)
def test_the_tail_is_the_optimum_of_rockafellar_and_uryasev(share, sense):
    rng = np.random.default_rng(1)
    sign = 1.0 if sense is Comparison.AT_MOST else -1.0
    for _ in range(5):
        row = rng.normal(size=12)
        level = cvxpy.Variable()
        program = cvxpy.Problem(cvxpy.Minimize(level + cvxpy.sum(cvxpy.pos(sign * row - level)) / (share * len(row))))
        program.solve(solver=cvxpy.HIGHS)
        assert tail(share, sense=sense).statistic(one(row.tolist())) == pytest.approx(sign * program.value)


def test_of_gains_and_losses_that_cancel_both_forms_tell_the_same():
    """Nine of these ten sum to next to nothing; in another order to another next to nothing.

    The choice among variants asks the condition, enumeration asks the column: on a limit, one last
    bit between them would be a contradiction.
    """
    tiny = 2.1333256621830709e-13
    gain, loss = 0.25 + tiny, -0.25 + tiny
    row = [gain, gain, gain, loss, tiny, tiny, loss, gain, tiny, loss]
    rng = np.random.default_rng(3)
    for share in (0.9, 0.5, 0.37, 0.1):
        for sense in CLOSED:
            bound = tail(share, sense=sense)
            statistics = set()
            for _ in range(20):
                shuffled = one(rng.permutation(row).tolist())
                (column,) = condition_column(bound, tabulated([shuffled]))
                assert column == bound.statistic(shuffled)
                statistics.add(bound.statistic(shuffled))
            assert len(statistics) == 1
    exact = sum(Fraction(entry) for entry in sorted(row)[:9]) / 9
    assert tail(0.9, sense=Comparison.AT_LEAST).of_replicates(row) == pytest.approx(float(exact), rel=1e-15)


def test_by_sampling_the_chance_and_the_tail_of_a_known_distribution():
    """Of a normal distribution P[x <= c] = Φ(c) and CVaR_α = φ(z) / α with z the upper α quantile."""
    row = np.random.default_rng(7).normal(size=200_000).tolist()
    normal = NormalDist()
    for limit in (-1.0, 0.0, 1.5):
        assert chance(0.5, value=limit).of_replicates(row) == pytest.approx(normal.cdf(limit), abs=0.004)
    for share in (0.05, 0.3, 0.8):
        expected = normal.pdf(normal.inv_cdf(1.0 - share)) / share
        assert tail(share).of_replicates(row) == pytest.approx(expected, abs=0.02)
        assert tail(share, sense=Comparison.AT_LEAST).of_replicates(row) == pytest.approx(-expected, abs=0.02)


def test_names():
    assert chance(0.9).name == "chance:R: P[t <= 25 s] >= 0.9"
    assert tail(0.1).name == "tail:R: mean of the worst 10 % of t <= 30 s"
    assert Threshold(requirement="R", measure="S", comparison=Comparison.AT_LEAST, value=0.9, unit="1").name == (
        "R: S >= 0.9"
    )


@pytest.mark.parametrize(("probability", "count"), [(0.5, 2), (0.75, 4), (0.9, 10), (0.95, 20), (0.99, 100)])
def test_replicates_needed(probability, count):
    assert chance(probability).replicates_needed == count
    assert tail(1.0 - probability).replicates_needed == count


@pytest.mark.parametrize("level", [0.0, 1.0, -0.1, 1.5, math.nan])
def test_levels_that_are_none(level):
    with pytest.raises(TradeoffError, match="the probability must be between 0 and 1, got"):
        chance(level)
    with pytest.raises(TradeoffError, match="the share of the worst replicates must be between 0 and 1, got"):
        tail(level)


@pytest.fixture
def build(build_problem):
    def make(rows, *risks):
        return build_problem(
            {1: {"t": 0.0}},
            values={"t": (40.0, 0.0)},
            weights={"t": 1.0},
            risks=risks,
            alternatives=tuple(one(row, variant) for variant, row in rows.items()),
        )

    return make


def test_a_fast_but_unreliable_alternative_is_not_chosen(build):
    rows = {1: [10.0, 10.0, 10.0, 60.0], 2: [24.0, 24.0, 24.0, 24.0], 3: [10.0, 10.0, 26.0, 26.0]}
    assert decide(build(rows)).chosen == 3
    decision = decide(build(rows, chance(0.75)))
    assert decision.chosen == 1
    assert [(out.variant, out.requirements) for out in decision.infeasible] == [(3, ("chance:R",))]
    decision = decide(build(rows, chance(0.75), tail(0.25)))
    assert decision.chosen == 2
    assert decision.demands["chance:R"] == "P[t <= 25 s] >= 0.75"
    assert [residual.name for residual in decision.certificate.residuals[1:3]] == [
        "chance:R: P[t <= 25 s] >= 0.75",
        "tail:R: mean of the worst 25 % of t <= 30 s",
    ]


@pytest.mark.parametrize(
    ("risk", "message"),
    [
        (chance(0.9), "chance:R needs 10 replicates, variant 2 has 3"),
        (tail(0.2), "tail:R needs 5 replicates, variant 2 has 3"),
    ],
)
def test_too_few_replicates(build, risk, message):
    with pytest.raises(TradeoffError) as error:
        build({1: [1.0] * 10, 2: [1.0] * 3}, risk)
    assert error.value.message == message
    assert error.value.hint.startswith("run at least ")


def test_a_measure_of_the_design_alone_is_certain(build_problem):
    problem = build_problem(
        {1: {"t": 24.0}, 2: {"t": 26.0}},
        values={"t": (40.0, 0.0)},
        weights={"t": 1.0},
        risks=(chance(0.99), tail(0.01)),
    )
    assert decide(problem).chosen == 1
    assert [out.requirements for out in decide(problem).infeasible] == [("chance:R",)]


def test_a_demand_that_is_made_twice(build):
    with pytest.raises(TradeoffError, match=r"chance:R is demanded twice \(keep one of them\)"):
        build({1: [1.0] * 4}, chance(0.5), chance(0.7))
