"""Weights from pairwise answers, against closed forms, brute force and other solvers."""

from __future__ import annotations

import itertools
import math
import random

import numpy as np
import pytest
from scipy.optimize import linprog, minimize

from rgss.errors import TradeoffError
from rgss.tradeoff import RankRule, weights_from_ranks
from rgss.tradeoff.elicitation import FitMethod, PairwiseAnswer, contradiction_of, weights_from_answers
from rgss.tradeoff.elicitation.consistency import GREATEST_INDEX, RANDOM_INDEX, consistency_of
from rgss.tradeoff.elicitation.fitting import weight_extents

NAMES = ("a", "b", "c", "d", "e")


def ratio(one, other, value):
    return PairwiseAnswer(swing_of=one, over=other, least=value, most=value)


def at_least(one, other, value=1.0):
    return PairwiseAnswer(swing_of=one, over=other, least=value, most=math.inf)


def between(one, other, least, most):
    return PairwiseAnswer(swing_of=one, over=other, least=least, most=most)


def random_matrix(generator, size, spread=1.0):
    """All pairs of the first criteria, with errors around random weights."""
    logs = [generator.uniform(-1, 1) for _ in range(size)]
    return [
        ratio(NAMES[i], NAMES[j], math.exp(logs[i] - logs[j] + generator.gauss(0, spread)))
        for i, j in itertools.combinations(range(size), 2)
    ]


def is_feasible(size, answers):
    """Whether positive weights satisfy some answers: a linear program over logarithms, apart from the product."""
    rows, limits = [], []
    for one in answers:
        row = np.zeros(size)
        row[NAMES.index(one.swing_of)], row[NAMES.index(one.over)] = 1.0, -1.0
        rows.append(-row)
        limits.append(-math.log(one.least) + 1e-10)
        if math.isfinite(one.most):
            rows.append(row)
            limits.append(math.log(one.most) + 1e-10)
    return linprog(np.zeros(size), A_ub=rows, b_ub=limits, bounds=[(-50, 50)] * size).status == 0


@pytest.mark.parametrize("seed", range(6))
def test_a_complete_matrix_gives_the_geometric_means_of_its_rows(seed):
    generator = random.Random(seed)  # noqa: S311
    size = 3 + seed % 3
    answers = random_matrix(generator, size)
    matrix = np.ones((size, size))
    for one in answers:
        i, j = NAMES.index(one.swing_of), NAMES.index(one.over)
        matrix[i, j], matrix[j, i] = one.ratio, 1.0 / one.ratio
    means = np.exp(np.log(matrix).mean(axis=1))

    found = weights_from_answers(NAMES[:size], answers)

    assert found.method is FitMethod.LEAST_SQUARES
    assert list(found.weights.values()) == pytest.approx(means / means.sum(), rel=1e-9)
    errors = [math.log(matrix[i, j] * means[j] / means[i]) for i, j in itertools.combinations(range(size), 2)]
    assert found.consistency.index == pytest.approx(2.0 / ((size - 1) * (size - 2)) * sum(e * e for e in errors))
    largest = max(np.linalg.eigvals(matrix).real)
    assert found.consistency.ratio == pytest.approx((largest - size) / (size - 1) / RANDOM_INDEX[size])
    assert found.factor == pytest.approx(math.exp(max(map(abs, errors))))


def test_consistent_answers_are_met_exactly():
    found = weights_from_answers(("a", "b", "c"), [ratio("a", "b", 2), ratio("b", "c", 3), ratio("a", "c", 6)])

    assert found.weights == pytest.approx({"a": 0.6, "b": 0.3, "c": 0.1})
    assert found.low == pytest.approx(found.weights)
    assert found.high == pytest.approx(found.weights)
    assert found.consistency.ratio == pytest.approx(0.0, abs=1e-12)
    assert found.consistency.is_acceptable
    assert found.consistency.worst_triad.factor == pytest.approx(1.0)


@pytest.mark.parametrize("size", [3, 5])
def test_the_random_index_is_that_of_random_matrices(size):
    generator = np.random.default_rng(1)
    scale = np.array([*(1.0 / np.arange(9, 1, -1)), *np.arange(1, 10)])
    matrices = np.ones((3000, size, size))
    for i, j in itertools.combinations(range(size), 2):
        matrices[:, i, j] = generator.choice(scale, 3000)
        matrices[:, j, i] = 1.0 / matrices[:, i, j]
    index = (np.linalg.eigvals(matrices).real.max(axis=1) - size) / (size - 1)

    assert index.mean() == pytest.approx(RANDOM_INDEX[size], rel=0.05)


