"""Nearest changes of the choice on either side of a limit."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.decision.robustness.pricing import requirement_prices
from rgss.decision.study_decision.limit_moves import limit_moves
from rgss.requirements import Comparison
from rgss.tradeoff import Alternative, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem import tabulated


@pytest.fixture
def found():
    """Variants 1 and 2 are worth 0.8, 3 is worth 0.5 and 4 is worth 1, by energies of 60, 70, 50 and 110 J."""
    problem = TradeProblem(
        alternatives=tuple(
            Alternative(variant=variant, measures={"v": value, "E": energy})
            for variant, value, energy in ((1, 0.8, 60.0), (2, 0.8, 70.0), (3, 0.5, 50.0), (4, 1.0, 110.0))
        ),
        thresholds=(Threshold(requirement="R-1", measure="E", unit="J", comparison=Comparison.AT_MOST, value=100.0),),
        value_functions=(PiecewiseValue(measure="v", worst=0.0, best=1.0),),
        weighting=Weighting(weights={"v": 1.0}),
    )
    return SimpleNamespace(variants=(1, 2, 3, 4), prices=requirement_prices(problem, tabulated(problem.alternatives)))


@pytest.mark.parametrize(("chosen", "limit"), [(1, 60.0), (2, 70.0)])
def test_a_limit_that_excludes_a_tied_rival_alone_does_not_change_the_choice(found, chosen, limit):
    """Below 70 J only variant 1 of the two remains, which is a change for variant 2 alone."""
    (moves,) = limit_moves(found, chosen=chosen)
    assert moves.tighter.limit == pytest.approx(limit)
    assert moves.tighter.winners == ((3,) if chosen == 1 else (1,))
    assert (moves.looser.limit, moves.looser.winners) == (pytest.approx(110.0), (4,))


def test_without_a_choice_every_change_of_the_best_counts(found):
    (moves,) = limit_moves(found, chosen=None)
    assert (moves.tighter.limit, moves.tighter.winners) == (pytest.approx(70.0), (1,))
