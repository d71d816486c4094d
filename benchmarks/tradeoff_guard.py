"""Compare level problems of 10⁴ to 10⁶ combinations and portfolios with brute force; write a table in Markdown.

The brute force shares no code with the package. Each problem is decided twice: with all combinations evaluated
by the package, and by the solver with its checks alone (every third of those without a complete interval
branch and bound, so that it depends on runs of the solver). In one of four, larger tables are merged, so that
both forms of the program are tried.

Run it from the repository's folder: ``python benchmarks/tradeoff_guard.py [LEVEL_PROBLEMS] [PORTFOLIOS] [FIRST_SEED]``.
``python benchmarks/tradeoff_guard.py options [PROBLEMS]`` counts what the solver alone gets wrong with each set
of options, without any check.
"""

from __future__ import annotations

import itertools
import sys
import time
from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np
from tradeoff_guard_cases import LevelCase, PortfolioCase, level_case, portfolio_case, seven_factors

import rgss.tradeoff.levels.guard
import rgss.tradeoff.levels.problem
import rgss.tradeoff.levels.selection
from rgss.errors import TradeoffError
from rgss.tradeoff import DecisionStatus, PortfolioAim, decide_levels, decide_portfolio
from rgss.tradeoff.levels.selection import LevelModel, LevelSelection
from rgss.tradeoff.milp.stage import RUNS, SolverRun, StageSolver

TOLERANCE = 1e-9
MERGED = 1_000
"""Tables of up to so many entries are merged where the form with merged tables is tried."""

OLD_RUN = SolverRun(
    name="tolerances of 1e-10, no presolve",
    options={
        "mip_rel_gap": 0.0,
        "mip_abs_gap": 0.0,
        "mip_feasibility_tolerance": 1e-10,
        "primal_feasibility_tolerance": 1e-10,
        "dual_feasibility_tolerance": 1e-10,
        "presolve": "off",
        "threads": 1,
    },
)


