"""The bound and the search for the best worst task of a portfolio."""

from __future__ import annotations

import itertools
import time

import numpy as np
import pytest

import rgss.tradeoff.milp.linear
import rgss.tradeoff.portfolio.cover_bound
import rgss.tradeoff.portfolio.worst
from rgss.errors import TradeoffError
from rgss.tradeoff.portfolio.cover_bound import CoverBound, masks_of
from rgss.tradeoff.portfolio.cover_search import raised
from rgss.tradeoff.portfolio.primal import profits_of, search_portfolio
from rgss.tradeoff.portfolio.work import Cut, WorkBudget
from rgss.tradeoff.portfolio.worst import best_worst, worst_of


def excluded(reached, size):
    bound, everything = CoverBound.of(reached), np.ones(reached.shape[1])
    return bound.excludes(bound.shares(reached, everything), everything, size)


def can_cover(reached, size):
    return any(reached[list(rows)].any(axis=0).all() for rows in itertools.combinations(range(len(reached)), size))


def rubbish(*_arguments):
    return np.random.default_rng(0).normal(size=7) * 3.0


def no_answer(*_arguments):
    raise TradeoffError("a linear program ended without an optimum", hint="")


@pytest.mark.parametrize("answer", [None, rubbish, no_answer])
def test_the_bound_never_excludes_a_cover(monkeypatch, answer):
    """Whatever the linear program answers, for its weights are only added up."""
    if answer is not None:
        monkeypatch.setattr(rgss.tradeoff.milp.linear, "solve_linear", answer)
    outcomes = set()
    for seed in range(60):
        reached = (np.random.default_rng(seed).random((9, 7)) < 0.4).astype(float)
        for size in (1, 2, 3):
            outcomes.add((excluded(reached, size), can_cover(reached, size)))
    assert (True, True) not in outcomes
    assert (True, False) in outcomes


def test_the_dual_weights_exclude_what_counting_does_not():
    """Two members count for six of the six tasks, yet three tasks share no member."""
    reached = np.array([[1, 0, 0, 1, 1, 1], [0, 1, 0, 1, 1, 0], [0, 0, 1, 1, 0, 1]], dtype=float)
    assert not can_cover(reached, 2)
    equal = CoverBound(np.ones((1, 6)))
    everything = np.ones(6)
    assert not equal.excludes(equal.shares(reached, everything), everything, 2)
    assert excluded(reached, 2)


def test_a_large_problem_is_bounded_without_a_linear_program(monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.portfolio.cover_bound, "LARGEST_PROGRAM", 11)
    assert CoverBound.of(np.eye(4)[:, :3]).weights.tolist() == [[1.0, 1.0, 1.0]]
    assert len(CoverBound.of(np.eye(4)[:2, :3] + 1.0).weights) == 2


def test_the_tasks_of_a_member_as_bits():
    assert list(masks_of(np.array([[True, False, True], [False, False, False]]))) == [5, 0]


@pytest.mark.parametrize("seed", range(10))
def test_the_search_never_loses_what_it_started_from(seed):
    draw = np.random.default_rng(seed)
    values = np.where(draw.random((30, 12)) < 0.3, -1.0, draw.random((30, 12)))
    start = tuple(int(row) for row in draw.choice(30, 3, replace=False))
    for most in (1, 1_000, 10**7):
        rows = raised(values, 4, start, WorkBudget(most))
        assert len(set(rows)) <= 4
        assert worst_of(values, rows) >= worst_of(values, start)
    best = max(float(values[list(one)].max(axis=0).min()) for one in itertools.combinations(range(30), 4))
    assert worst_of(values, raised(values, 4, (), WorkBudget(10**8))) == pytest.approx(best)


def test_the_search_finds_what_exchanges_of_the_mean_do_not():
    values = np.random.default_rng(1).random((200, 60))
    start = search_portfolio(profits_of(values, np.full(60, 1.0 / 60.0)), 8, ())
    assert worst_of(values, raised(values, 8, start, WorkBudget(10**8))) > worst_of(values, start) + 0.05


def test_no_cover_is_looked_for_once_the_time_is_over(monkeypatch):
    def none_is_made(*_arguments, **_more):
        raise AssertionError("a search was begun")

    monkeypatch.setattr(rgss.tradeoff.portfolio.worst, "_CoverSearch", none_is_made)
    work = WorkBudget(None, time.monotonic() - 1.0)
    values = np.random.default_rng(2).random((40, 20))
    answer = best_worst(values, 4, (0, 1, 2, 3), 1e-9, work)
    assert work.cut is Cut.TIME
    assert answer.objective == worst_of(values, (0, 1, 2, 3))
    assert answer.bound == float(values.max(axis=0).min())
