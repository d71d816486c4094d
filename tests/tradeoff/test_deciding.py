from __future__ import annotations

import dataclasses
import json
import math
import subprocess
import sys
from fractions import Fraction

import pytest

import rgss.tradeoff.explanation
from rgss.errors import TradeoffError
from rgss.reports.decision.json import decision_to_json
from rgss.tradeoff import (
    DecisionStatus,
    InfeasibleAlternative,
    RankedAlternative,
    RequirementCount,
    decide,
)
from rgss.tradeoff.milp.stage import StageSolution
from rgss.tradeoff.programs.additive import AdditiveValue

TIE = Fraction(1, 10**9)


def by_hand(problem):
    """The decision in exact arithmetic over plain loops: no NumPy, no solver, none of the product's methods.

    Returns:
        Value by variant (None if unknown) and the set of violated requirements by variant.
    """
    weights = problem.weighting.weights
    bounded = {threshold.measure for threshold in problem.thresholds}
    values, violated = {}, {}
    for alternative in problem.alternatives:
        broken, total = set(), Fraction(0)
        for threshold in problem.thresholds:
            quantity = alternative.measures[threshold.measure]
            sign = 1 if threshold.comparison.value == ">=" else -1
            bad = quantity is None or (
                sign * (Fraction(quantity) - Fraction(threshold.value))
                < -Fraction(1, 10**9) * max(abs(Fraction(quantity)), abs(Fraction(threshold.value)))
            )
            if bad:
                broken.add(threshold.requirement)
        for function in problem.value_functions:
            weight, quantity = Fraction(weights[function.measure]), alternative.measures[function.measure]
            if not weight:
                continue
            if quantity is None:
                total = None
                if function.measure not in bounded:
                    broken.add(f"evidence:{function.measure}")
            elif total is not None:
                worst, best = Fraction(function.worst), Fraction(function.best)
                total += weight * min(max((Fraction(quantity) - worst) / (best - worst), Fraction(0)), Fraction(1))
        values[alternative.variant], violated[alternative.variant] = total, broken
    return values, violated


def random_problem(rng, build_problem):
    """Kinds: a coarse grid (many exact ties), near-ties, mixed magnitudes, uniform; with unknowns and odd weights."""
    names = "abcd"[: rng.randrange(1, 5)]
    kind = rng.choice(["grid", "near", "magnitude", "uniform"])
    centre = {name: rng.random() for name in names}
    unknown = rng.choice([0.0, 0.0, 0.1, 0.5])

    def quantity(name):
        if rng.random() < unknown:
            return None
        return {
            "grid": rng.choice([0.0, 0.25, 0.5, 1.0]),
            "near": centre[name] + rng.choice([0.0, 1e-10, 4e-9, 2e-8]),
            "magnitude": rng.random() * 10.0 ** rng.choice([-12, 0, 12]),
            "uniform": rng.random(),
        }[kind]

    variants = rng.sample(range(1, 200), rng.choice([1, 2, 3, 8, 20, 72]))
    measures = {variant: {name: quantity(name) for name in names} for variant in variants}
    thresholds = []
    for number in range(rng.randrange(4)):
        name = rng.choice(names)
        known = [quantities[name] for quantities in measures.values() if quantities[name] is not None] or [0.5]
        limit = rng.choice([rng.choice(known), rng.choice(known), max(known) * 2 + 1])
        thresholds.append((f"R-{number // rng.choice([1, 2])}", name, rng.choice([">=", "<="]), limit))
    shares = [rng.choice([0, 1, 1, 2, 5]) for _ in names]
    shares[0] += not any(shares)
    values = {}
    for name in names:
        worst = rng.choice([0.0, 1.0, 0.5, centre[name]])
        # Now and then so narrow that every alternative is beyond one of the anchors.
        values[name] = (worst, worst + rng.choice([1.0, -1.0, 0.3, 1e-9]))
    return build_problem(
        measures,
        thresholds=thresholds,
        values=values,
        weights={name: share / sum(shares) for name, share in zip(names, shares, strict=True)},
    )


