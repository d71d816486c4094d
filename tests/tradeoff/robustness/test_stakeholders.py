"""Agreement of stakeholders, against loops over alternatives and pairs."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness import stakeholder_agreement


@pytest.mark.parametrize("seed", range(5))
def test_against_loops(seed):
    generator = np.random.default_rng(seed)
    values = generator.integers(0, 5, (9, 3)) / 4.0
    feasible = generator.random(9) < 0.8
    feasible[0] = True
    people = [(name, generator.dirichlet(np.ones(3))) for name in ("x", "y", "z")]

    found = stakeholder_agreement(values, feasible, people, within=0.2)

    rows = [row for row in range(9) if feasible[row]]
    regrets = {}
    for name, weights in people:
        totals = {row: float(values[row] @ weights) for row in rows}
        best = max(totals.values())
        regrets[name] = {row: best - totals[row] for row in rows}
    for view in found.views:
        mine = regrets[view.name]
        assert view.best == tuple(row for row in rows if mine[row] <= 1e-9)
        assert view.accepted == tuple(row for row in rows if mine[row] <= 0.2 + 1e-9)
    worst = {row: max(regrets[name][row] for name, _ in people) for row in rows}
    least = min(worst.values())
    assert found.largest_regret == pytest.approx(least)
    assert found.compromise == tuple(row for row in rows if worst[row] <= least + 1e-9)
    assert found.accepted_by_all == tuple(row for row in rows if worst[row] <= 0.2 + 1e-9)
    for row in rows:
        score = np.mean(
            [
                sum(
                    1.0 if regrets[name][other] > regrets[name][row] + 1e-9 else 0.5
                    for other in rows
                    if other != row and regrets[name][other] >= regrets[name][row] - 1e-9
                )
                / (len(rows) - 1)
                for name, _ in people
            ]
        )
        assert found.borda[row] == pytest.approx(score)


def test_one_alternative_is_everybody_s_choice():
    found = stakeholder_agreement(np.array([[0.3]]), np.array([True]), [("x", np.array([1.0]))], within=0.0)

    assert found.compromise == found.accepted_by_all == (0,)
    assert found.borda[0] == 1.0
    assert found.most_regretful == ("x",)


def test_a_design_without_a_weighed_value_is_judged_by_the_others():
    values = np.array([[1.0, np.nan], [0.8, 0.2], [0.1, 0.9], [np.nan, np.nan]])
    feasible = np.array([True, True, True, False])
    people = [("x", np.array([1.0, 0.0])), ("y", np.array([0.5, 0.5])), ("z", np.array([0.0, 1.0]))]

    found = stakeholder_agreement(values, feasible, people, within=0.25)

    assert [view.best for view in found.views] == [(0,), (1, 2), (2,)]
    assert [view.unknown for view in found.views] == [(), (0,), (0,)]
    assert found.views[0].accepted == (0, 1)
    assert np.isnan(found.views[1].regrets[[0, 3]]).all()
    # Row 1: regrets 0.2, 0, 0.7; row 2: regrets 0.9, 0, 0.
    assert found.compromise == (1,)
    assert found.largest_regret == pytest.approx(0.7)
    assert found.most_regretful == ("z",)
    assert found.accepted_by_all == ()
    assert found.borda[1:3] == pytest.approx([0.5, 0.5])
    assert np.isnan(found.borda[[0, 3]]).all()


def test_without_a_design_that_all_can_judge_there_is_no_compromise():
    values = np.array([[1.0, np.nan], [np.nan, 0.2]])
    people = [("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))]

    found = stakeholder_agreement(values, np.array([True, True]), people, within=0.1)

    assert [view.best for view in found.views] == [(0,), (1,)]
    assert found.compromise == found.accepted_by_all == found.most_regretful == ()
    assert np.isnan(found.largest_regret)
    assert np.isnan(found.borda).all()


def test_errors():
    with pytest.raises(TradeoffError, match="no feasible alternative is known in every measure that 'x' weighs"):
        stakeholder_agreement(np.array([[np.nan]]), np.array([True]), [("x", np.array([1.0]))], within=0.0)
    values, one = np.array([[0.3]]), [("x", np.array([1.0]))]
    with pytest.raises(TradeoffError, match="no alternative is feasible"):
        stakeholder_agreement(values, np.array([False]), one, within=0.0)
    with pytest.raises(TradeoffError, match="no stakeholder is named"):
        stakeholder_agreement(values, np.array([True]), [], within=0.0)
    with pytest.raises(TradeoffError, match="the accepted distance must be at least 0, got -1"):
        stakeholder_agreement(values, np.array([True]), one, within=-1.0)
