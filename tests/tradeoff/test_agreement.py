"""Every program against its definition, on random trade-offs; benchmarks/tradeoff_agreement.py runs 10,000 of each."""

from __future__ import annotations

import dataclasses
import math

import pytest

from rgss.tradeoff import DecisionStatus, best_alternatives, decide, decide_portfolio

PROGRAMS = ["additive", "lexicographic", "epsilon_constraint", "tchebycheff", "minimax_regret", "risk"]


@pytest.fixture
def problem_of(cases, seeded):
    def make(program, seed, *, levels=False):
        return cases.random_problem(seeded(f"test {program} {seed}"), program, levels=levels)

    return make


@pytest.fixture(scope="module")
def decided():
    """Decisions of random problems, each of which several tests look at."""
    made = {}

    def decide_once(key, problem):
        if key not in made:
            made[key] = decide(problem, resamples=0)
        return made[key]

    return decide_once


@pytest.mark.verifies("SYS-038")
@pytest.mark.parametrize("levels", [False, True], ids=["variants", "levels"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_agreement_with_enumeration(problem_of, oracle, decided, program, levels):
    tied = infeasible = 0
    for seed in range(16):
        problem = problem_of(program, seed, levels=levels)
        decision, answer = decided((program, seed, levels), problem), oracle.expected(problem)
        assert decision.ties == answer.tied
        assert decision.certificate.enumeration_agrees
        assert {one.variant: set(one.requirements) for one in decision.infeasible} == {
            variant: broken for variant, broken in answer.violated.items() if broken
        }
        if answer.objective is None:
            assert decision.status is DecisionStatus.INFEASIBLE
        else:
            assert decision.certificate.objective == pytest.approx(answer.objective, rel=1e-9, abs=1e-9)
        tied += len(answer.tied) > 1
        infeasible += not answer.tied
    assert infeasible
    assert tied or levels


def test_a_tail_on_its_limit_whose_gains_and_losses_cancel(cases, oracle, seeded):
    """Of the 10,000 of the benchmark the one whose feasibility once depended on the order of a sum."""
    problem = cases.random_problem(seeded("risk 7750"), "risk")
    decision, answer = decide(problem, resamples=0), oracle.expected(problem)
    cancelling = next(one for one in problem.alternatives if one.variant == 50)
    (bound,) = (risk for risk in problem.risks if risk.requirement == "tail:b")

    assert max(map(abs, cancelling.samples["b"])) > 1e11 * abs(bound.value)
    assert decision.ties == answer.tied
    assert decision.certificate.enumeration_agrees


@pytest.mark.parametrize("program", PROGRAMS)
def test_levels_and_variants_agree(problem_of, decided, program):
    for seed in range(5):
        over_levels = problem_of(program, seed, levels=True)
        over_variants = dataclasses.replace(over_levels, levels=None)
        one = decided((program, seed, True), over_levels)
        other = decide(over_variants, resamples=0)
        assert (one.status, one.chosen, one.ties, one.ranking) == (
            other.status,
            other.chosen,
            other.ties,
            other.ranking,
        )


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_best_alternatives_one_by_one(problem_of, oracle, program):
    for seed in range(4):
        problem = problem_of(program, seed, levels=seed % 2 == 1)
        certificates = best_alternatives(problem, 3)
        left = problem.alternatives
        feasible = len(left) - sum(bool(broken) for broken in oracle.expected(problem).violated.values())
        assert len(certificates) == min(3, feasible)
        for certificate in certificates:
            answer = oracle.expected(dataclasses.replace(problem, alternatives=left, levels=None))
            assert certificate.solver_choice in answer.tied
            left = tuple(one for one in left if one.variant != certificate.solver_choice)


def test_portfolios(cases, oracle, seeded):
    served = 0
    for seed in range(25):
        problem = cases.random_portfolio(seeded(f"test fleet {seed}"))
        decision, best = decide_portfolio(problem), oracle.expected_portfolio(problem)
        assert decision.enumeration_agrees
        if best is None:
            assert (decision.status, decision.objective) == (DecisionStatus.INFEASIBLE, None)
            continue
        served += 1
        assert decision.objective == pytest.approx(best, abs=1e-9)
        assert len(decision.members) <= problem.at_most
        values = {assignment.task: assignment.value for assignment in decision.assignments}
        mean = math.fsum(task.weight * values[task.name] for task in problem.tasks)
        assert decision.objective == pytest.approx(mean if problem.aim.value == "mean" else min(values.values()))
        for task in problem.tasks:
            assignment = next(one for one in decision.assignments if one.task == task.name)
            alternative = next(one for one in task.problem.alternatives if one.variant == assignment.variant)
            assert oracle.violations(task.problem, alternative) == set()
            assert assignment.value == pytest.approx(oracle.weighted_value(task.problem, alternative))
    assert served > 10
