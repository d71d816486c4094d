"""A portfolio: at most k designs that together serve several tasks, each by the one that does it best."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import Agreement, Check, CheckKind, DecisionStatus, SolverRun
from rgss.tradeoff.portfolio.checks import (
    LARGEST_SOLVED,
    PORTFOLIO_RUN,
    PortfolioAim,
    best_portfolio,
    portfolio_objective,
    solved_portfolio,
)
from rgss.tradeoff.portfolio.decision import Assignment, PortfolioDecision
from rgss.tradeoff.portfolio.problem import PortfolioProblem, PortfolioTask
from rgss.tradeoff.portfolio.work import MOST_WORK, Cut, WorkBudget
from rgss.tradeoff.problem import TIE_TOLERANCE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from rgss.tradeoff.portfolio.mean import SizeAnswer


def decide_portfolio(
    problem: PortfolioProblem,
    *,
    time_limit: float | None = None,
    most_work: int = MOST_WORK,
    independent: tuple[SolverRun, ...] = (),
) -> PortfolioDecision:
    """Choose the best portfolio, with a bound on the possible improvement.

    A member's value in a task is that of its best feasible alternative. Members dominated by another in every task are
    removed first. For each size a portfolio is found by greedy search with exchanges, and proven by branch and bound:
    with Lagrangian bounds for the mean, over covers for the worst task. Both bounds are computed in NumPy from the
    values only; the weights of cover bounds are proposed by a linear program, and valid for any of its solutions. If
    the problem is small enough, HiGHS also solves the mixed-integer program, and all portfolios are enumerated; better
    results are used.

    Args:
        problem: The problem.
        time_limit: Time limit of the proofs in s, instead of the work limit; the result then depends on the machine.
        most_work: Work limit: number of evaluated values, independent of the machine.
        independent: Runs of solvers other than HiGHS, made whenever HiGHS solves the program.

    Raises:
        TradeoffError: The time limit is not positive.
    """
    import numpy as np

    if time_limit is not None and not (math.isfinite(time_limit) and time_limit > 0.0):
        raise TradeoffError(f"the time limit must be positive, got {time_limit:g} s", hint="give seconds, such as 60")
    end_s = math.inf if time_limit is None else time.monotonic() + time_limit
    names, values, best_variants = _member_values(problem)
    weights = np.array([task.weight for task in problem.tasks])
    unserved = tuple(task.name for task, column in zip(problem.tasks, values.T, strict=True) if (column < 0.0).all())
    kept = _undominated(values)
    answers, cut = _by_size(problem, values[kept], weights, time_limit, most_work)
    best, bound = answers[-1].objective, answers[-1].bound
    # Of equally good sizes the smallest.
    rows = next(one.rows for one in answers if one.objective >= best - TIE_TOLERANCE)
    rows, checks = _checked(problem, values[kept], weights, rows, independent, end_s)
    enumerated = best_portfolio(values[kept], weights, problem.at_most, problem.aim)
    agreement = Agreement.NOT_ENUMERATED
    if enumerated is not None:
        found = enumerated[0] or ()
        same = abs(enumerated[1] - _score(problem, values[kept], weights, answers[-1].rows)) <= TIE_TOLERANCE
        agreement = Agreement.AGREED if same else Agreement.DISAGREED
        rows, bound, cut = found, enumerated[1], None
        checks.append(Check(kind=CheckKind.ENUMERATION, agrees=same, detail="all portfolios evaluated"))
    objective = _score(problem, values[kept], weights, rows)
    # A member that serves no task best is left out.
    chosen = sorted({int(kept[rows[place]]) for place in values[kept[list(rows)]].argmax(axis=0)}) if rows else []
    by_size, gaps = _sizes(answers, objective, bound, problem.at_most)
    if rows:
        # A portfolio above its bound contradicts the proof, so that nothing is proven.
        proven = abs(bound - objective) <= TIE_TOLERANCE
        status = DecisionStatus.OPTIMAL if proven else DecisionStatus.BEST_FOUND
    else:
        status = DecisionStatus.INFEASIBLE if bound < 0.0 else DecisionStatus.UNDECIDED
    recomputed = float(portfolio_objective(values[chosen], weights, problem.aim)) if chosen else None
    return PortfolioDecision(
        status=status,
        members=tuple(names[row] for row in chosen),
        assignments=tuple(
            _assignment(task, [(float(values[row, at]), -best_variants[row][at], names[row]) for row in chosen])
            for at, task in enumerate(problem.tasks)
            if chosen
        ),
        objective=objective if rows else None,
        by_size=by_size,
        by_size_gap=gaps,
        unserved=unserved,
        gap=max(0.0, bound - objective) if rows else None,
        objective_recomputed=recomputed,
        considered=len(kept),
        enumeration_agrees=agreement,
        checks=tuple(checks),
        cut=cut,
    )


def _by_size(
    problem: PortfolioProblem,
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    time_limit: float | None,
    most_work: int,
) -> tuple[list[SizeAnswer], Cut | None]:
    """Best portfolio of each size, each at least as good as the previous one, and the limit that ended a proof."""
    from rgss.tradeoff.portfolio.mean import best_mean
    from rgss.tradeoff.portfolio.primal import profits_of, search_portfolio
    from rgss.tradeoff.portfolio.worst import best_worst, worst_of

    profits = profits_of(values, weights)
    sizes = range(1, min(problem.at_most, len(values)) + 1)
    began = time.monotonic()
    answers: list[SizeAnswer] = []
    cut: Cut | None = None
    rows: tuple[int, ...] = ()
    left = most_work
    for size in sizes:
        # Half is kept for the last size, which is decided; of the other half each may take a quarter of what is left.
        last = size == sizes[-1]
        if time_limit is None:
            work = WorkBudget(left if last else max(0, left - most_work // 2) // 4)
        else:
            now = time.monotonic()
            end = began + time_limit if last else now + max(0.0, began + time_limit / 2.0 - now) / 4.0
            work = WorkBudget(None, end)
        if problem.aim is PortfolioAim.MEAN:
            answer = best_mean(profits, size, rows, TIE_TOLERANCE, work)
        else:
            candidates = (rows, search_portfolio(profits, size, (rows,)))
            start = max(candidates, key=lambda one: worst_of(values, one))
            answer = best_worst(values, size, start, TIE_TOLERANCE, work)
        if answers and answers[-1].rows and answer.objective < answers[-1].objective:
            answer = replace(answers[-1], bound=max(answer.bound, answers[-1].objective))
        answers.append(answer)
        rows = answer.rows
        cut = cut or work.cut
        left -= work.done
    # More members never serve worse, so what bounds many bounds fewer as well.
    for at in range(len(answers) - 2, -1, -1):
        answers[at] = replace(answers[at], bound=min(answers[at].bound, answers[at + 1].bound))
    return answers, cut


def _checked(
    problem: PortfolioProblem,
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    rows: tuple[int, ...],
    independent: tuple[SolverRun, ...],
    end_s: float,
) -> tuple[tuple[int, ...], list[Check]]:
    """The better of a portfolio and the solvers' ones, and the checks of the solvers, until a time of the clock."""
    checks: list[Check] = []
    is_small = values.size <= LARGEST_SOLVED
    runs = [(PORTFOLIO_RUN, "HiGHS", CheckKind.SECOND_RUN)] if is_small else []
    runs += [(run, run.name, CheckKind.INDEPENDENT_SOLVER) for run in independent]
    for run, name, kind in runs:
        left_s = end_s - time.monotonic()
        why = "" if left_s > 0.0 else "the time limit is spent"
        if not is_small:
            why = f"the program has {values.size} values, and at most {LARGEST_SOLVED} are solved"
        if why:
            checks.append(Check(kind=kind, agrees=None, detail=f"{name} not run: {why}"))
            continue
        rows, check = _compared(problem, values, weights, rows, _within(run, left_s, kind), name, kind)
        checks.append(check)
    return rows, checks


