"""From a trade-off to a certified decision."""

from __future__ import annotations

import math
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
    LimitedRuns,
    SolverLimitError,
    SolverRun,
    StageSolver,
    VariantSelection,
)
from rgss.tradeoff.programs import Certificate, TradeProblem, certify

if TYPE_CHECKING:
    from rgss.tradeoff.problem import Alternative
    from rgss.tradeoff.programs import Enumeration

MOST_DRAWN = 20_000_000
"""Largest number of alternatives that are evaluated in all when replicates are resampled to test a conflict."""


def decide(
    problem: TradeProblem,
    *,
    margin: float = 0.0,
    last_of_equals: bool = False,
    seed: int = 0,
    resamples: int | None = None,
    independent: tuple[SolverRun, ...] = (),
    time_limit: float | None = None,
) -> Decision:
    """Choose the best feasible alternative, prove it, and explain it.

    The mixed-integer programs are solved to optimality and the answer is compared with exhaustive enumeration.
    Of tied alternatives the solver may return any; the decision is one that no other surpasses in the quantities of
    the valued measures, which may lie beyond the ends of their value functions, and of these the smallest id, or the
    largest.

    Args:
        problem: The trade-off.
        margin: The practical margin: feasible alternatives whose value, distance or regret is
            within it of the best are listed as near-ties. Programs that compare quantities take
            the tolerance of their last measure instead.
        last_of_equals: Whether the largest id of tied alternatives is chosen; the smallest otherwise.
        seed: Seed of the draws that test a conflict against the noise of the replicates.
        resamples: Number of draws; 0 for none, 1,000 by default, fewer where alternatives are many.
        independent: Runs of other solvers than HiGHS; each solves the whole program as a further check.
        time_limit: Seconds for the runs of a solver over levels, in place of the limits of each run. One that
            exceeds it is a check that was not finished; the decision is then solved over the alternatives instead.

    Returns:
        The decision. That nothing is feasible is a decision too, with the status infeasible.

    Raises:
        TradeoffError: The margin is not one, or the time limit is not positive; the solver failed, proved
            neither optimality nor infeasibility, or contradicts enumeration. No decision is made then.
    """
    # Imported here so that the package itself loads without NumPy.
    from rgss.tradeoff.explanation import (
        contributions,
        excluded_better,
        find_runner_up,
        flat_measures,
        infeasible_alternatives,
        near_ties,
        ordered_ties,
        rank,
    )
    from rgss.tradeoff.programs import enumerate_alternatives

    if not (math.isfinite(margin) and margin >= 0.0):
        raise TradeoffError(
            f"practical margin must be at least 0, got {margin:g}", hint="a difference of value, such as 0.01"
        )
    enumeration = enumerate_alternatives(problem)
    certificate = _certified(problem, enumeration, (), independent, time_limit)
    ties, surpassed = ordered_ties(problem, enumeration, last_of_equals=last_of_equals)
    ranking = rank(enumeration, ties)
    chosen = ties[0] if ties else None
    runner_up = find_runner_up(enumeration, ranking, ties)
    better, deciding_requirements, better_count = excluded_better(problem, enumeration)
    return Decision(
        program=problem.program.name,
        objectives=enumeration.ordering.objectives,
        status=certificate.status,
        chosen=chosen,
        runner_up=runner_up,
        ties=ties,
        surpassed=surpassed,
        near_ties=near_ties(enumeration, ranking, ties, margin),
        ranking=ranking,
        infeasible=infeasible_alternatives(enumeration),
        excluded_better=better,
        deciding_requirements=deciding_requirements,
        chosen_contributions=contributions(problem, enumeration, chosen),
        runner_up_contributions=contributions(problem, enumeration, runner_up),
        conflicts=_explained(problem, enumeration, seed, resamples, last_of_equals=last_of_equals),
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
    time_limit: float | None = None,
) -> Certificate:
    """Solve the program without some alternatives; the certificate of an answer that enumeration shares."""
    with LimitedRuns(time_limit) as runs:
        if problem.levels is not None:
            form = _level_form(problem, enumeration, excluded, runs)
            found = _first_agreeing(problem, enumeration, form, independent)
            if isinstance(found, Certificate):
                return found
            if not isinstance(found, SolverLimitError):
                raise found
            # Enumeration decides. The same choice over alternatives is small, so that no run of it is limited.
            certificate = _first_agreeing(
                problem, enumeration, _variant_form(problem, enumeration, excluded), independent
            )
            if isinstance(certificate, Certificate):
                return _noted(certificate, found)
            raise certificate
    found = _first_agreeing(problem, enumeration, _variant_form(problem, enumeration, excluded), independent)
    if isinstance(found, Certificate):
        return found
    raise found