def main() -> int:
    """Run the command of the arguments; 1 if anything is wrong."""
    if sys.argv[1:2] == ["options"]:
        return options(int(sys.argv[2]) if len(sys.argv) > 2 else 140)
    levels = int(sys.argv[1]) if len(sys.argv) > 1 else 2_000
    portfolios = int(sys.argv[2]) if len(sys.argv) > 2 else 500
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    counts: Counter[tuple[str, str]] = Counter()
    start = time.perf_counter()
    most = max(levels, 4 * portfolios)
    for place in range(most):
        if place < levels:
            case = level_case(first + place)
            for path in ("enumerated", "solver"):
                try:
                    outcome = level_outcome(case, path, seed=first + place)
                except TradeoffError as error:
                    outcome = f"error: {error}"
                counts[f"{case.problem.program.name}, {path}", outcome] += 1
                if outcome not in ("right", "infeasible, right"):
                    sys.stdout.write(f"level problem {first + place}, {path}: {outcome}\n")
                    sys.stdout.flush()
        if place % 4 == 0 and place // 4 < portfolios:
            portfolio = portfolio_case(first + place // 4)
            outcome = portfolio_outcome(portfolio)
            counts[f"portfolio, {portfolio.problem.aim.value}", outcome] += 1
            if outcome not in ("right", "infeasible, right"):
                sys.stdout.write(f"portfolio {first + place // 4}: {outcome}\n")
        if place % 20 == 19 or place == most - 1:
            done = f"level problems {first} to {first + min(place + 1, levels) - 1}" if levels else ""
            portfolios_done = (
                f"portfolios {first} to {first + min(place // 4 + 1, portfolios) - 1}" if portfolios else ""
            )
            _write(counts, ", ".join(filter(None, (done, portfolios_done))), time.perf_counter() - start)
    return int(any(outcome not in ("right", "infeasible, right") for _, outcome in counts))


def _write(counts: Mapping[tuple[str, str], int], done: str, seconds: float) -> None:
    sys.stdout.write(f"\n{done}: after {seconds:.0f} s\n\n| problems | outcome | count |\n|---|---|---|\n")
    for (kind, outcome), count in sorted(counts.items()):
        sys.stdout.write(f"| {kind} | {outcome.split(':')[0]} | {count} |\n")
    sys.stdout.flush()


def level_outcome(case: LevelCase, path: str, *, seed: int) -> str:
    """The decision of a level problem compared with brute force."""
    module, bound, tables = rgss.tradeoff.levels.problem, rgss.tradeoff.levels.guard, rgss.tradeoff.levels.selection
    enumerated, interval, merged = module.LARGEST_ENUMERATED, bound.interval_bound, tables.LARGEST_TABLE
    if seed % 4 == 0:
        tables.LARGEST_TABLE = MERGED
    if path == "solver":
        module.LARGEST_ENUMERATED = 0
        if seed % 3 == 0:
            bound.interval_bound = lambda *rest, **more: interval(*rest, **{**more, "most": 0})
    try:
        decision = decide_levels(case.problem)
    finally:
        module.LARGEST_ENUMERATED, bound.interval_bound, tables.LARGEST_TABLE = enumerated, interval, merged
    if decision.variant is None:
        return "infeasible, right" if not case.any_feasible else "FALSE INFEASIBLE"
    if not case.any_feasible:
        return "FALSE FEASIBLE"
    missed = case.missed_by(decision.variant - 1)
    if missed is None:
        return "NOT FEASIBLE"
    if missed > TOLERANCE:
        gap = decision.certificate.gap or 0.0
        honest = decision.status is DecisionStatus.BEST_FOUND and missed <= gap + TOLERANCE
        return "best found, within its gap" if honest else f"WRONG by {missed:.3g}"
    if decision.status is not DecisionStatus.OPTIMAL:
        return "best found, the optimum"
    return "right"


def portfolio_outcome(case: PortfolioCase) -> str:
    """The decision of a portfolio compared with all portfolios."""
    problem = case.problem
    decision = decide_portfolio(problem)
    found: list[float | None] = []
    for size in range(1, problem.at_most + 1):
        best: float | None = found[-1] if found else None
        for rows in itertools.combinations(range(len(case.values)), min(size, len(case.values))):
            top = case.values[list(rows)].max(axis=0)
            if (top >= 0.0).all():
                score = float(top @ case.weights) if problem.aim is PortfolioAim.MEAN else float(top.min())
                best = score if best is None else max(best, score)
        found.append(best)
    for ours, right in zip(decision.by_size, found, strict=True):
        if (ours is None) != (right is None):
            return "FALSE INFEASIBLE" if ours is None else "FALSE FEASIBLE"
        if ours is not None and right is not None and abs(ours - right) > TOLERANCE:
            return f"WRONG by {right - ours:.3g}"
    if decision.objective is None:
        return "infeasible, right" if decision.status is DecisionStatus.INFEASIBLE else "undecided"
    return "right" if decision.status is DecisionStatus.OPTIMAL else "best found, the optimum"


def options(number: int) -> int:
    """Count what the solver alone gets wrong, by its options, on problems of 7 factors of 6 levels."""
    counts: dict[str, Counter[str]] = {}
    for seed in range(number):
        case = seven_factors(seed)
        problem = case.problem
        model = LevelModel(
            space=problem.space,
            quantities=problem.tables,
            replicates={},
            alternative_of=problem.alternative,
            levels_of=problem.levels_of,
        )
        for run in (OLD_RUN, *RUNS):
            solver: Any = StageSolver(
                select=lambda model=model: LevelSelection(model),  # type: ignore[misc]
                constraints=problem.constraints,
                run=run,
            )
            try:
                chosen = problem.program.solve(problem, solver)[-1].alternative
                if chosen is None:
                    outcome = "false infeasible"
                else:
                    missed = case.missed_by(chosen.variant - 1)
                    outcome = "not feasible" if missed is None else "right" if missed <= TOLERANCE else "not optimal"
            except TradeoffError:
                outcome = "no answer"
            counts.setdefault(run.name, Counter())[outcome] += 1
        if seed % 10 == 9 or seed == number - 1:
            sys.stdout.write(f"after {seed + 1}: { ({name: dict(count) for name, count in counts.items()}) }\n")
            sys.stdout.flush()
    return 0


if __name__ == "__main__":
    np.seterr(all="raise", under="ignore")
    sys.exit(main())
