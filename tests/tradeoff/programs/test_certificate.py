from __future__ import annotations

import math

import pytest

from rgss.tradeoff import DecisionStatus, decide
from rgss.tradeoff.milp.stage import StageSolution
from rgss.tradeoff.programs.certificate import certify
from rgss.tradeoff.programs.enumeration import enumerate_alternatives


@pytest.fixture
def certify_choice():
    def run(problem, variant, objective=None):
        status = DecisionStatus.INFEASIBLE if variant is None else DecisionStatus.OPTIMAL
        chosen = next((one for one in problem.alternatives if one.variant == variant), None)
        solution = StageSolution(
            name="value", status=status, alternative=chosen, objective=objective, gap=0.0, selection_error=0.0
        )
        considered = len(problem.alternatives)
        return certify(problem, enumerate_alternatives(problem), [solution], considered=considered)

    return run


def test_of_the_optimum(payload_and_time):
    certificate = decide(payload_and_time).certificate
    assert certificate.enumeration_agrees
    assert (certificate.status, certificate.solver, certificate.program) == (
        DecisionStatus.OPTIMAL,
        "HIGHS",
        "additive",
    )
    (stage,) = certificate.stages
    assert (stage.name, stage.variant, stage.gap) == ("value", 1, 0.0)
    assert (certificate.alternatives, certificate.considered) == (5, 5)
    assert certificate.solver_choice == 1
    assert certificate.objective == pytest.approx(0.5, abs=1e-9)
    assert certificate.objective_recomputed == 0.5
    assert certificate.gap == 0.0
    choose, payload, cost, evidence = certificate.residuals
    assert (choose.name, choose.margin) == ("choose exactly one", None)
    assert choose.residual <= 1e-9
    assert (payload.name, payload.residual) == ("R-1: P >= 0.8 kg", 0.0)
    assert payload.margin == pytest.approx(0.2)
    assert (cost.name, cost.residual, cost.margin) == ("R-2: cost <= 100 kg", 0.0, 0.0)
    assert (evidence.name, evidence.residual, evidence.margin) == ("evidence:t", 0.0, None)


def test_of_infeasibility(build_problem, certify_choice):
    problem = build_problem({1: {"a": 0.1}}, thresholds=[("R", "a", ">=", 0.2)])
    certificate = certify_choice(problem, None)
    assert certificate.enumeration_agrees
    assert (certificate.solver_choice, certificate.objective, certificate.objective_recomputed) == (None, None, None)
    assert certificate.gap is None
    assert certificate.residuals == ()


def test_any_of_the_tied_is_accepted(build_problem, certify_choice):
    problem = build_problem({1: {"a": 0.5}, 2: {"a": 0.5 + 5e-10}, 3: {"a": 0.5 - 2e-9}})
    assert certify_choice(problem, 1, 0.5).enumeration_agrees
    assert certify_choice(problem, 2, 0.5).enumeration_agrees
    assert not certify_choice(problem, 3, 0.5 - 2e-9).enumeration_agrees


def test_an_inferior_choice_is_not_certified(payload_and_time, certify_choice):
    certificate = certify_choice(payload_and_time, 3, 0.4375)
    assert not certificate.enumeration_agrees
    assert certificate.gap == pytest.approx(0.0625)


def test_a_choice_that_violates_a_threshold_is_not_certified(payload_and_time, certify_choice):
    certificate = certify_choice(payload_and_time, 2, 0.8)
    assert not certificate.enumeration_agrees
    payload = certificate.residuals[1]
    assert payload.residual == pytest.approx(0.4)
    assert payload.margin == pytest.approx(-0.4)


def test_a_choice_without_evidence_is_not_certified(build_problem, certify_choice):
    problem = build_problem(
        {1: {"a": None, "b": 0.0}, 2: {"a": 0.1, "b": None}, 3: {"a": 0.1, "b": 0.0}},
        thresholds=[("R", "b", ">=", 0.0)],
    )
    without_weighted = certify_choice(problem, 1, 0.0)
    assert not without_weighted.enumeration_agrees
    assert without_weighted.objective_recomputed is None
    assert without_weighted.residuals[2].residual == 1.0
    without_bounded = certify_choice(problem, 2, 0.1)
    assert not without_bounded.enumeration_agrees
    assert without_bounded.residuals[1].residual == math.inf


def test_a_wrong_objective_is_not_certified(payload_and_time, certify_choice):
    assert certify_choice(payload_and_time, 1, 0.5 + 1e-10).enumeration_agrees
    assert not certify_choice(payload_and_time, 1, 0.5 + 1e-8).enumeration_agrees


def test_a_wrong_status_is_not_certified(payload_and_time, build_problem, certify_choice):
    assert not certify_choice(payload_and_time, None).enumeration_agrees
    infeasible = build_problem({1: {"a": 0.1}}, thresholds=[("R", "a", ">=", 0.2)])
    certificate = certify_choice(infeasible, 1, 0.1)
    assert not certificate.enumeration_agrees
    assert certificate.gap is None