def _variant_form(
    problem: TradeProblem, enumeration: Enumeration, excluded: tuple[Alternative, ...]
) -> tuple[int, StageSolver]:
    """The program with a variable for each alternative that exact reduction leaves, and their number."""
    from rgss.tradeoff.reduction import reduced_rows

    considered = tuple(enumeration.table[int(row)] for row in reduced_rows(enumeration))
    left = {alternative.variant for alternative in considered}
    exclusions = tuple(Exclusion(alternative=one) for one in excluded if one.variant in left)
    constraints = (*problem.constraints, *exclusions)
    return len(considered), StageSolver(select=lambda: VariantSelection.of(considered), constraints=constraints)


def _level_form(
    problem: TradeProblem, enumeration: Enumeration, excluded: tuple[Alternative, ...], runs: LimitedRuns
) -> tuple[int, StageSolver]:
    """The program with variables for the levels, whose runs end, and the number of alternatives."""
    from rgss.tradeoff.levels import LevelModel, LevelSelection

    assert problem.levels is not None  # noqa: S101 - the caller looks
    considered = tuple(enumeration.table)
    model = LevelModel.of(problem.levels, considered, tuple(problem.measures_named))
    exclusions = tuple(Exclusion(alternative=one) for one in excluded)
    solver = StageSolver(
        select=lambda: LevelSelection(model),
        constraints=(*problem.constraints, *exclusions),
        solve_by=lambda program, run: runs.solve(program, run, brief=True),
    )
    return len(considered), solver


def _first_agreeing(
    problem: TradeProblem, enumeration: Enumeration, form: tuple[int, StageSolver], independent: tuple[SolverRun, ...]
) -> Certificate | TradeoffError:
    """The certificate of the first run that enumeration agrees with, checked by the independent runs.

    Returns:
        The certificate; or the error of the last run, of which an exceeded limit is the least.
    """
    count, solver = form

    def answer_of(run: SolverRun) -> Certificate | TradeoffError:
        """Certificate of a run confirmed by enumeration, or the reason why there is none."""
        try:
            solutions = problem.program.solve(problem, replace(solver, run=run))
        except TradeoffError as error:
            return error
        certificate = certify(problem, enumeration, solutions, considered=count)
        agrees = certificate.enumeration_agrees is Agreement.AGREED
        return certificate if agrees else _disagreement(enumeration, certificate)

    error: TradeoffError | None = None
    for run in RUNS:
        answer = answer_of(run)
        if isinstance(answer, Certificate):
            certificate = answer if error is None else _noted(answer, error)
            for other in independent:
                certificate = _checked_by(certificate, other, answer_of(other))
            return certificate
        if error is None or not isinstance(answer, SolverLimitError):
            error = answer
    assert error is not None  # noqa: S101 - there is at least one run
    return error


def _checked_by(certificate: Certificate, run: SolverRun, answer: Certificate | TradeoffError) -> Certificate:
    """The certificate with the answer of an independent solver, whose name it takes on where that agrees."""
    if isinstance(answer, TradeoffError):
        agrees = None if isinstance(answer, SolverLimitError) else False
        check = Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=agrees, detail=f"{run.name}: {answer.message}")
        return replace(certificate, checks=(*certificate.checks, check))
    check = Check(kind=CheckKind.INDEPENDENT_SOLVER, agrees=True, detail=f"{run.name} comes to the same answer")
    return replace(certificate, solver=f"{certificate.solver} and {run.solver}", checks=(*certificate.checks, check))


def _noted(certificate: Certificate, error: TradeoffError) -> Certificate:
    """Certificate with a note on an earlier run."""
    if isinstance(error, SolverLimitError):
        check = Check(kind=CheckKind.SECOND_RUN, agrees=None, detail=f"an earlier run over levels: {error.message}")
    else:
        detail = f"an earlier run was discarded: {error.message}"
        check = Check(kind=CheckKind.SECOND_RUN, agrees=False, detail=detail)
    return replace(certificate, checks=(*certificate.checks, check))


def _explained(
    problem: TradeProblem, enumeration: Enumeration, seed: int, resamples: int | None, *, last_of_equals: bool
) -> Conflicts | None:
    """Explanation of infeasibility, with repairs and its stability under noise; None if something is feasible."""
    conflicts = find_conflicts(enumeration)
    if conflicts is None:
        return None
    from rgss.tradeoff.infeasibility import RESAMPLES, conflict_survival, with_repairs

    conflicts = with_repairs(problem, enumeration, conflicts, last_of_equals=last_of_equals)
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