@pytest.mark.parametrize("seed", range(20))
def test_agreement_with_exact_enumeration(seeded, build_problem, oracle, seed):
    rng = seeded(seed)
    for _ in range(20):
        problem = random_problem(rng, build_problem)
        decision = decide(problem)
        values, violated = by_hand(problem)
        feasible = {variant: values[variant] for variant in values if not violated[variant]}

        assert {alternative.variant: set(alternative.requirements) for alternative in decision.infeasible} == {
            variant: broken for variant, broken in violated.items() if broken
        }
        assert {ranked.variant for ranked in decision.ranking} == set(feasible)
        for ranked in decision.ranking:
            assert ranked.value == pytest.approx(float(feasible[ranked.variant]), abs=1e-11)
        assert decision.certificate.enumeration_agrees
        if not feasible:
            assert decision.status is DecisionStatus.INFEASIBLE
            assert (decision.chosen, decision.runner_up, decision.ties) == (None, None, ())
            assert decision.conflicts is not None
            continue
        best = max(feasible.values())
        equal = [one for one in problem.alternatives if feasible.get(one.variant, -1) >= best - TIE]
        tied = [one.variant for one in oracle.chosen_first(problem, equal)]
        below = sorted((-value, variant) for variant, value in feasible.items() if value < best - TIE)
        assert (decision.status, decision.conflicts) == (DecisionStatus.OPTIMAL, None)
        assert decision.ties == tuple(tied)
        assert decision.chosen == tied[0]
        assert [ranked.variant for ranked in decision.ranking[: len(tied)]] == tied
        if below:
            assert feasible[decision.runner_up] == pytest.approx(float(-below[0][0]), abs=1e-11)
        else:
            assert decision.runner_up == (tied[1] if len(tied) > 1 else None)
        better = {
            variant
            for variant, broken in violated.items()
            if broken and values[variant] is not None and values[variant] > best + TIE
        }
        assert {alternative.variant for alternative in decision.excluded_better} == better
        for contribution, variant in (
            (decision.chosen_contributions, decision.chosen),
            (decision.runner_up_contributions, decision.runner_up),
        ):
            if variant is not None:
                total = sum(part.contribution for part in contribution)
                assert total == pytest.approx(float(feasible[variant]), abs=1e-11)


def test_hand_worked(payload_and_time):
    decision = decide(payload_and_time)
    assert decision.status is DecisionStatus.OPTIMAL
    assert (decision.chosen, decision.runner_up, decision.ties) == (1, 3, (1,))
    assert decision.ranking == (
        RankedAlternative(variant=1, value=0.5, objectives=(0.5,)),
        RankedAlternative(variant=3, value=0.4375, objectives=(0.4375,)),
    )
    # 5 violates both but would not have been better: it does not make a requirement decide.
    assert decision.excluded_better == (
        InfeasibleAlternative(variant=2, requirements=("R-1",), value=0.8),
        InfeasibleAlternative(variant=4, requirements=("R-2",), value=0.7625),
    )
    assert decision.deciding_requirements == (
        RequirementCount(requirement="R-1", excluded=1),
        RequirementCount(requirement="R-2", excluded=1),
    )


def test_the_excluded_that_are_no_better_decide_nothing(build_problem):
    decision = decide(
        build_problem(
            {1: {"a": 0.5, "b": 1.0}, 2: {"a": 0.5, "b": 0.0}, 3: {"a": 0.4, "b": 0.0}},
            thresholds=[("R", "b", ">=", 1.0)],
        )
    )
    assert decision.chosen == 1
    assert decision.excluded_better == ()
    assert decision.deciding_requirements == ()
    assert decision.runner_up is None


def test_a_tie_goes_to_the_smallest_id_and_the_runner_up_is_below_it(build_problem):
    decision = decide(build_problem({9: {"a": 0.7}, 4: {"a": 0.2}, 6: {"a": 0.7}, 5: {"a": 0.7 + 4e-10}}))
    assert decision.ties == (5, 6, 9)
    assert decision.chosen == 5
    assert decision.runner_up == 4
    assert [ranked.variant for ranked in decision.ranking] == [5, 6, 9, 4]


def test_the_smallest_tied_id_is_chosen_even_if_another_is_better_by_less_than_a_tie(build_problem):
    decision = decide(build_problem({1: {"a": 0.7}, 2: {"a": 0.7 + 4e-10}, 3: {"a": 0.7 - 4e-9}}))
    assert (decision.chosen, decision.ties, decision.runner_up) == (1, (1, 2), 3)
    assert [ranked.variant for ranked in decision.ranking] == [1, 2, 3]


def test_where_all_are_tied_the_runner_up_is_the_next_of_them(build_problem):
    decision = decide(build_problem({3: {"a": 2.0}, 2: {"a": 3.0}, 1: {"a": 0.0}}, thresholds=[("R", "a", ">=", 1.0)]))
    assert (decision.chosen, decision.ties, decision.runner_up) == (2, (2, 3), 3)


