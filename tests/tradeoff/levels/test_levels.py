"""The mixed-integer form over levels: tables, rules, sums that are too long to list."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np
import pytest

import rgss.tradeoff.levels.problem
import rgss.tradeoff.levels.selection
from rgss.errors import TradeoffError
from rgss.tradeoff import (
    AdditiveValue,
    Agreement,
    Aim,
    Alternative,
    Comparison,
    DecisionStatus,
    EpsilonConstraint,
    ExponentialValue,
    Incompatibility,
    LevelFactor,
    LevelProblem,
    LevelSpace,
    LevelStructure,
    LevelTable,
    Lexicographic,
    MinimaxRegret,
    PiecewiseValue,
    Scenarios,
    TargetValue,
    Tchebycheff,
    Threshold,
    Weighting,
    decide,
    decide_levels,
    smallest_table,
)
from rgss.tradeoff.levels.selection import LevelModel, LevelSelection
from rgss.tradeoff.milp.terms import WeightedValue

ARM, HAND, PLANNER = (
    LevelFactor(id="arm", levels=("slow", "fast")),
    LevelFactor(id="hand", levels=("two", "three")),
    LevelFactor(id="planner", levels=("rrt", "stride", "best")),
)
NO_FAST_THREE = Incompatibility(id="torque", factors=("hand", "arm"), combinations=frozenset({("three", "fast")}))


def by_hand(**changes):
    """Cost is a sum over arm, hand and planner; payload depends on the hand; time on arm and planner.

    With equal weights the values of the designs are, cost + payload + time over three:
        slow two   rrt 0.9 0.2 0.2 | stride 0.8 0.2 0.3 | best 0.5 0.2 0.4
        slow three rrt 0.7 0.9 0.2 | stride 0.6 0.9 0.3 | best 0.3 0.9 0.4
        fast two   rrt 0.5 0.2 0.7 | stride 0.4 0.2 0.8 | best 0.1 0.2 1.0
    """
    arguments = {
        "space": LevelSpace(factors=(ARM, HAND, PLANNER), rules=(NO_FAST_THREE,)),
        "tables": {
            "cost": (
                LevelTable(factors=("arm",), entries={("slow",): 0.0, ("fast",): 4.0}),
                LevelTable(factors=("hand",), entries={("two",): 1.0, ("three",): 3.0}),
                LevelTable(factors=("planner",), entries={("rrt",): 0.0, ("stride",): 1.0, ("best",): 4.0}),
            ),
            "payload": (LevelTable(factors=("hand",), entries={("two",): 2.0, ("three",): 9.0}),),
            "time": (
                LevelTable(
                    factors=("arm", "planner"),
                    entries={
                        ("slow", "rrt"): 8.0,
                        ("slow", "stride"): 7.0,
                        ("slow", "best"): 6.0,
                        ("fast", "rrt"): 3.0,
                        ("fast", "stride"): 2.0,
                        ("fast", "best"): 0.0,
                    },
                ),
            ),
        },
        "thresholds": (),
        "value_functions": (
            PiecewiseValue(measure="cost", worst=10.0, best=0.0),
            PiecewiseValue(measure="payload", worst=0.0, best=10.0),
            PiecewiseValue(measure="time", worst=10.0, best=0.0),
        ),
        "weighting": Weighting(weights={"cost": 1 / 3, "payload": 1 / 3, "time": 1 / 3}),
    }
    return LevelProblem(**(arguments | changes))


def threshold(measure, sense, value):
    return Threshold(requirement=f"R-{measure}", measure=measure, comparison=Comparison(sense), value=value, unit="1")


def test_by_hand():
    decision = decide_levels(by_hand())
    assert decision.status is DecisionStatus.OPTIMAL
    # 0.7 + 0.9 + 0.2 and 0.6 + 0.9 + 0.3 are tied.
    assert decision.levels["arm"] == "slow"
    assert decision.levels["hand"] == "three"
    assert decision.levels["planner"] in ("rrt", "stride")
    assert decision.certificate.objective == pytest.approx(0.6)
    assert (decision.combinations, decision.enumerated) == (12, True)
    assert decision.certificate.enumeration_agrees is Agreement.AGREED


@pytest.mark.parametrize(
    ("thresholds", "levels"),
    [
        ((threshold("time", "<=", 3.0), threshold("cost", "<=", 5.0)), ("fast", "two", "rrt")),
        ((threshold("time", "<=", 1.0),), ("fast", "two", "best")),
        # A fast arm cannot have three fingers.
        ((threshold("time", "<=", 3.0), threshold("payload", ">=", 5.0)), None),
    ],
)
def test_demands(thresholds, levels):
    decision = decide_levels(by_hand(thresholds=thresholds))
    assert tuple(decision.levels.values()) == (levels or ())
    assert decision.status is (DecisionStatus.OPTIMAL if levels else DecisionStatus.INFEASIBLE)
    assert decision.variant is None or by_hand().levels_of(decision.variant) == levels


def test_designs_are_numbered_as_variants_are():
    problem = by_hand()
    for number, levels in problem.space.combinations():
        assert problem.alternative(levels).variant == number
        assert problem.levels_of(number) == levels
    assert problem.alternative(("slow", "three", "best")).measures == {"cost": 7.0, "payload": 9.0, "time": 6.0}
    assert [one.variant for one in problem.enumerated().alternatives] == [1, 2, 3, 4, 5, 6, 7, 8, 9]


PROGRAMS = [
    AdditiveValue(),
    Lexicographic(
        aims=(
            Aim(measure="time", sense=Comparison.AT_MOST, absolute=3.0),
            Aim(measure="cost", sense=Comparison.AT_MOST),
        )
    ),
    EpsilonConstraint(
        aim=Aim(measure="payload", sense=Comparison.AT_LEAST),
        bounds=(
            Threshold(requirement="limit:cost", measure="cost", comparison=Comparison.AT_MOST, value=4.0, unit="1"),
        ),
    ),
    Tchebycheff(),
    MinimaxRegret(),
]


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
@pytest.mark.parametrize("listed", [True, False], ids=["tables merged", "sums kept"])
def test_every_program_agrees_with_the_choice_among_variants(monkeypatch, program, listed):
    if not listed:
        monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", 3)
    for functions in (
        by_hand().value_functions,
        # The cost is cut at both ends and bent in between; the time has a target.
        (
            PiecewiseValue(measure="cost", worst=6.0, best=2.0, interior=((5.0, 0.1), (4.0, 0.9))),
            PiecewiseValue(measure="payload", worst=0.0, best=10.0),
            TargetValue(measure="time", target=6.0, too_low=1.0, too_high=8.0),
        ),
    ):
        problem = by_hand(program=program, value_functions=functions)
        decision, others = decide_levels(problem), decide(problem.enumerated())
        assert decision.variant in others.ties
        assert decision.certificate.objective == pytest.approx(others.certificate.objective, abs=1e-9)


def test_more_combinations_than_can_be_listed_against_all_of_them_in_numpy(monkeypatch):
    """Six factors of four levels; the answer is held against all 4,096 only here, not by the product."""
    monkeypatch.setattr(rgss.tradeoff.levels.problem, "LARGEST_ENUMERATED", 100)
    monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", 100)
    rng = np.random.default_rng(5)
    factors = tuple(LevelFactor(id=f"f{place}", levels=tuple("abcd")) for place in range(6))
    costs = rng.random((6, 4))
    gains = rng.random((3, 4, 4))
    problem = LevelProblem(
        space=LevelSpace(factors=factors),
        tables={
            "cost": tuple(
                LevelTable(
                    factors=(factor.id,), entries={(level,): float(c) for level, c in zip("abcd", row, strict=True)}
                )
                for factor, row in zip(factors, costs, strict=True)
            ),
            "gain": tuple(
                LevelTable(
                    factors=(factors[2 * place].id, factors[2 * place + 1].id),
                    entries={
                        (one, other): float(gains[place, i, j])
                        for (i, one), (j, other) in itertools.product(enumerate("abcd"), repeat=2)
                    },
                )
                for place in range(3)
            ),
        },
        thresholds=(threshold("cost", "<=", 3.0),),
        value_functions=(
            PiecewiseValue(measure="cost", worst=4.0, best=1.0, interior=((2.0, 0.8),)),
            PiecewiseValue(measure="gain", worst=0.5, best=2.5),
        ),
        weighting=Weighting(weights={"cost": 0.5, "gain": 0.5}),
    )
    decision = decide_levels(problem)
    places = np.array(list(itertools.product(range(4), repeat=6)))
    cost = costs[np.arange(6), places].sum(axis=1)
    gain = sum(gains[place, places[:, 2 * place], places[:, 2 * place + 1]] for place in range(3))
    value = 0.5 * np.interp(cost, [1.0, 2.0, 4.0], [1.0, 0.8, 0.0]) + 0.5 * np.clip((gain - 0.5) / 2.0, 0.0, 1.0)
    best = np.where(cost <= 3.0, value, -1.0).max()
    assert decision.certificate.objective == pytest.approx(best, abs=1e-9)
    assert (decision.combinations, decision.enumerated) == (4096, False)
    assert decision.certificate.enumeration_agrees is Agreement.NOT_ENUMERATED
    assert decision.certificate.objective_recomputed == pytest.approx(best, abs=1e-9)
    assert decision.certificate.stages[-1].gap == pytest.approx(0.0, abs=1e-9)
    infeasible = dataclasses.replace(problem, thresholds=(threshold("cost", "<=", -1.0),))
    assert decide_levels(infeasible).status is DecisionStatus.INFEASIBLE


def test_what_is_unknown_is_never_selected(monkeypatch):
    tables = dict(by_hand().tables)
    tables["cost"] = (
        *tables["cost"][:1],
        LevelTable(factors=("hand",), entries={("two",): 1.0, ("three",): None}),
        *tables["cost"][2:],
    )
    for largest in (20_000, 3):
        monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", largest)
        assert decide_levels(by_hand(tables=tables)).levels["hand"] == "two"


def test_the_smallest_table_leaves_out_what_decides_nothing():
    entries = {levels: 10 * (levels[1] == "x") for levels in itertools.product("ab", "xy", "pq")}
    table = smallest_table(("f", "g", "h"), entries)
    assert (table.factors, dict(table.entries)) == (("g",), {("x",): 10, ("y",): 0})
    constant = smallest_table(("f", "g"), dict.fromkeys(itertools.product("ab", "xy"), 3.0))
    assert (constant.factors, dict(constant.entries)) == ((), {(): 3.0})


@pytest.fixture
def structured(build_problem):
    """Four designs of two factors, one of which a rule excludes."""

    def build(levels, rules=(), **more):
        factors = (LevelFactor(id="f", levels=("a", "b")), LevelFactor(id="g", levels=("x", "y")))
        return build_problem(
            {variant: {"a": float(variant)} for variant in levels},
            levels=LevelStructure(space=LevelSpace(factors=factors, rules=rules), levels=levels),
            **more,
        )

    return build


def test_a_structure_that_does_not_fit(structured):
    whole = {1: ("a", "x"), 2: ("a", "y"), 3: ("b", "x"), 4: ("b", "y")}
    rule = Incompatibility(id="r", factors=("g", "f"), combinations=frozenset({("y", "b")}))
    assert decide(structured(whole)).chosen == 4
    assert decide(structured({key: whole[key] for key in (1, 2, 3)}, rules=(rule,))).chosen == 3
    for levels, rules, message in (
        (whole, (rule,), "variant 4 must be a combination of levels that the rules allow"),
        ({**whole, 4: ("b", "z")}, (), "variant 4 must be a combination of levels that the rules allow"),
        ({**whole, 4: ("b", "x")}, (), "variants 3 and 4 have the same levels"),
        ({key: whole[key] for key in (1, 2, 3)}, (), "the combination b, y has no alternative"),
    ):
        with pytest.raises(TradeoffError) as error:
            structured(levels, rules)
        assert error.value.message == message
        assert error.value.hint


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: LevelFactor(id="f", levels=()), "factor 'f' has no levels, or one twice"),
        (lambda: LevelFactor(id="f", levels=("a", "a")), "factor 'f' has no levels, or one twice"),
        (lambda: LevelSpace(factors=()), "there are no factors, or one is given twice"),
        (lambda: LevelSpace(factors=(ARM, ARM)), "there are no factors, or one is given twice"),
        (lambda: LevelSpace(factors=(ARM,), rules=(NO_FAST_THREE,)), "rule 'torque' names the unknown factor 'hand'"),
        (
            lambda: by_hand(
                weighting=Weighting(weights={"z": 1.0}), value_functions=(PiecewiseValue(measure="z", worst=0, best=1),)
            ),
            "the weights name the unknown measure 'z'",
        ),
        (
            lambda: by_hand(tables={**by_hand().tables, "x": (LevelTable(factors=("z",), entries={}),)}),
            "a table of 'x' names the unknown factor 'z'",
        ),
        (
            lambda: by_hand(
                tables={**by_hand().tables, "x": (LevelTable(factors=("arm",), entries={("slow",): 1.0}),)}
            ),
            "a table of 'x' lacks the combination fast",
        ),
        (
            lambda: by_hand(
                tables={
                    **by_hand().tables,
                    "x": (LevelTable(factors=("arm",), entries={("slow",): 1.0, ("fast",): math.inf}),),
                }
            ),
            "'x' at fast must be finite or None, got inf",
        ),
        (
            lambda: by_hand(program=MinimaxRegret(scenarios=Scenarios.REPLICATES)),
            "levels that are chosen by tables have no replicates",
        ),
        (
            lambda: decide_levels(
                by_hand(
                    space=LevelSpace(
                        factors=(ARM, HAND, PLANNER),
                        rules=(
                            Incompatibility(id="all", factors=("arm",), combinations=frozenset({("slow",), ("fast",)})),
                        ),
                    )
                )
            ),
            "the rules leave no combination of levels",
        ),
    ],
)
def test_ill_posed(make, message):
    with pytest.raises(TradeoffError) as error:
        make()
    assert error.value.message == message
    assert error.value.hint


def curved():
    functions = (ExponentialValue(measure="cost", worst=10.0, best=0.0, halfway=3.0), *by_hand().value_functions[1:])
    return by_hand(value_functions=functions)


def test_a_sum_cannot_be_valued_by_a_curve(monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_CURVED", 3)
    with pytest.raises(TradeoffError, match="'cost' is a sum over too many levels for a value that is not piecewise"):
        decide_levels(curved())


def test_a_measure_that_is_valued_by_a_curve_is_merged_beyond_the_others(monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", 3)
    decision, others = decide_levels(curved()), decide(curved().enumerated())
    assert decision.variant in others.ties
    assert decision.certificate.objective == pytest.approx(others.certificate.objective, abs=1e-9)


def test_terms_share_the_variables_of_a_sum(monkeypatch):
    """However many scenarios value a measure, its segments are modelled once."""
    monkeypatch.setattr(rgss.tradeoff.levels.selection, "LARGEST_TABLE", 3)
    problem = by_hand()
    selection = LevelSelection(
        LevelModel(
            space=problem.space,
            quantities=problem.tables,
            replicates={},
            alternative_of=problem.alternative,
            levels_of=problem.levels_of,
        )
    )
    bent = PiecewiseValue(measure="cost", worst=6.0, best=2.0, interior=((5.0, 0.1), (4.0, 0.9)))
    other = PiecewiseValue(measure="cost", worst=6.0, best=1.0)
    sizes = []
    for function in (bent, bent, other, other):
        WeightedValue(function=function, weight=0.5).compile(selection)
        sizes.append(len(selection.structure))
    assert sizes[0] == sizes[1] < sizes[2] == sizes[3]


def test_an_answer_that_violates_a_demand_is_refused(monkeypatch):
    """The tables that the solver sees and those that the answer is recomputed from are made to differ."""
    problem = by_hand(thresholds=(threshold("payload", ">=", 5.0),))
    light = Alternative(variant=7, measures={"cost": 0.0, "payload": 0.0, "time": 0.0})
    monkeypatch.setattr(LevelProblem, "alternative", lambda self, levels: light)
    monkeypatch.setattr(rgss.tradeoff.levels.problem, "LARGEST_ENUMERATED", 1)
    with pytest.raises(TradeoffError, match="the stages of the additive program contradict each other"):
        decide_levels(problem)
