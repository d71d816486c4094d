"""From a trade-off to a certified decision."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.tradeoff.decision import Counts, Decision
from rgss.tradeoff.infeasibility import Conflicts, find_conflicts
from rgss.tradeoff.milp import (
    RUNS,
    Agreement,
    Check,
    CheckKind,
    Exclusion,
    Selection,
    SolverRun,
    StageSolver,
    VariantSelection,
)
from rgss.tradeoff.programs import Certificate, TradeProblem, certify

if TYPE_CHECKING:
    from rgss.tradeoff.problem import Alternative
    from rgss.tradeoff.programs import Enumeration

MOST_DRAWN = 20_000_000
"""So many alternatives are looked at in all when replicates are drawn anew to test a conflict."""


def decide(
    problem: TradeProblem,
    *,
    margin: float = 0.0,
    seed: int = 0,
    resamples: int | None = None,
    independent: tuple[SolverRun, ...] = (),
) -> Decision:
    """Choose the best feasible alternative, prove it, and explain it.

    The mixed-integer programs are solved to optimality and the answer is compared with exhaustive enumeration.
    Of tied alternatives the solver may return any; the decision is the smallest id.

    Args:
        problem: The trade-off.
        margin: The practical margin: feasible alternatives whose value, distance or regret is
            within it of the best are listed as near-ties. Programs that look at quantities take
            the tolerance of their last measure instead.
        seed: Seed of the draws that test a conflict against the noise of the replicates.
        resamples: How many draws; 0 for none, 1,000 by default, fewer where alternatives are many.
        independent: Runs of other solvers than HiGHS; each solves the whole program as a further check.

    Returns:
        The decision. That nothing is feasible is a decision too, with the status infeasible.

    Raises:
        TradeoffError: The margin is not one; the solver failed, proved neither optimality nor
            infeasibility, or contradicts enumeration. No decision is made then.
    """
    # Imported here so that the package itself loads without NumPy.
    from rgss.tradeoff.explanation import (
        contributions,
        excluded_better,
        find_runner_up,
        flat_measures,
        infeasible_alternatives,
        near_ties,
        rank,
    )
    from rgss.tradeoff.programs import enumerate_alternatives

    if not (math.isfinite(margin) and margin >= 0.0):
        raise TradeoffError(f"the practical margin is {margin:g}", hint="give a value from 0 on, such as 0.01")
    enumeration = enumerate_alternatives(problem)
    certificate = _certified(problem, enumeration, (), independent)
    ties = tuple(int(variant) for variant in enumeration.variants[enumeration.tied])
    ranking = rank(enumeration)
    chosen = ties[0] if ties else None
    runner_up = find_runner_up(enumeration, ranking, ties)
    better, deciding_requirements, better_count = excluded_better(enumeration)
    return Decision(
        program=problem.program.name,
        objectives=enumeration.ordering.objectives,
        status=certificate.status,
        chosen=chosen,
        runner_up=runner_up,
        ties=ties,
        near_ties=near_ties(enumeration, ranking, ties, margin),
        ranking=ranking,
        infeasible=infeasible_alternatives(enumeration),
        excluded_better=better,
        deciding_requirements=deciding_requirements,
        chosen_contributions=contributions(problem, enumeration, chosen),
        runner_up_contributions=contributions(problem, enumeration, runner_up),
        conflicts=_explained(problem, enumeration, seed, resamples),
        flat_measures=flat_measures(problem, enumeration),
        demands=problem.demands,
        counts=Counts(
            alternatives=len(enumeration.table),
            feasible=int(enumeration.feasible.sum()),
            excluded_better=better_count,
        ),
        certificate=certificate,
    )


def best_alternatives(problem: TradeProblem, count: int) -> tuple[Certificate, ...]:
    """The n best alternatives, each proven to be the best without those before.

    Args:
        problem: The trade-off.
        count: How many are wanted.

    Returns:
        A certificate for each; fewer where fewer are feasible. Of tied alternatives the solver
        may give any first.

    Raises:
        TradeoffError: As for `decide`.
    """
    from rgss.tradeoff.programs import enumerate_alternatives

    found: list[Certificate] = []
    excluded: tuple[Alternative, ...] = ()
    for _ in range(count):
        enumeration = enumerate_alternatives(problem, excluded=[one.variant for one in excluded])
        if not enumeration.feasible.any():
            break
        certificate = _certified(problem, enumeration, excluded)
        found.append(certificate)
        if certificate.solver_choice is not None:
            excluded = (*excluded, enumeration.table[enumeration.table.row_of(certificate.solver_choice)])
    return tuple(found)


def _certified(
    problem: TradeProblem,
    enumeration: Enumeration,
    excluded: tuple[Alternative, ...],
    independent: tuple[SolverRun, ...] = (),
) -> Certificate:
    """Solve the program without some alternatives; the certificate of an answer that enumeration shares."""
    if problem.levels is None:
        from rgss.tradeoff.reduction import reduced_rows

        considered = tuple(enumeration.table[int(row)] for row in reduced_rows(enumeration))
        left = {alternative.variant for alternative in considered}
        select: Callable[[], Selection] = lambda: VariantSelection.of(considered)  # noqa: E731
        exclusions = tuple(Exclusion(alternative=one) for one in excluded if one.variant in left)
    else:
        from rgss.tradeoff.levels import LevelModel, LevelSelection

        considered = tuple(enumeration.table)
        model = LevelModel.of(problem.levels, considered, tuple(problem.measures_named))
        select = lambda: LevelSelection(model)  # noqa: E731
        exclusions = tuple(Exclusion(alternative=one) for one in excluded)

    def answer_of(run: SolverRun) -> Certificate | TradeoffError:
        """The certificate of a run that enumeration agrees with; or why there is none."""
        solver = StageSolver(select=select, constraints=(*problem.constraints, *exclusions), run=run)
        try:
            solutions = problem.program.solve(problem, solver)
        except TradeoffError as error:
            return error
        certificate = certify(problem, enumeration, solutions, considered=len(considered))
        agrees = certificate.enumeration_agrees is Agreement.AGREED
        return certificate if agrees else _disagreement(enumeration, certificate)

    contradicted: TradeoffError | None = None
    for run in RUNS:
        answer = answer_of(run)
        if isinstance(answer, Certificate):
            certificate = _noted(answer, contradicted)
            for other in independent:
                certificate = _checked_by(certificate, other, answer_of(other))
            return certificate
        contradicted = answer
    assert contradicted is not None  # noqa: S101 - there is at least one run
    raise contradicted


def _checked_by(certificate: Certificate, run: SolverRun, answer: Certificate | TradeoffError) -> Certificate:
    """The certificate with the answer of an independent solver, whose name it takes on where that agrees."""
    if isinstance(answer, TradeoffError):
        detail = f"{run.name}: {answer.message}"
        check = Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=False, detail=detail)
        return replace(certificate, checks=(*certificate.checks, check))
    check = Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=True, detail=f"{run.name} comes to the same answer")
    return replace(certificate, solver=f"{certificate.solver} and {run.solver}", checks=(*certificate.checks, check))


def _noted(certificate: Certificate, contradicted: TradeoffError | None) -> Certificate:
    """The certificate with the answer of an earlier run that was discarded."""
    if contradicted is None:
        return certificate
    check = Check(
        kind=CheckKind.SECOND_RUN, agrees=False, detail=f"an earlier run was discarded: {contradicted.message}"
    )
    return replace(certificate, checks=(*certificate.checks, check))


def _explained(problem: TradeProblem, enumeration: Enumeration, seed: int, resamples: int | None) -> Conflicts | None:
    """Why nothing is feasible, how that could be mended, and whether noise might; None if something is."""
    conflicts = find_conflicts(enumeration)
    if conflicts is None:
        return None
    from rgss.tradeoff.infeasibility import RESAMPLES, conflict_survival, find_joint_repairs, find_repairs

    conflicts = replace(
        conflicts,
        repairs=find_repairs(problem, enumeration),
        joint_repairs=find_joint_repairs(problem, enumeration, conflicts.corrections),
    )
    if resamples is None:
        resamples = max(100, min(RESAMPLES, MOST_DRAWN // len(enumeration.table)))
    if resamples == 0:
        return conflicts
    return conflict_survival(problem, enumeration.table, conflicts, resamples=resamples, seed=seed)


def _disagreement(enumeration: Enumeration, certificate: Certificate) -> TradeoffError:
    best = enumeration.best_row
    ours = "nothing feasible"
    if best is not None:
        ours = f"variant {int(enumeration.variants[best])} ({enumeration.ordering.at(best)[-1]})"
    theirs = (
        "nothing feasible"
        if certificate.solver_choice is None
        else f"variant {certificate.solver_choice} ({certificate.objective})"
    )
    return TradeoffError(
        f"the solver finds {theirs}, enumeration finds {ours}",
        hint="no decision is made on contradictory answers; look for measures of extreme magnitude",
    )