def _within(run: SolverRun, left_s: float, kind: CheckKind) -> SolverRun:
    """The run of HiGHS with the time that is left; other solvers have other names for the option."""
    if kind is not CheckKind.SECOND_RUN or math.isinf(left_s):
        return run
    return replace(run, options={**run.options, "time_limit": left_s})


def _compared(
    problem: PortfolioProblem,
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    rows: tuple[int, ...],
    run: SolverRun,
    name: str,
    kind: CheckKind,
) -> tuple[tuple[int, ...], Check]:
    """The better of a portfolio and that of one run, and the check of the run."""
    ours = _score(problem, values, weights, rows)
    try:
        found = solved_portfolio(values, weights, min(problem.at_most, len(values)), problem.aim, run) or ()
    except TradeoffError as error:
        subject = "" if kind is CheckKind.SECOND_RUN else f"{name}: "
        detail = f"{subject}the mixed-integer program was not completed: {error.message}"
        return rows, Check(kind=kind, agrees=None, detail=detail)
    theirs = _score(problem, values, weights, found)
    agrees = abs(theirs - ours) <= TIE_TOLERANCE
    detail = f"{name} on the mixed-integer program"
    if not agrees:
        detail += f": {'no portfolio' if theirs < 0.0 else f'{theirs:.9g}'} instead of {ours:.9g}; the better is used"
    better = found if theirs > ours + TIE_TOLERANCE else rows
    return better, Check(kind=kind, agrees=agrees, detail=detail)