def test_all_values_zero(build_problem):
    decision = decide(build_problem({2: {"a": -1.0}, 1: {"a": 0.0}}))
    assert (decision.chosen, decision.ties) == (1, (1, 2))
    assert [ranked.value for ranked in decision.ranking] == [0.0, 0.0]


def test_one_alternative(build_problem):
    decision = decide(build_problem({8: {"a": 0.5}}))
    assert (decision.chosen, decision.runner_up, decision.ties) == (8, None, (8,))
    assert decision.runner_up_contributions == ()


def test_unknown_evidence_excludes_with_a_reason(build_problem):
    decision = decide(
        build_problem(
            {1: {"a": None, "b": 0.9}, 2: {"a": 0.1, "b": None}, 3: {"a": None, "b": None}, 4: {"a": 0.1, "b": 0.1}},
            thresholds=[("R", "b", ">=", 0.0)],
            values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
            weights={"a": 0.5, "b": 0.5},
        )
    )
    assert decision.chosen == 4
    assert [(entry.variant, entry.requirements, entry.value) for entry in decision.infeasible] == [
        (1, ("evidence:a",), None),
        (2, ("R",), None),
        (3, ("R", "evidence:a"), None),
    ]
    assert decision.excluded_better == ()


def test_a_measure_of_weight_zero_is_shown_but_needs_no_evidence(build_problem):
    decision = decide(
        build_problem(
            {1: {"a": 0.5, "b": None}},
            values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
            weights={"b": 0.0, "a": 1.0},
        )
    )
    assert decision.chosen == 1
    unknown, known = decision.chosen_contributions
    assert (unknown.measure, unknown.quantity, unknown.value, unknown.contribution) == ("b", None, None, 0.0)
    assert (known.measure, known.quantity, known.value, known.contribution) == ("a", 0.5, 0.5, 0.5)


def test_the_order_of_alternatives_does_not_matter(seeded, build_problem):
    rng = seeded(11)
    for _ in range(15):
        problem = random_problem(rng, build_problem)
        shuffled = dataclasses.replace(
            problem, alternatives=tuple(rng.sample(problem.alternatives, len(problem.alternatives)))
        )
        first, again, other = (json.dumps(decision_to_json(decide(p))) for p in (problem, problem, shuffled))
        assert first == again == other


@pytest.fixture
def answer(monkeypatch):
    """Puts words into the solver's mouth."""

    def give(problem, variant, objective):
        chosen = next((one for one in problem.alternatives if one.variant == variant), None)
        status = DecisionStatus.INFEASIBLE if chosen is None else DecisionStatus.OPTIMAL
        solution = StageSolution(
            name="value", status=status, alternative=chosen, objective=objective, gap=0.0, selection_error=0.0
        )
        monkeypatch.setattr(AdditiveValue, "solve", lambda self, preferences, solver: (solution,))

    return give


@pytest.mark.parametrize(
    ("variant", "objective", "message"),
    [
        (3, 0.4375, "the solver finds variant 3 (0.4375), enumeration finds variant 1 (0.5)"),
        (None, None, "the solver finds nothing feasible, enumeration finds variant 1 (0.5)"),
    ],
)
def test_no_decision_on_contradictory_answers(payload_and_time, answer, variant, objective, message):
    answer(payload_and_time, variant, objective)
    with pytest.raises(TradeoffError) as error:
        decide(payload_and_time)
    assert error.value.message == message
    assert error.value.hint.startswith("no decision is made on contradictory answers")


def test_no_decision_where_the_solver_finds_what_is_not_feasible(build_problem, answer):
    problem = build_problem({1: {"a": 0.1}}, thresholds=[("R", "a", ">=", 0.2)])
    answer(problem, 1, 0.1)
    with pytest.raises(TradeoffError, match="enumeration finds nothing feasible"):
        decide(problem)


def test_the_work_of_a_decision_hardly_grows_with_the_alternatives(seeded, build_problem):
    """Counted in calls of functions, which no other process makes more."""
    names, calls = "abcde", []
    for alternatives in (8, 8, 72):  # the first loads modules
        rng = seeded(5)
        problem = build_problem(
            {variant: {name: rng.random() for name in names} for variant in range(1, alternatives + 1)},
            thresholds=[(f"R-{name}", name, ">=", 0.1) for name in names],
            values=dict.fromkeys(names, (0.0, 1.0)),
            weights=dict.fromkeys(names, 0.2),
        )
        counted = 0

        def count(_frame, event, _argument):
            nonlocal counted
            counted += event == "call"

        sys.setprofile(count)
        try:
            decide(problem)
        finally:
            sys.setprofile(None)
        calls.append(counted)
    assert calls[2] <= 9 * calls[1]


