"""SMAA-2, against a published example, geometry and brute force."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness import acceptability
from rgss.tradeoff.robustness.acceptability import Outcomes, smaa2
from rgss.tradeoff.weights.weight_region import winning_regions
from rgss.tradeoff.weights.weight_set import WeightSet

SIMPLEX = WeightSet.simplex(3)


def generator_of(seed):
    return np.random.default_rng(seed)


@pytest.fixture(scope="module")
def heparin_and_enoxaparin():
    """Two anticoagulants on three risks, whose Beta distributions a trial of 136 and 129 patients gave.

    The worked example of the R package smaa (van Valkenhoef; its reference output is
    smaa/tests/Examples/smaa-Ex.Rout.save): events of the trial that Lynd and O'Brien ("Advances in
    risk-benefit evaluation using probabilistic simulation methods", Journal of Clinical
    Epidemiology 57, 2004) analyse, with linear values between 0 and 25 %, 15 and 40 %, 0 and 10 %.
    """
    generator, count = generator_of(1), 12_000
    events = {"heparin": ((20, 116), (40, 96), (1, 135)), "enoxaparin": ((8, 121), (32, 97), (5, 124))}
    scales = ((0.0, 0.25), (0.15, 0.4), (0.0, 0.1))
    values = np.empty((count, 2, 3))
    for drug, counts in enumerate(events.values()):
        for risk, ((hit, spared), (best, worst)) in enumerate(zip(counts, scales, strict=True)):
            values[:, drug, risk] = (worst - generator.beta(hit, spared, count)) / (worst - best)
    return Outcomes(
        values=np.clip(values, 0.0, 1.0),
        feasible=np.ones((count, 2), dtype=bool),
        probabilities=np.full(count, 1.0 / count),
        exact=False,
    )


def test_the_published_example(heparin_and_enoxaparin):
    """Published from 10,000 draws, whose standard error is 0.005; ours have 0.003."""
    found = smaa2(heparin_and_enoxaparin, SIMPLEX, iterations=24_000, generator=generator_of(2))

    assert found.ranks == pytest.approx(np.array([[0.3504, 0.6496], [0.6496, 0.3504]]), abs=0.015)
    assert found.central_weights[0] == pytest.approx([0.1865, 0.2772, 0.5363], abs=0.01)
    assert found.central_weights[1] == pytest.approx([0.4073, 0.3641, 0.2285], abs=0.01)
    assert found.confidence == pytest.approx([0.6682, 0.8956], abs=0.025)
    assert (found.confidence_errors > 0.0).all()
    assert found.rank_errors[0, 0] == pytest.approx(np.sqrt(0.35 * 0.65 / 24_000), rel=0.02)


def test_acceptability_without_noise_is_the_share_of_the_region():
    """Monte Carlo against volumes from corners: two ways to the same number."""
    generator = generator_of(3)
    values = generator.random((12, 4))
    feasible = generator.random(12) > 0.2
    weights = WeightSet.simplex(4)
    found = smaa2(Outcomes.certain(values, feasible), weights, iterations=100_000, generator=generator)
    regions = winning_regions(values, feasible, weights, generator=generator)

    assert found.first == pytest.approx([region.share for region in regions], abs=6e-3)
    assert found.unranked == pytest.approx(1.0 - feasible)
    assert found.confidence[found.first > 0] == pytest.approx(1.0)
    assert found.confidence_errors[found.first > 0] == pytest.approx(0.0)
    assert np.isnan(found.central_weights[found.first == 0]).all()


def test_against_integration_on_a_grid():
    """All indices by the midpoint rule over weights and every outcome; four outcomes, uneven, one infeasible."""
    values = generator_of(4).random((4, 5, 3))
    feasible = np.ones((4, 5), dtype=bool)
    feasible[1, 2] = feasible[3, 0] = False
    probabilities = np.array([0.4, 0.3, 0.2, 0.1])
    outcomes = Outcomes(values=values, feasible=feasible, probabilities=probabilities, exact=True)
    found = smaa2(outcomes, SIMPLEX, iterations=60_000, generator=generator_of(5))

    parts = 120
    corners = [(i, j) for i in range(parts) for j in range(parts - i)]
    thirds = np.array([(i + 1 / 3, j + 1 / 3, parts - i - j - 2 / 3) for i, j in corners])
    others = np.array([(i + 2 / 3, j + 2 / 3, parts - i - j - 4 / 3) for i, j in corners if i + j < parts - 1])
    grid = np.vstack([thirds, others]) / parts
    ranks, central = np.zeros((5, 5)), np.zeros((5, 3))
    for value, possible, probability in zip(values, feasible, probabilities, strict=True):
        totals = np.where(possible, grid @ value.T, -1.0)
        place = (totals[:, :, None] < totals[:, None, :]).sum(axis=2)
        for rank in range(5):
            hit = (place == rank) & possible
            ranks[:, rank] += probability * hit.mean(axis=0)
            if rank == 0:
                central += probability * (hit.T.astype(float) @ grid) / len(grid)
    central /= ranks[:, :1]
    confidence = [
        sum(
            probability
            for value, possible, probability in zip(values, feasible, probabilities, strict=True)
            if possible[row] and (value @ central[row])[row] >= (value @ central[row])[possible].max() - 1e-12
        )
        for row in range(5)
    ]
    assert found.ranks == pytest.approx(ranks, abs=8e-3)
    assert found.central_weights == pytest.approx(central, abs=0.02)
    assert found.unranked == pytest.approx([0.1, 0.0, 0.3, 0.0, 0.0], abs=6e-3)
    assert found.confidence == pytest.approx(confidence, abs=1e-9)
    assert (found.confidence_errors == 0.0).all()


def test_equals_share_the_better_rank():
    """Rank is one more than the number of better ones, as Lahdelma and Salminen (2001) define it."""
    values = np.array([[0.5, 0.5, 0.5], [0.5, 0.5, 0.5], [0.1, 0.1, 0.1]])
    found = smaa2(Outcomes.certain(values, np.ones(3, dtype=bool)), SIMPLEX, iterations=500, generator=generator_of(6))

    assert found.ranks.tolist() == [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]


def test_ranks_against_a_pairwise_count():
    values = np.round(generator_of(7).random((1, 9, 3)), 1)
    outcomes = Outcomes.certain(values[0], np.ones(9, dtype=bool))
    found = smaa2(outcomes, SIMPLEX, iterations=9000, generator=generator_of(8))
    weights = generator_of(8).standard_exponential((9000, 3))
    totals = weights / weights.sum(axis=1, keepdims=True) @ values[0].T
    place = (totals[:, :, None] < totals[:, None, :] - 1e-9).sum(axis=2)

    assert found.ranks == pytest.approx(np.array([(place == rank).mean(axis=0) for rank in range(9)]).T)


def test_admitted_weights_alone_are_drawn():
    ordered = WeightSet.cut(np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]), np.zeros(2))
    found = smaa2(
        Outcomes.certain(np.eye(3), np.ones(3, dtype=bool)), ordered, iterations=5000, generator=generator_of(9)
    )

    assert found.first == pytest.approx([1.0, 0.0, 0.0])
    assert found.central_weights[0] == pytest.approx(np.array([11, 5, 2]) / 18, abs=0.01)


def test_nothing_feasible_in_an_outcome():
    feasible = np.array([[True, True], [False, False]])
    outcomes = Outcomes(
        values=np.array([[[0.9], [0.1]], [[np.nan], [np.nan]]]),
        feasible=feasible,
        probabilities=np.array([0.75, 0.25]),
        exact=True,
    )
    found = smaa2(outcomes, WeightSet.simplex(1), iterations=20_000, generator=generator_of(10))

    assert found.first == pytest.approx([0.75, 0.0], abs=0.01)
    assert found.unranked == pytest.approx([0.25, 0.25], abs=0.01)
    assert found.confidence[0] == pytest.approx(0.75)


def test_the_same_seed_gives_the_same_indices(heparin_and_enoxaparin):
    first, second = (
        smaa2(heparin_and_enoxaparin, SIMPLEX, iterations=2000, generator=generator_of(11)) for _ in range(2)
    )

    assert (first.ranks == second.ranks).all()
    assert (first.central_weights == second.central_weights).all()


def test_an_unknown_value_of_what_can_be_chosen():
    with pytest.raises(TradeoffError, match="an alternative that can be chosen has a value that is not a number"):
        smaa2(
            Outcomes.certain(np.array([[np.nan, 0.1, 0.1]]), np.ones(1, dtype=bool)),
            SIMPLEX,
            iterations=10,
            generator=generator_of(0),
        )


def test_weights_of_another_number():
    with pytest.raises(TradeoffError, match=r"outcomes of the shape \(1, 1, 2\) do not fit 3 weights"):
        smaa2(
            Outcomes.certain(np.array([[0.1, 0.1]]), np.ones(1, dtype=bool)),
            SIMPLEX,
            iterations=10,
            generator=generator_of(0),
        )


def test_of_many_alternatives_the_first_ranks_are_those_of_all(monkeypatch):
    generator = generator_of(11)
    values = np.round(generator.random((260, 3)), 1)  # with many ties
    outcomes = Outcomes.certain(values, generator.random(260) < 0.8)
    every = smaa2(outcomes, SIMPLEX, iterations=400, generator=generator_of(3))
    monkeypatch.setattr(acceptability, "ALL_RANKS_TO", 100)
    monkeypatch.setattr(acceptability, "MOST_RANKS", 40)
    monkeypatch.setattr(acceptability, "_RANKS_AT_ONCE", 260 * 64)
    some = smaa2(outcomes, SIMPLEX, iterations=400, generator=generator_of(3))

    assert every.ranks.shape == (260, 260)
    assert some.ranks.shape == some.rank_errors.shape == (260, 40)
    assert np.array_equal(some.ranks, every.ranks[:, :40])
    assert np.array_equal(some.unranked, every.unranked)
    assert some.central_weights == pytest.approx(every.central_weights, rel=1e-12, nan_ok=True)
    assert np.array_equal(some.confidence, every.confidence, equal_nan=True)