def _score(
    problem: PortfolioProblem, values: NDArray[np.float64], weights: NDArray[np.float64], rows: tuple[int, ...]
) -> float:
    """Objective of a portfolio; -1 if it is empty or does not serve a task."""
    return float(portfolio_objective(values[list(rows)], weights, problem.aim)) if rows else -1.0


def _sizes(
    answers: list[SizeAnswer], objective: float, bound: float, at_most: int
) -> tuple[tuple[float | None, ...], tuple[float | None, ...]]:
    """Objective and gap of each size; the last is the decision."""
    found = [*answers[:-1], replace(answers[-1], objective=objective, bound=max(bound, objective))]
    found += found[-1:] * (at_most - len(found))
    known = [one if one.objective >= 0.0 else None for one in found]
    return (
        tuple(None if one is None else one.objective for one in known),
        tuple(None if one is None else max(0.0, one.bound - one.objective) for one in known),
    )


def _assignment(task: PortfolioTask, offers: list[tuple[float, int, str]]) -> Assignment:
    """The best offer of the members; of equals, the smallest id."""
    value, negated, member = max(offers)
    return Assignment(task=task.name, member=member, variant=-negated, value=value)


def _member_values(problem: PortfolioProblem) -> tuple[list[str], NDArray[np.float64], list[list[int]]]:
    """Every member's best value in every task, -1 where it cannot serve it, and the alternative that gives it."""
    import numpy as np

    from rgss.tradeoff.programs import enumerate_alternatives

    variants = sorted(problem.tasks[0].variants)
    offered = np.full((len(variants), len(problem.tasks)), -1.0)
    for at, task in enumerate(problem.tasks):
        found = enumerate_alternatives(task.problem)
        offered[np.searchsorted(variants, found.variants), at] = np.where(found.feasible, found.values, -1.0)
    rows: dict[str, list[int]] = {}
    for row, variant in enumerate(variants):
        rows.setdefault(str(variant) if problem.groups is None else problem.groups[variant], []).append(row)
    values = np.stack([offered[members].max(axis=0) for members in rows.values()])
    best = [[variants[members[at]] for at in offered[members].argmax(axis=0)] for members in rows.values()]
    return list(rows), values, best


def _undominated(values: NDArray[np.float64]) -> NDArray[np.intp]:
    """Members that no other is at least as good as in every task; of equals the first."""
    import numpy as np

    from rgss.tradeoff.problem import nondominated

    _, first = np.unique(values, axis=0, return_index=True)
    rows = np.sort(first)
    return np.asarray(rows[nondominated(values[rows])], dtype=np.intp)
