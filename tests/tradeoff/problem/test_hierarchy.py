from __future__ import annotations

import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import CriterionNode, weighting_of, weights_of_criteria


def leaf(name, weight):
    return CriterionNode(name=name, weight=weight)


TIME = CriterionNode(name="time", weight=0.6, members=(leaf("t_e", 0.75), leaf("t_p", 0.25)))
WHOLE = (CriterionNode(name="performance", weight=0.8, members=(TIME, leaf("P_max", 0.4))), leaf("cost", 0.2))


def test_weights_multiply_on_the_way_down():
    assert dict(weighting_of(WHOLE).weights) == pytest.approx({"t_e": 0.36, "t_p": 0.12, "P_max": 0.32, "cost": 0.2})
    assert dict(weights_of_criteria(WHOLE)) == pytest.approx({"performance": 0.8, "time": 0.48})
    assert WHOLE[0].measures == ("t_e", "t_p", "P_max")


@pytest.mark.parametrize(
    ("nodes", "message"),
    [
        ((leaf("a", 0.5), leaf("b", 0.4)), "weights must sum to 1, got 0.9"),
        (
            (CriterionNode(name="time", weight=1.0, members=(leaf("a", 0.5), leaf("b", 0.6))),),
            "in 'time': weights must sum to 1, got 1.1",
        ),
        ((leaf("a", 0.5), leaf("a", 0.5)), "'a' occurs twice among the criteria"),
        (
            (CriterionNode(name="a", weight=0.5, members=(leaf("b", 1.0),)), leaf("b", 0.5)),
            "'b' occurs twice among the criteria",
        ),
    ],
)
def test_groups_that_do_not_add_up(nodes, message):
    with pytest.raises(TradeoffError) as error:
        weighting_of(nodes)
    assert error.value.message == message
    assert error.value.hint