def test_the_limit_of_the_index_is_where_the_ratio_of_three_is_a_tenth():
    factor = next(f for f in np.linspace(1.0, 6.0, 5001) if _of_three(f).ratio >= 0.1)

    assert _of_three(factor).index == pytest.approx(GREATEST_INDEX[3], rel=0.01)
    assert _of_three(1.5).is_acceptable
    assert not _of_three(6.0).is_acceptable


def _of_three(factor):
    return consistency_of(("a", "b", "c"), [ratio("a", "b", 2), ratio("b", "c", 2), ratio("a", "c", 4 * factor)])


@pytest.mark.parametrize("seed", range(5))
def test_the_worst_triad_is_the_worst_of_all_and_each_of_its_mends_mends_it(seed):
    answers = random_matrix(random.Random(seed), 5)  # noqa: S311
    logs = {}
    for one in answers:
        logs[one.swing_of, one.over] = math.log(one.ratio)
        logs[one.over, one.swing_of] = -math.log(one.ratio)
    brute = max(abs(logs[i, j] + logs[j, k] + logs[k, i]) for i, j, k in itertools.combinations(NAMES, 3))

    triad = consistency_of(NAMES, answers).worst_triad

    assert math.log(triad.factor) == pytest.approx(brute)
    for place, mend in enumerate(triad.mends):
        mended = list(triad.answers)
        mended[place] = ratio(mended[place].swing_of, mended[place].over, mend)
        named = sorted({name for one in mended for name in (one.swing_of, one.over)})
        assert consistency_of(named, mended).worst_triad.factor == pytest.approx(1.0)


def test_an_answer_that_is_given_twice_is_part_of_triads_twice():
    answers = [ratio("a", "b", 2), ratio("a", "b", 8), ratio("b", "c", 2), ratio("a", "c", 4)]
    found = consistency_of(("a", "b", "c"), answers).worst_triad
    assert found.factor == pytest.approx(4.0)
    assert answers[1] in found.answers


def test_the_worst_answer_is_the_one_that_was_wrong():
    logs = dict(zip(NAMES, (0.0, -0.3, -0.7, -1.2, -1.5), strict=True))
    answers = [ratio(i, j, math.exp(logs[i] - logs[j])) for i, j in itertools.combinations(NAMES, 2)]
    answers[4] = ratio(answers[4].swing_of, answers[4].over, 5.0 * answers[4].ratio)

    worst = consistency_of(NAMES, answers).worst_answer

    assert worst.answer is answers[4]
    assert worst.implied == pytest.approx(answers[4].ratio / 5.0)


def test_without_a_check_there_is_no_index():
    found = consistency_of(NAMES[:3], [ratio("a", "b", 2), ratio("b", "c", 3)])

    assert found.checks == 0
    assert found.index is None
    assert found.is_acceptable is None
    assert found.worst_triad is None
    assert consistency_of(NAMES[:2], [at_least("a", "b")]) is None


def test_an_order_alone_gives_the_rank_order_centroid():
    names = NAMES[:4]
    found = weights_from_answers(names, [at_least(*pair) for pair in itertools.pairwise(names)])

    ranks = weights_from_ranks({name: rank for rank, name in enumerate(names, 1)}, RankRule.RANK_ORDER_CENTROID)
    assert found.method is FitMethod.CENTRE
    assert found.weights == pytest.approx(ranks)
    assert found.high == pytest.approx({"a": 1.0, "b": 1 / 2, "c": 1 / 3, "d": 1 / 4})
    assert found.low == pytest.approx({"a": 1 / 4, "b": 0.0, "c": 0.0, "d": 0.0})


def test_ratios_and_orders_that_do_not_connect_give_the_centre():
    """a = 2b and c = 3d with b >= c: one weight s of b is free, and the centroid is the middle of its range."""
    found = weights_from_answers(NAMES[:4], [ratio("a", "b", 2), ratio("c", "d", 3), at_least("b", "c")])

    low, high = 3 / 13, 1 / 3
    middle = (low + high) / 2
    assert found.weights == pytest.approx(
        {"a": 2 * middle, "b": middle, "c": (1 - 3 * middle) * 3 / 4, "d": (1 - 3 * middle) / 4}
    )
    assert (found.low["b"], found.high["b"]) == pytest.approx((low, high))


def test_ratios_that_disagree_and_do_not_connect_are_missed_by_the_least_factor():
    answers = [ratio("a", "b", 2), ratio("b", "c", 2), ratio("a", "c", 8), at_least("d", "c")]
    found = weights_from_answers(NAMES[:4], answers)

    assert found.method is FitMethod.CENTRE
    assert found.factor == pytest.approx(2 ** (1 / 3))
    assert found.weights["d"] >= found.weights["c"]


