"""Random level problems decided by HiGHS and by SCIP: how often the two agree, and with brute force.

Run it from the repository's folder: ``python benchmarks/third_solver.py [PROBLEMS [FIRST]]``, with the extra
``scip``. Neither enumeration nor interval branch and bound is used, so that the answer depends on the runs of
the solvers alone. It ends with 1 where an answer that is called optimal is wrong.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from typing import Any

from tradeoff_guard_cases import LevelCase, level_case

import rgss.tradeoff.levels.guard
import rgss.tradeoff.levels.problem
from rgss.errors import TradeoffError
from rgss.tradeoff import CheckKind, DecisionStatus, SolverCheck, SolverRun, decide_levels, independent_run

TOLERANCE = 1e-9


def opinion_of(case: LevelCase, run: SolverRun) -> tuple[str, str, str]:
    """Whether the decision is right, what SCIP came to, and what was proved."""
    try:
        decision = decide_levels(case.problem, independent=(run,))
    except TradeoffError:
        return "no answer", "", ""
    checks = decision.certificate.checks
    agrees = all(check.agrees for check in checks if check.kind is CheckKind.INDEPENDENT_SOLVER)
    if decision.variant is None:
        right = not case.any_feasible
    else:
        missed = case.missed_by(decision.variant - 1) if case.any_feasible else None
        right = missed is not None and missed <= TOLERANCE
    return "right" if right else "WRONG", "SCIP agrees" if agrees else "SCIP disagrees", decision.status.value


def main() -> int:
    """Decide the problems and write the counts as a table in Markdown."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    run = independent_run(SolverCheck.SCIP)
    bound = rgss.tradeoff.levels.guard.interval_bound

    def no_bound(*rest: Any, **more: Any) -> Any:
        return bound(*rest, **{**more, "most": 0})

    rgss.tradeoff.levels.problem.LARGEST_ENUMERATED = 0
    rgss.tradeoff.levels.guard.interval_bound = no_bound
    counts: Counter[tuple[str, str, str, str]] = Counter()
    start = time.process_time()
    for seed in range(first, first + number):
        case = level_case(seed)
        counts[(case.problem.program.name, *opinion_of(case, run))] += 1
    sys.stdout.write(f"{number} problems in {time.process_time() - start:.0f} s of one core\n\n")
    sys.stdout.write("| program | decision | opinion | status | count |\n|---|---|---|---|---|\n")
    for row, count in sorted(counts.items()):
        sys.stdout.write(f"| {' | '.join(row)} | {count} |\n")
    return int(any(right == "WRONG" and proved != DecisionStatus.BEST_FOUND.value for _, right, _, proved in counts))


if __name__ == "__main__":
    sys.exit(main())
