"""The programs by hand: what each is for, and what it must not do."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import (
    AdditiveValue,
    Aim,
    Alternative,
    Comparison,
    ElicitedInterval,
    ElicitedOrder,
    EpsilonConstraint,
    Lexicographic,
    MinimaxRegret,
    Scenarios,
    Tchebycheff,
    Threshold,
    WeightBounds,
    decide,
)
from rgss.tradeoff.problem.dominance import nondominated


def aim(measure, sense=">=", **tolerance):
    return Aim(measure=measure, sense=Comparison(sense), **tolerance)


def limit(measure, sense, value):
    return Threshold(
        requirement=f"limit:{measure}", measure=measure, comparison=Comparison(sense), value=value, unit="1"
    )


@pytest.fixture
def two(build_problem):
    """A problem in two measures of equal weight, more being better."""

    def build(points, program, **more):
        return build_problem(
            {variant: {"a": a, "b": b} for variant, (a, b) in enumerate(points, start=1)},
            values={"a": (0.0, 1.0), "b": (0.0, 1.0)},
            weights=more.pop("weights", {"a": 0.5, "b": 0.5}),
            program=program,
            **more,
        )

    return build


class TestLexicographic:
    POINTS = ((0.90, 0.2), (0.88, 0.5), (0.80, 0.9), (0.90, 0.1))

    @pytest.mark.parametrize(
        ("first", "chosen"),
        [
            ({}, 1),
            ({"absolute": 0.02}, 2),
            ({"absolute": 0.019}, 1),
            ({"relative": 0.1}, 2),
            ({"absolute": 0.1}, 3),
            ({"relative": 1.0 / 9.0}, 3),
        ],
    )
    def test_a_tolerance_gives_up_so_much_and_no_more(self, two, first, chosen):
        decision = decide(two(self.POINTS, Lexicographic(aims=(aim("a", **first), aim("b")))))
        assert decision.chosen == chosen
        assert decision.objectives == ("a", "b")
        assert [stage.name for stage in decision.certificate.stages] == ["a", "b"]
        assert decision.certificate.stages[0].objective == 0.9

    def test_less_may_be_better(self, two):
        decision = decide(two(self.POINTS, Lexicographic(aims=(aim("a", "<=", relative=0.11), aim("b", "<=")))))
        assert decision.chosen == 2
        assert decision.ranking[0].objectives == (0.88, 0.5)

    def test_the_tolerance_of_the_last_measure_lists_what_is_near(self, two):
        decision = decide(two(self.POINTS, Lexicographic(aims=(aim("a", absolute=0.2), aim("b", absolute=0.4)))))
        assert (decision.chosen, decision.near_ties) == (3, (2,))

    def test_the_ranking_is_what_is_chosen_next(self, two):
        problem = two(self.POINTS, Lexicographic(aims=(aim("a", absolute=0.02), aim("b"))))
        order = [ranked.variant for ranked in decide(problem).ranking]
        left = problem.alternatives
        for variant in order:
            assert decide(dataclasses.replace(problem, alternatives=left)).chosen == variant
            left = tuple(one for one in left if one.variant != variant)
        assert order == [2, 1, 4, 3]

    def test_what_is_excluded_and_would_be_preferred(self, two):
        problem = two(
            ((0.9, 0.2), (0.89, 0.5), (0.85, 0.9), (0.7, 1.0)),
            Lexicographic(aims=(aim("a", absolute=0.02), aim("b"))),
            thresholds=[("R", "b", "<=", 0.4)],
        )
        decision = decide(problem)
        # 3 gives up too much of a, 2 does not.
        assert (decision.chosen, [out.variant for out in decision.excluded_better]) == (1, [2])

    @pytest.mark.parametrize(
        ("tolerance", "message"),
        [
            ({"absolute": -0.1}, "absolute tolerance of 'a' must be at least 0, got -0.1"),
            ({"relative": math.nan}, "relative tolerance of 'a' must be at least 0, got nan"),
            ({"relative": 1.0}, "relative tolerance of 'a' must be below 100 %, got 100 %"),
            (
                {"absolute": 0.1, "relative": 0.2},
                "'a' has two tolerances that contradict each other: 0.1 and 20 %",
            ),
        ],
    )
    def test_tolerances_that_contradict(self, tolerance, message):
        with pytest.raises(TradeoffError) as error:
            aim("a", **tolerance)
        assert error.value.message == message
        assert error.value.hint

    def test_measures_that_contradict(self):
        with pytest.raises(TradeoffError, match="'a' occurs twice in a lexicographic program"):
            Lexicographic(aims=(aim("a"), aim("b"), aim("a")))
        with pytest.raises(TradeoffError, match="a lexicographic program has no measures"):
            Lexicographic(aims=())

    def test_an_unknown_measure(self, two):
        with pytest.raises(TradeoffError, match="the lexicographic program names the unknown measure 'z'"):
            two(self.POINTS, Lexicographic(aims=(aim("z"),)))

    def test_evidence_that_is_missing_excludes(self, build_problem):
        problem = build_problem(
            {1: {"a": 0.1, "b": None}, 2: {"a": None, "b": 1.0}}, program=Lexicographic(aims=(aim("b"),))
        )
        decision = decide(problem)
        assert (decision.chosen, decision.ranking[0].value) == (2, None)
        assert decision.infeasible[0].requirements == ("evidence:b",)


class TestEpsilonConstraint:
    def test_the_limit_moves_along_the_front(self, two):
        """Every undominated point is the optimum of some limit, those inside the hollow included."""
        points = ((1.0, 0.0), (0.6, 0.3), (0.3, 0.45), (0.1, 0.8), (0.0, 1.0), (0.2, 0.4))
        for variant, (_, b) in enumerate(points[:5], start=1):
            decision = decide(two(points, EpsilonConstraint(aim=aim("a"), bounds=(limit("b", ">=", b),))))
            assert decision.chosen == variant

    def test_of_equals_the_one_of_highest_value_so_the_choice_is_undominated(self, two):
        points = ((0.5, 0.2), (0.5, 0.9), (0.5, 0.4))
        decision = decide(two(points, EpsilonConstraint(aim=aim("a"), bounds=(limit("b", ">=", 0.1),))))
        assert (decision.chosen, decision.objectives, decision.ranking[0].objectives) == (2, ("a", "value"), (0.5, 0.7))

    def test_a_limit_is_a_demand_with_a_name(self, two):
        decision = decide(two(((0.5, 0.2),), EpsilonConstraint(aim=aim("a"), bounds=(limit("b", ">=", 0.9),))))
        assert decision.infeasible[0].requirements == ("limit:b",)
        assert decision.demands["limit:b"] == "b >= 0.9"
        assert decision.conflicts.repairs[0].changes[0].needed == 0.2

    def test_within_its_tolerance_others_are_near(self, two):
        program = EpsilonConstraint(aim=aim("a", absolute=0.1), bounds=(limit("b", ">=", 0.0),))
        decision = decide(two(((0.9, 0.1), (0.85, 0.9), (0.7, 1.0)), program))
        assert (decision.chosen, decision.near_ties) == (1, (2,))

    def test_ill_posed(self):
        with pytest.raises(TradeoffError, match="an epsilon-constraint program has no limits"):
            EpsilonConstraint(aim=aim("a"), bounds=())
        bound = dataclasses.replace(limit("b", ">=", 0.0), requirement="b")
        with pytest.raises(TradeoffError, match="the limit 'b' has no id of a limit"):
            EpsilonConstraint(aim=aim("a"), bounds=(bound,))


class TestTchebycheff:
    HOLLOW = ((1.0, 0.0), (0.0, 1.0), (0.4, 0.4))

    def test_it_reaches_what_no_weighted_sum_selects(self, two):
        for share in np.linspace(0.0, 1.0, 21):
            weights = {"a": float(share), "b": 1.0 - float(share)}
            assert decide(two(self.HOLLOW, AdditiveValue(), weights=weights)).chosen != 3
        decision = decide(two(self.HOLLOW, Tchebycheff()))
        assert decision.chosen == 3
        assert decision.ranking[0].objectives == pytest.approx((0.5 * 0.6 + 1e-3 * 1.2,))

    @pytest.mark.parametrize("seed", range(5))
    def test_it_reaches_every_undominated_alternative(self, build_problem, seed):
        """Weights inverse to the distance from the ideal point aim at an alternative (Steuer and Choo, 1983)."""
        rng = np.random.default_rng(seed)
        values = rng.random((25, 3)) * 0.9
        names = "abc"
        for row in np.flatnonzero(nondominated(values)):
            inverse = 1.0 / (1.0 - values[row])
            problem = build_problem(
                {place: dict(zip(names, map(float, each), strict=True)) for place, each in enumerate(values)},
                values=dict.fromkeys(names, (0.0, 1.0)),
                weights=dict(zip(names, map(float, inverse / inverse.sum()), strict=True)),
                program=Tchebycheff(augmentation=1e-6),
            )
            assert decide(problem).chosen == row

    def test_augmentation_avoids_what_is_only_weakly_undominated(self, two):
        points = ((0.5, 0.5), (0.5, 0.9))
        assert decide(two(points, Tchebycheff())).chosen == 2
        assert decide(two(points, Tchebycheff())).ties == (2,)

    def test_the_reference_point_says_what_is_aspired_to(self, two):
        points = ((0.9, 0.3), (0.6, 0.6), (0.3, 0.9))
        assert decide(two(points, Tchebycheff())).chosen == 2
        assert decide(two(points, Tchebycheff(reference={"a": 0.9, "b": 0.3}))).chosen == 1
        assert decide(two(points, Tchebycheff(reference={"a": 0.3}))).chosen == 3

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            ({"reference": {"a": 1.2}}, "reference value of 'a' must be from 0 to 1, got 1.2"),
            ({"augmentation": 0.0}, "augmentation must be above 0 and at most 1, got 0"),
            ({"augmentation": math.nan}, "augmentation must be above 0 and at most 1, got nan"),
        ],
    )
    def test_ill_posed(self, arguments, message):
        with pytest.raises(TradeoffError) as error:
            Tchebycheff(**arguments)
        assert error.value.message == message

    def test_a_reference_without_weight(self, two):
        with pytest.raises(TradeoffError, match="the reference names 'b', which has no weight"):
            two(self.HOLLOW, Tchebycheff(reference={"b": 1.0}), weights={"a": 1.0, "b": 0.0})


class TestMinimaxRegret:
    def test_by_hand(self, two):
        """Over all weights the scenarios are a alone and b alone; the compromise regrets 0.4 at most."""
        decision = decide(two(((1.0, 0.0), (0.0, 1.0), (0.6, 0.7)), MinimaxRegret()))
        assert (decision.chosen, decision.objectives) == (3, ("regret",))
        assert [ranked.objectives[0] for ranked in decision.ranking] == pytest.approx([0.4, 1.0, 1.0])
        assert [stage.name for stage in decision.certificate.stages] == [
            "best value, weights 1",
            "best value, weights 2",
            "regret",
        ]

    def test_bounds_on_weights_narrow_the_scenarios(self, two):
        points = ((1.0, 0.0), (0.0, 1.0), (0.6, 0.7))
        only_a = WeightBounds(intervals=(ElicitedInterval(name="a", measures=("a",), least=0.9, most=1.0),))
        weights = {"a": 0.95, "b": 0.05}
        assert decide(two(points, MinimaxRegret(), weights=weights, weight_bounds=only_a)).chosen == 1
        order = ElicitedOrder(heavier="b", heavier_measures=("b",), lighter="a", lighter_measures=("a",))
        bounds = WeightBounds(orders=(order,))
        # With b at least as heavy, the corners are b alone and equal weights.
        decision = decide(two(points, MinimaxRegret(), weight_bounds=bounds))
        assert (decision.chosen, decision.ranking[0].objectives) == (2, pytest.approx((0.15,)))

    def test_no_weight_of_the_set_causes_more_regret_than_the_corners(self, two):
        rng = np.random.default_rng(3)
        points = tuple(map(tuple, rng.random((12, 2)).tolist()))
        interval = ElicitedInterval(name="a", measures=("a",), least=0.3, most=0.8)
        decision = decide(two(points, MinimaxRegret(), weight_bounds=WeightBounds(intervals=(interval,))))
        values = np.array(points)
        weights = np.linspace(0.3, 0.8, 501)
        scores = values @ np.stack([weights, 1.0 - weights])
        regrets = (scores.max(axis=0) - scores).max(axis=1)
        assert regrets.min() == pytest.approx(decision.ranking[0].objectives[0], abs=1e-12)
        assert int(regrets.argmin()) + 1 == decision.chosen

    def test_over_replicates(self, build_problem):
        def one(variant, row):
            return Alternative(variant=variant, measures={"a": sum(row) / len(row)}, samples={"a": row})

        alternatives = (one(1, (1.0, 0.0, 1.0)), one(2, (0.0, 1.0, 0.4)), one(3, (0.6, 0.6, 0.6)))
        program = MinimaxRegret(scenarios=Scenarios.REPLICATES)
        decision = decide(build_problem({}, alternatives=alternatives, program=program))
        assert decision.chosen == 3
        assert [ranked.objectives[0] for ranked in decision.ranking] == pytest.approx([0.4, 1.0, 1.0])
        assert decide(build_problem({}, alternatives=alternatives)).chosen == 1

    def test_every_replicate_must_tell(self, build_problem):
        alternatives = (
            Alternative(variant=1, measures={"a": 0.9}, samples={"a": (0.9, None)}),
            Alternative(variant=2, measures={"a": 0.1}, samples={"a": (0.1, 0.1)}),
        )
        program = MinimaxRegret(scenarios=Scenarios.REPLICATES)
        decision = decide(build_problem({}, alternatives=alternatives, program=program))
        assert (decision.chosen, decision.infeasible[0].requirements) == (2, ("evidence:a",))
        assert decision.demands["evidence:a"] == "a is known in every replicate"

    @pytest.mark.parametrize(
        ("rows", "message"),
        [
            (((1.0,), (1.0, 2.0)), "variant 1 has 1 replicate and variant 2 has 2, so there is no common scenario"),
            (((1.0,), (2.0,)), "regret over replicates needs 2 replicates of each variant, and there is 1"),
            ((None, None), "regret over replicates needs a measure that is observed in trials"),
        ],
    )
    def test_no_common_scenarios(self, build_problem, rows, message):
        alternatives = tuple(
            Alternative(variant=variant, measures={"a": 1.0}, samples={} if row is None else {"a": row})
            for variant, row in enumerate(rows, start=1)
        )
        with pytest.raises(TradeoffError) as error:
            build_problem({}, alternatives=alternatives, program=MinimaxRegret(scenarios=Scenarios.REPLICATES))
        assert error.value.message == message
        assert error.value.hint


def test_a_program_that_nothing_enumerates(build_problem):
    class Other(AdditiveValue):
        pass

    class Unknown:
        name = "unknown"
        limits = ()

        def needs(self, preferences):
            return {}

        def check(self, preferences):
            return None

    assert decide(build_problem({1: {"a": 0.5}}, program=Other())).chosen == 1
    with pytest.raises(TradeoffError, match="no enumeration is known for the program 'unknown'"):
        decide(build_problem({1: {"a": 0.5}}, program=Unknown()))
