"""What a study's trade-off becomes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.choosing import choose, double_counting, shared_measures, trade_problem
from rgss.decision.portfolios import choose_portfolio, portfolio_projects
from rgss.designs.compatibility import Condition, Rule
from rgss.errors import DefinitionError, TradeoffError
from rgss.evidence import Fidelity
from rgss.studies import Promotion, Screening
from rgss.tradeoff import (
    Comparison,
    ElicitedInterval,
    ElicitedOrder,
    EpsilonConstraint,
    ExponentialValue,
    Incompatibility,
    Lexicographic,
    MinimaxRegret,
    PiecewiseValue,
    PortfolioAim,
    Scenarios,
    TargetValue,
    Tchebycheff,
)

STUDY = "studies/pick_place.yaml"
PAYLOAD = "{measure: P_max, weight: 0.5, worst: 0.8 kg, best: 1.4 kg}"
TIME = "{measure: t_e, weight: 0.5, worst: 25 s, best: 5 s}"


@pytest.fixture(scope="module")
def read(read_trade_off_of):
    return read_trade_off_of


@pytest.fixture(scope="module")
def measured(shipped, filled, record_of):
    def record_for(spec):
        return record_of(
            spec,
            success=not (spec.planner == "TRRT" and spec.seed == 2),
            planning_s=0.1 * (1 + (spec.variant + spec.seed) % 7),
            path_m=0.4 + 0.01 * (spec.variant % 11) + 0.02 * spec.seed,
        )

    return measure_variants(shipped, filled(shipped, record_for))


@pytest.fixture(scope="module")
def problem_of(shipped, measured, read):
    def make(*lines):
        return trade_problem(replace(shipped, study=read(*lines)), measured)

    return make


BOTH = ("values:", f"  - {PAYLOAD}", f"  - {TIME}")


def values(*entries):
    return ("values:", *(f"  - {entry}" for entry in entries))


def test_value_functions(problem_of):
    problem = problem_of(
        *values(
            "{measure: P_max_simulated, weight: 0.2, worst: {requirement: SYS-012},"
            " best: {requirement: SYS-012, times: 1.75}}",
            "{measure: t_e_simulated, weight: 0.2, worst: 25 s, best: 5 s,"
            " between: [{at: {requirement: SYS-005, times: 0.6}, worth: 0.8}]}",
            "{measure: t_p, weight: 0.2, worst: 15 s, best: 1 s, halfway: 12 s}",
            "{measure: S, weight: 0.2, worst: 80 %, best: 1}",
            "{measure: v_m_peak, weight: 0.2, target: 0.5 m/s, too_low: 200 mm/s, too_high: 1 m/s}",
        )
    )
    assert problem.value_functions == (
        PiecewiseValue(measure="P_max_simulated", worst=0.8, best=0.8 * 1.75),
        PiecewiseValue(measure="t_e_simulated", worst=25.0, best=5.0, interior=((15.0, 0.8),)),
        ExponentialValue(measure="t_p", worst=15.0, best=1.0, halfway=12.0),
        PiecewiseValue(measure="S", worst=0.8, best=1.0),
        TargetValue(measure="v_m_peak", target=0.5, too_low=0.2, too_high=1.0),
    )


def test_weights_of_groups_and_what_bounds_them(problem_of):
    problem = problem_of(
        "values:",
        "  - criterion: time",
        "    weight: 0.6",
        "    weight_between: [0.5, 0.7]",
        "    of:",
        "      - {measure: t_e, points: 75, weight_between: [0.5, 1], worst: 25 s, best: 5 s}",
        "      - {measure: t_p, points: 25, worst: 15 s, best: 1 s}",
        "  - {measure: S, weight: 0.4, worst: 0.8, best: 1}",
        "weight_order:",
        "  - {heavier: time, lighter: S, times: 1.5}",
    )
    assert dict(problem.weighting.weights) == pytest.approx({"t_e": 0.45, "t_p": 0.15, "S": 0.4})
    assert problem.weight_bounds.intervals == (
        ElicitedInterval(name="t_e", measures=("t_e",), within=("t_e", "t_p"), least=0.5, most=1.0),
        ElicitedInterval(name="time", measures=("t_e", "t_p"), least=0.5, most=0.7),
    )
    (order,) = problem.weight_bounds.orders
    assert order == ElicitedOrder(
        heavier="time", heavier_measures=("t_e", "t_p"), lighter="S", lighter_measures=("S",), times=1.5
    )


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        (
            (
                "decide_by: {program: lexicographic,"
                " order: [{measure: t_m, absolute: 500 ms}, {measure: P_max, relative: 2 %}]}"
            ),
            Lexicographic,
        ),
        (
            (
                "decide_by: {program: epsilon_constraint, optimise: {measure: P_max},"
                " limits: [{measure: C_total, at_most: {requirement: SYS-004, times: 0.99}}]}"
            ),
            EpsilonConstraint,
        ),
        ("decide_by: {program: tchebycheff, reference: {t_e: 15 s}, augmentation: 0.01}", Tchebycheff),
        ("decide_by: {program: minimax_regret, over: replicates}", MinimaxRegret),
    ],
)
def test_programs(problem_of, line, kind):
    program = problem_of(*BOTH, line).program
    assert type(program) is kind
    if kind is Lexicographic:
        first, second = program.aims
        assert (first.measure, first.sense, first.absolute, first.relative) == ("t_m", Comparison.AT_MOST, 0.5, 0.0)
        assert (second.measure, second.sense, second.absolute, second.relative) == (
            "P_max",
            Comparison.AT_LEAST,
            0.0,
            0.02,
        )
    elif kind is EpsilonConstraint:
        assert program.bounds[0].name == "limit:C_total: C_total <= 42,570 USD"
    elif kind is Tchebycheff:
        assert (dict(program.reference), program.augmentation) == ({"t_e": 0.5}, 0.01)
    else:
        assert program.scenarios is Scenarios.REPLICATES


def test_demands_on_replicates(problem_of):
    problem = problem_of(
        *BOTH,
        "chance: [{requirement: SYS-005, probability: 0.6}]",
        "tail: [{measure: t_p, at_most: 5000 ms, worst_share: 40 %}]",
    )
    assert [risk.name for risk in problem.risks] == [
        "chance:SYS-005: P[t_e_simulated <= 25 s] >= 0.6",
        "tail:t_p: mean of the worst 40 % of t_p <= 5 s",
    ]


def test_too_few_replicates_for_a_chance(problem_of):
    with pytest.raises(TradeoffError) as error:
        problem_of(*BOTH, "chance: [{requirement: SYS-005, probability: 0.9}]")
    assert error.value.message == "chance:SYS-005 needs 10 replicates, variant 1 has 3"
    assert error.value.hint == "run at least 10 replicates, or ask for less: P[t_e_simulated <= 25 s] >= 0.9"


def test_the_replicates_are_what_the_estimates_stand_on(problem_of, measured):
    problem = problem_of(*BOTH, "tail: [{measure: S, at_least: 0.5, worst_share: 0.5}]")
    for entry, alternative in zip(measured, problem.alternatives, strict=True):
        # The payload of the bench is exact.
        assert set(alternative.samples) == {"t_e", "t_e_simulated", "t_gc_simulated", "t_p", "S", "S_mean"}
        for measure, row in alternative.samples.items():
            known = [quantity for quantity in row if quantity is not None]
            assert len(row) == 3
            assert sum(known) / len(known) == pytest.approx(entry.estimates[measure].value)
        failed = entry.variant.parameters["d8"] == "TRRT"
        assert alternative.samples["S"] == ((1.0, 0.0, 1.0) if failed else (1.0, 1.0, 1.0))
        assert (alternative.samples["t_e"][1] is None) is failed


def test_a_threshold_that_moves_takes_its_anchor_along(shipped, measured, read):
    study = read(*values("{measure: P_max_simulated, weight: 1, worst: {requirement: SYS-012}, best: 1.4 kg}"))
    assert [(one.worst, one.best, one.weight) for one in study.values] == [(0.8, 1.4, 1.0)]

    def with_threshold(value):
        system = tuple(
            replace(item, criterion=replace(item.criterion, threshold=value)) if item.id == "SYS-012" else item
            for item in shipped.requirements.system
        )
        return replace(shipped, study=study, requirements=replace(shipped.requirements, system=system))

    assert trade_problem(with_threshold(0.9), measured).value_functions[0].worst == 0.9
    with pytest.raises(DefinitionError) as error:
        trade_problem(with_threshold(2.0), measured)
    assert error.value.message == "with these ends of its value function, less P_max_simulated would be worth more"


def test_levels_come_to_the_same_decision(shipped, measured, read):
    over_levels, over_variants = (
        choose(replace(shipped, study=read(*BOTH, f"choose: {what}")), measured) for what in ("levels", "variants")
    )
    assert over_levels.chosen == over_variants.chosen
    assert over_levels.ranking == over_variants.ranking
    assert over_levels.certificate.enumeration_agrees


def test_rules_of_the_design_space_are_rules_on_levels(shipped, problem_of):
    problem = problem_of(*BOTH, "choose: levels")
    assert problem.levels.space.size == 72
    assert [factor.id for factor in problem.levels.space.factors] == [
        "gripper_mass",
        "fingers",
        "velocity",
        "planner",
        "planning_time",
    ]
    assert problem.levels.space.rules == ()


def test_a_rule_is_a_condition_on_the_factors_that_it_looks_at(shipped, measured, read):
    """Three fingers are not to be moved fast: the rule is over these two factors, whatever else varies."""
    rule = Rule(
        id="three-are-slow",
        rationale="",
        when=Condition(choices={"d1": (3,)}),
        require=Condition(choices={"d7": (0.5,)}),
    )
    designs = replace(shipped.designs, rules=(*shipped.designs.rules, rule))
    allowed = [variant.id for variant in designs.expand()]
    left = tuple(entry for entry in measured if entry.variant.id in allowed)
    project = replace(shipped, study=read(*BOTH, "choose: levels"), designs=designs)
    problem = trade_problem(project, left)

    assert len(left) == 54
    assert problem.levels.space.rules == (
        Incompatibility(
            id="three-are-slow", factors=("fingers", "velocity"), combinations=frozenset({("three", "fast")})
        ),
    )
    over_variants = choose(replace(project, study=read(*BOTH)), left)
    assert choose(project, left).ranking == over_variants.ranking


def test_designs_without_factors_have_no_levels(shipped, measured, read):
    project = replace(shipped, study=read(*BOTH, "choose: levels"), designs=replace(shipped.designs, factors=()))
    with pytest.raises(DefinitionError, match="levels can be chosen only where designs are combinations of levels"):
        trade_problem(project, measured)


def test_double_counting_and_what_to_value_instead(shipped, read):
    (overlap,) = double_counting(shipped)
    assert (overlap.whole, overlap.part, overlap.instead) == ("t_e", "t_p", "t_m")
    study = read(
        *values(
            "{measure: t_m, weight: 0.5, worst: 25 s, best: 5 s}", "{measure: t_e, weight: 0.5, worst: 25 s, best: 5 s}"
        )
    )
    project = replace(shipped, study=study)
    assert double_counting(project) == ()
    (shared,) = shared_measures(project)
    assert {"t_gc", "L"} <= set(shared.parts)


class TestPortfolios:
    LINE = "portfolio: {at_most: 1, member: component.gripper, studies: [{study: studies/pick_place.yaml, weight: 1}]}"

    def test_a_portfolio(self, shipped, measured, read):
        project = replace(shipped, study=read(*BOTH, self.LINE))
        choice = project.study.trade_off.portfolio
        assert (choice.at_most, choice.aim, choice.member) == (1, PortfolioAim.MEAN, "component.gripper")
        decision = choose_portfolio(project, {"studies/pick_place.yaml": (project, measured)})
        alone = choose(project, measured)
        assert decision.objective == pytest.approx(alone.ranking[0].value)
        assert decision.assignments[0].variant == alone.chosen
        assert decision.members == (
            next(e.variant.components["gripper"].id for e in measured if e.variant.id == alone.chosen),
        )

    def test_designs_that_screening_left_out_of_a_study(self, shipped, measured, read):
        line = "portfolio: {at_most: 2, studies: [{study: a.yaml, weight: 0.5}, {study: b.yaml, weight: 0.5}]}"
        study = replace(read(*BOTH, line), screening=Screening(fidelity=Fidelity.KINEMATIC, promotion=Promotion()))
        project = replace(shipped, study=study)
        alone = choose(project, measured)
        best = alone.ranking[0].variant

        decision = choose_portfolio(
            project,
            {"a.yaml": (project, measured), "b.yaml": (project, [one for one in measured if one.variant.id != best])},
        )

        first, second = decision.assignments
        assert first.variant == best
        assert second.variant == next(one.variant for one in alone.ranking if one.variant != best)

    def test_its_studies(self, folder, edit):
        edit(STUDY, "trade_off:\n", f"trade_off:\n  {self.LINE}\n")
        from rgss.studies.project import load_project

        projects = portfolio_projects(load_project(folder))
        assert list(projects) == ["studies/pick_place.yaml"]
        assert projects["studies/pick_place.yaml"].study.id == "pick_place"

    def test_no_portfolio_is_asked_for(self, shipped, measured):
        with pytest.raises(DefinitionError, match="study 'pick_place' has no portfolio"):
            choose_portfolio(shipped, {})

    def test_an_unknown_member(self, shipped, measured, read):
        project = replace(shipped, study=read(*BOTH, self.LINE.replace("component.gripper", "colour")))
        with pytest.raises(DefinitionError, match="unknown portfolio member 'colour'") as error:
            choose_portfolio(project, {"studies/pick_place.yaml": (project, measured)})
        assert "fingers" in error.value.hint
        by_factor = replace(shipped, study=read(*BOTH, self.LINE.replace("component.gripper", "fingers")))
        assert choose_portfolio(by_factor, {"studies/pick_place.yaml": (by_factor, measured)}).members in (
            ("two",),
            ("three",),
        )

    def test_studies_of_different_designs(self, shipped, measured, read):
        line = "portfolio: {at_most: 1, studies: [{study: a, weight: 0.5}, {study: b, weight: 0.5}]}"
        project = replace(shipped, study=read(*BOTH, line))
        first, second, *rest = measured
        exchanged = (
            replace(first, variant=replace(first.variant, parameters=second.variant.parameters)),
            second,
            *rest,
        )
        with pytest.raises(DefinitionError, match="variant 1 of b must be the same design as in the other studies"):
            choose_portfolio(project, {"a": (project, measured), "b": (project, exchanged)})
