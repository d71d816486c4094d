"""Random level problems decided by HiGHS and by SCIP: how often the two agree, and with brute force.

Run it from the repository's folder: ``python benchmarks/third_solver.py [PROBLEMS [FIRST [LARGEST]]]``, with the
extra ``scip``. Neither enumeration nor interval branch and bound is used, so that the answer depends on the runs of
the solvers alone. The problems have 10⁴ to LARGEST combinations, 10⁵ by default; every run ends, for it has a limit
of processor time. The table is written after each ten problems. It ends with 1 where an answer that is called
optimal is wrong.
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
    """Correctness of the decision, outcome of SCIP, and proofs."""
    try:
        decision = decide_levels(case.problem, independent=(run,))
    except TradeoffError:
        return "no answer", "", ""
    opinions = {one.agrees for one in decision.certificate.checks if one.kind is CheckKind.INDEPENDENT_SOLVER}
    opinion = "SCIP disagrees" if False in opinions else "SCIP not finished" if None in opinions else "SCIP agrees"
    if decision.variant is None:
        right = not case.any_feasible
    else:
        missed = case.missed_by(decision.variant - 1) if case.any_feasible else None
        right = missed is not None and missed <= TOLERANCE
    return "right" if right else "WRONG", opinion, decision.status.value


def main() -> int:
    """Decide the problems and write the counts as a table in Markdown."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    largest = float(sys.argv[3]) if len(sys.argv) > 3 else 1e5
    run = independent_run(SolverCheck.SCIP)
    bound = rgss.tradeoff.levels.guard.interval_bound

    def no_bound(*rest: Any, **more: Any) -> Any:
        return bound(*rest, **{**more, "most": 0})

    rgss.tradeoff.levels.problem.LARGEST_ENUMERATED = 0
    rgss.tradeoff.levels.guard.interval_bound = no_bound
    counts: Counter[tuple[str, str, str, str]] = Counter()
    start = time.perf_counter()
    for seed in range(first, first + number):
        case = level_case(seed, largest=largest)
        answer = opinion_of(case, run)
        counts[(case.problem.program.name, *answer)] += 1
        if answer[:2] != ("right", "SCIP agrees"):
            sys.stdout.write(f"level problem {seed}: {', '.join(answer)}\n")
        if (seed - first) % 10 == 9 or seed == first + number - 1:
            _write(counts, f"level problems {first} to {seed}", time.perf_counter() - start)
    return int(any(right == "WRONG" and proved != DecisionStatus.BEST_FOUND.value for _, right, _, proved in counts))


def _write(counts: Counter[tuple[str, str, str, str]], done: str, seconds: float) -> None:
    sys.stdout.write(f"\n{done}: after {seconds:.0f} s\n\n")
    sys.stdout.write("| program | decision | opinion | status | count |\n|---|---|---|---|---|\n")
    for row, count in sorted(counts.items()):
        sys.stdout.write(f"| {' | '.join(row)} | {count} |\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
