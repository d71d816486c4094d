"""Portfolios by hand; tests/tradeoff/test_agreement.py holds random ones against trying each."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

import rgss.tradeoff.fleet
from rgss.errors import TradeoffError
from rgss.tradeoff import (
    AdditiveValue,
    DecisionStatus,
    FleetAim,
    FleetProblem,
    FleetTask,
    Tchebycheff,
    decide_fleet,
    fleet_to_json,
)


@pytest.fixture
def fleet(build_problem):
    """A fleet problem from the values of each design in each task; what is below 0 is infeasible."""

    def build(table, *, weights=None, program=None, **more):
        count = len(next(iter(table.values())))
        weights = weights or [1.0 / count] * count
        tasks = tuple(
            FleetTask(
                name=f"t{task}",
                weight=weights[task],
                problem=build_problem(
                    {variant: {"a": row[task]} for variant, row in table.items()},
                    thresholds=[("R", "a", ">=", 0.0)],
                    program=program or AdditiveValue(),
                ),
            )
            for task in range(count)
        )
        return FleetProblem(tasks=tasks, **({"at_most": 1} | more))

    return build


TABLE = {1: (0.6, 0.6, 0.6), 2: (1.0, 0.1, 0.0), 3: (0.2, 1.0, 0.9), 4: (0.1, 0.9, 0.2)}


@pytest.mark.parametrize(
    ("at_most", "aim", "members", "objective"),
    [
        (1, FleetAim.MEAN, ("3",), 0.7),
        (2, FleetAim.MEAN, ("2", "3"), 2.9 / 3),
        (3, FleetAim.MEAN, ("2", "3"), 2.9 / 3),
        (1, FleetAim.WORST, ("1",), 0.6),
        (2, FleetAim.WORST, ("2", "3"), 0.9),
    ],
)
def test_by_hand(fleet, at_most, aim, members, objective):
    decision = decide_fleet(fleet(TABLE, at_most=at_most, aim=aim))
    assert decision.status is DecisionStatus.OPTIMAL
    assert decision.members == members
    assert decision.objective == pytest.approx(objective)
    assert decision.objective_recomputed == pytest.approx(objective)
    assert decision.gap == pytest.approx(0.0, abs=1e-9)
    assert decision.enumeration_agrees
    # The fourth is nowhere better than the third.
    assert decision.considered == 3


def test_what_another_member_would_add(fleet):
    decision = decide_fleet(fleet(TABLE, at_most=4))
    assert decision.by_size == pytest.approx((0.7, 2.9 / 3, 2.9 / 3, 2.9 / 3))


def test_who_serves_what(fleet):
    decision = decide_fleet(fleet(TABLE, at_most=2))
    assert [(one.task, one.variant, one.value) for one in decision.assignments] == [
        ("t0", 2, 1.0),
        ("t1", 3, 1.0),
        ("t2", 3, 0.9),
    ]


def test_weights_of_the_tasks(fleet):
    assert decide_fleet(fleet(TABLE, weights=[0.8, 0.1, 0.1])).members == ("2",)


def test_one_gripper_for_many_objects(fleet):
    """A member is a gripper; for each object its best variant serves."""
    table = {1: (0.9, -1.0), 2: (-1.0, 0.8), 3: (0.7, 0.7), 4: (0.6, 0.95)}
    grippers = {1: "wide", 2: "wide", 3: "narrow", 4: "narrow"}
    decision = decide_fleet(fleet(table, groups=grippers))
    assert decision.members == ("wide",)
    assert [one.variant for one in decision.assignments] == [1, 2]
    assert decision.objective == pytest.approx(0.85)
    assert decide_fleet(fleet(table)).members == ("4",)


def test_too_few_members_to_serve_every_task(fleet):
    table = {1: (0.9, -1.0), 2: (-1.0, 0.8)}
    decision = decide_fleet(fleet(table))
    assert (decision.status, decision.members, decision.objective) == (DecisionStatus.INFEASIBLE, (), None)
    assert (decision.by_size, decision.unserved, decision.enumeration_agrees) == ((None,), (), True)
    assert decide_fleet(fleet(table, at_most=2)).by_size == (None, pytest.approx(0.85))


def test_a_task_that_no_design_serves(fleet):
    decision = decide_fleet(fleet({1: (0.9, -1.0), 2: (0.5, -0.1)}, at_most=2))
    assert (decision.status, decision.unserved) == (DecisionStatus.INFEASIBLE, ("t1",))


def test_more_portfolios_than_are_enumerated(fleet, monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.fleet, "MOST_ENTRIES", 2)
    decision = decide_fleet(fleet(TABLE, at_most=3))
    assert (set(decision.members), decision.enumeration_agrees) == ({"2", "3"}, None)
    assert decision.objective == pytest.approx(2.9 / 3)


@pytest.mark.parametrize("answer", [None, ((0,), 0.2, 0.0)])
def test_no_decision_on_contradictory_answers(fleet, monkeypatch, answer):
    monkeypatch.setattr(rgss.tradeoff.fleet, "_solved", lambda *arguments: answer)
    with pytest.raises(TradeoffError, match=r"the solver finds .*, enumeration finds 0\.7"):
        decide_fleet(fleet(TABLE))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tasks": ()}, "a fleet without tasks has nothing to do"),
        ({"at_most": 0}, "a fleet of at most 0 designs serves no task"),
        ({"groups": {1: "x"}}, "variant 2 belongs to no group"),
    ],
)
def test_ill_posed(fleet, change, message):
    with pytest.raises(TradeoffError) as error:
        dataclasses.replace(fleet(TABLE), **change)
    assert error.value.message == message
    assert error.value.hint


def test_tasks_that_do_not_fit(fleet):
    whole = fleet(TABLE)
    fewer = fleet({1: (0.5,)}, weights=[1.0]).tasks[0]
    for tasks, message in (
        ((whole.tasks[0], whole.tasks[0]), "task 't0' is given twice"),
        ((dataclasses.replace(whole.tasks[0], weight=0.4),), "the weights sum to 0.4, not to 1"),
        (
            (dataclasses.replace(whole.tasks[0], weight=0.5), dataclasses.replace(fewer, name="t1", weight=0.5)),
            "variant 2 is not among the alternatives of every task",
        ),
    ):
        with pytest.raises(TradeoffError) as error:
            FleetProblem(tasks=tasks, at_most=1)
        assert error.value.message == message
    with pytest.raises(TradeoffError, match="task 't0' is decided by the tchebycheff program"):
        fleet(TABLE, program=Tchebycheff())


def test_an_answer_that_selects_half_a_member_is_refused(fleet, monkeypatch):
    def half(problem):
        for variable in problem.variables():
            variable.save_value(np.full(variable.shape, 0.5))
        return True

    monkeypatch.setattr(rgss.tradeoff.fleet, "solve_program", half)
    with pytest.raises(TradeoffError, match=r"the solver's answer selects no fleet \(off by 0\.5\)"):
        decide_fleet(fleet(TABLE))


def test_as_plain_values(fleet):
    document = json.loads(json.dumps(fleet_to_json(decide_fleet(fleet(TABLE, at_most=2))), allow_nan=False))
    assert document["members"] == ["2", "3"]
    assert document["assignments"][0] == {"task": "t0", "member": "2", "variant": 2, "value": 1.0}
    assert document["certificate"]["enumeration_agrees"] is True
    nothing = fleet_to_json(decide_fleet(fleet({1: (-1.0,)})))
    assert (nothing["status"], nothing["objective"], nothing["unserved"]) == ("infeasible", None, ["t0"])