@pytest.mark.parametrize("seed", range(6))
def test_bounds_hold_and_the_fit_is_the_best_within_them(seed):
    generator = random.Random(seed)  # noqa: S311
    answers = [*random_matrix(generator, 4), at_least("d", "a"), between("b", "c", 0.9, 1.1)]
    found = weights_from_answers(NAMES[:4], answers)

    weights = np.array(list(found.weights.values()))
    assert weights[3] >= weights[0] * (1 - 1e-9)
    assert 0.9 * (1 - 1e-9) <= weights[1] / weights[2] <= 1.1 * (1 + 1e-9)
    measured = [one for one in answers if math.isfinite(one.most)]

    def missed(logs):
        return sum(
            (logs[NAMES.index(one.swing_of)] - logs[NAMES.index(one.over)] - math.log(one.ratio)) ** 2
            for one in measured
        )

    other = minimize(
        missed,
        np.log(weights),
        method="SLSQP",
        constraints=[
            {"type": "ineq", "fun": lambda u: u[3] - u[0]},
            {"type": "ineq", "fun": lambda u: u[1] - u[2] - math.log(0.9)},
            {"type": "ineq", "fun": lambda u: math.log(1.1) - u[1] + u[2]},
        ],
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert missed(np.log(weights)) <= other.fun + 1e-6


@pytest.mark.parametrize("seed", range(5))
def test_extents_are_those_of_linear_programs(seed):
    generator = random.Random(seed)  # noqa: S311
    logs = [generator.uniform(-1, 1) for _ in NAMES]
    answers = []
    for i, j in itertools.combinations(range(5), 2):
        true = math.exp(logs[i] - logs[j])
        if generator.random() < 0.6:
            answers.append(
                between(NAMES[i], NAMES[j], true * generator.uniform(0.5, 1), true * generator.uniform(1, 2))
            )
    answers.append(at_least("a", "b", 0.1))
    low, high = weight_extents(NAMES, answers, 1.0)
    rows = []
    for one in answers:
        row = np.zeros(5)
        row[NAMES.index(one.over)], row[NAMES.index(one.swing_of)] = one.least, -1.0
        rows.append(row)
        if math.isfinite(one.most):
            row = np.zeros(5)
            row[NAMES.index(one.over)], row[NAMES.index(one.swing_of)] = -one.most, 1.0
            rows.append(row)
    for place in range(5):
        for sign, end in ((1.0, low), (-1.0, high)):
            cost = np.zeros(5)
            cost[place] = sign
            best = linprog(cost, A_ub=rows, b_ub=np.zeros(len(rows)), A_eq=np.ones((1, 5)), b_eq=[1.0])
            assert end[place] == pytest.approx(sign * best.fun, abs=1e-8)


@pytest.mark.parametrize("seed", range(12))
def test_a_contradiction_is_minimal_and_found_wherever_there_is_one(seed):
    generator = random.Random(seed)  # noqa: S311
    answers = []
    while len(answers) < 6:
        one, other = generator.sample(NAMES, 2)
        least = generator.choice([0.5, 0.8, 1.0, 1.3, 2.0])
        answers.append(generator.choice([at_least(one, other, least), between(one, other, least, least * 1.5)]))

    found = contradiction_of(NAMES, answers)

    assert (found is None) == is_feasible(5, answers)
    if found is not None:
        assert not is_feasible(5, found.answers)
        for left_out in range(len(found.answers)):
            assert is_feasible(5, [one for place, one in enumerate(found.answers) if place != left_out])
        fewest = next(
            size
            for size in range(1, len(answers) + 1)
            if any(not is_feasible(5, some) for some in itertools.combinations(answers, size))
        )
        assert len(found.answers) == fewest
        assert found.factor > 1.0


def test_errors():
    with pytest.raises(TradeoffError, match="'a' is compared with itself"):
        ratio("a", "a", 2)
    for least, most in ((0.0, 1.0), (2.0, 1.0), (math.nan, 1.0), (math.inf, math.inf)):
        with pytest.raises(TradeoffError, match="the ratio of 'a' and 'b' cannot lie between"):
            between("a", "b", least, most)
    with pytest.raises(TradeoffError, match="no answer names 'c'"):
        weights_from_answers(NAMES[:3], [ratio("a", "b", 2)])
    with pytest.raises(TradeoffError, match=r"a ≥ 2 × b, b ≥ a cannot hold together: .* product is 2, above 1"):
        weights_from_answers(NAMES[:2], [at_least("a", "b", 2), at_least("b", "a")])


def test_the_digest_is_of_the_answers():
    one = weights_from_answers(NAMES[:2], [ratio("a", "b", 2)])
    same = weights_from_answers(NAMES[:2], [ratio("a", "b", 2.0)])
    other = weights_from_answers(NAMES[:2], [ratio("a", "b", 2.5)])

    assert one.digest == same.digest != other.digest