def test_the_package_loads_without_solver_or_numpy():
    program = "import sys, rgss.tradeoff; print(sorted({'cvxpy', 'highspy', 'numpy', 'scipy'} & set(sys.modules)))"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"


def test_a_fresh_interpreter_decides_without_a_warning():
    program = (
        "from rgss.tradeoff import *\n"
        "print(decide(TradeProblem(alternatives=(Alternative(variant=1, measures={'a': 0.5}),), thresholds=(),"
        " value_functions=(PiecewiseValue(measure='a', worst=0.0, best=1.0),),"
        " weighting=Weighting(weights={'a': 1.0}))).chosen)"
    )
    result = subprocess.run([sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False)
    assert (result.stdout, result.stderr, result.returncode) == ("1\n", "", 0)


def test_near_ties_are_within_the_practical_margin(build_problem):
    problem = build_problem({1: {"a": 0.70}, 2: {"a": 0.69}, 3: {"a": 0.68}, 4: {"a": 0.70}, 5: {"a": 0.30}})
    assert decide(problem).near_ties == ()
    assert decide(problem, margin=0.015).near_ties == (2,)
    decision = decide(problem, margin=0.05)
    assert (decision.ties, decision.near_ties) == ((1, 4), (2, 3))


@pytest.mark.parametrize("margin", [-0.1, math.nan, math.inf])
def test_a_margin_that_is_none(build_problem, margin):
    with pytest.raises(TradeoffError, match="practical margin must be at least 0"):
        decide(build_problem({1: {"a": 0.5}}), margin=margin)


def test_a_measure_in_which_nothing_differs_is_reported(build_problem):
    """Nothing is divided by its range: the value function has anchors of its own."""
    names = {"a": (0.0, 1.0), "b": (0.0, 1.0), "c": (0.0, 1.0), "d": (0.0, 1.0)}
    problem = build_problem(
        {
            1: {"a": 0.5, "b": 0.3, "c": 5.0, "d": 0.2},
            2: {"a": 0.6, "b": 0.3, "c": 7.0, "d": 0.2},
            3: {"a": 0.9, "b": 0.3, "c": 9.0, "d": 0.7},
        },
        thresholds=[("R", "a", "<=", 0.8)],
        values=names,
        weights=dict.fromkeys(names, 0.25),
    )
    decision = decide(problem)
    assert decision.chosen == 2
    assert [(one.measure, one.low, one.high, one.among_feasible, one.value) for one in decision.flat_measures] == [
        ("b", 0.3, 0.3, False, 0.3),
        ("c", 5.0, 9.0, False, 1.0),
        ("d", 0.2, 0.2, True, 0.2),
    ]
    assert decide(build_problem({1: {"a": 0.5}})).flat_measures == ()


def test_a_long_list_is_cut_and_counted(build_problem, monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.explanation, "LONGEST_LIST", 3)
    problem = build_problem(
        {variant: {"a": variant / 100} for variant in range(1, 21)}, thresholds=[("R", "a", "<=", 0.1)]
    )
    decision = decide(problem)
    assert [ranked.variant for ranked in decision.ranking] == [10, 9, 8]
    assert [out.variant for out in decision.infeasible] == [11, 12, 13]
    assert [out.variant for out in decision.excluded_better] == [20, 19, 18]
    assert (decision.counts.feasible, decision.counts.alternatives, decision.counts.excluded_better) == (10, 20, 10)
    assert decision.deciding_requirements == (RequirementCount(requirement="R", excluded=10),)


def test_the_runner_up_where_more_are_tied_than_are_listed(build_problem, monkeypatch):
    monkeypatch.setattr(rgss.tradeoff.explanation, "LONGEST_LIST", 3)
    decision = decide(build_problem({variant: {"a": 0.5 if variant < 6 else 0.4} for variant in range(1, 9)}))
    assert (decision.ties, decision.runner_up) == ((1, 2, 3, 4, 5), 6)


def test_of_equals_the_last_may_be_chosen(build_problem):
    rows = {1: {"a": 0.7}, 2: {"a": 0.6}, 3: {"a": 0.7}, 4: {"a": 0.7}}
    problem = build_problem(rows)
    first, last = decide(problem), decide(problem, last_of_equals=True)
    assert (first.chosen, first.ties) == (1, (1, 3, 4))
    assert (last.chosen, last.ties) == (4, (4, 3, 1))
    assert [one.variant for one in last.ranking] == [4, 3, 1, 2]
    assert last.runner_up == first.runner_up == 2
