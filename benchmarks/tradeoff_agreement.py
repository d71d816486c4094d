"""Compare every program of the trade-off with enumeration on random problems; write a table in Markdown.

Run it from the repository's folder: ``python benchmarks/tradeoff_agreement.py [NUMBER] [PROGRAM ...]``.
"""

from __future__ import annotations

import math
import random
import sys
import time
from collections import Counter

from tradeoff_cases import random_portfolio, random_problem
from tradeoff_oracle import expected, expected_portfolio

from rgss.errors import TradeoffError
from rgss.tradeoff import DecisionStatus, TradeProblem, decide, decide_portfolio

PROGRAMS = ("additive", "lexicographic", "epsilon_constraint", "tchebycheff", "minimax_regret", "risk")
KINDS = (*PROGRAMS, *(f"{program} over levels" for program in PROGRAMS), "portfolio")


def main() -> int:
    """Decide the problems of every kind and count; 1 if one disagrees."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    kinds = [kind for kind in KINDS if not sys.argv[2:] or kind in sys.argv[2:]]
    out = sys.stdout
    out.write("| program | problems | agree | infeasible | tied | seconds |\n|---|---|---|---|---|---|\n")
    wrong = 0
    for kind in kinds:
        start = time.perf_counter()
        counts: Counter[str] = Counter()
        for seed in range(number):
            try:
                outcome = one_portfolio(seed) if kind == "portfolio" else one_problem(kind, seed)
            except TradeoffError as error:
                out.write(f"{error}\n")
                outcome = []
            counts.update(outcome)
            if "agree" not in outcome:
                out.write(f"disagreement: {kind}, seed {seed}\n")
        wrong += number - counts["agree"]
        seconds = time.perf_counter() - start
        row = (kind, number, counts["agree"], counts["infeasible"], counts["tied"], f"{seconds:.0f}")
        out.write("| " + " | ".join(map(str, row)) + " |\n")
        out.flush()
    return int(wrong > 0)


def problem_of(kind: str, seed: int) -> TradeProblem:
    """The random problem of a kind with a seed."""
    program, _, over = kind.partition(" over ")
    return random_problem(random.Random(f"{kind} {seed}"), program, levels=over == "levels")  # noqa: S311 - a sample, no secret


def one_problem(kind: str, seed: int) -> list[str]:
    """Decide one problem; returns its properties, with ``agree`` if the decision is right."""
    problem = problem_of(kind, seed)
    decision, answer = decide(problem, resamples=0), expected(problem)
    infeasible = {variant: broken for variant, broken in answer.violated.items() if broken}
    agree = (
        decision.ties == answer.tied
        and decision.chosen == (answer.tied[0] if answer.tied else None)
        and {one.variant: set(one.requirements) for one in decision.infeasible} == infeasible
        and decision.certificate.enumeration_agrees
    )
    if answer.objective is not None:
        ours = decision.certificate.objective
        agree = agree and ours is not None and math.isclose(ours, answer.objective, rel_tol=1e-9, abs_tol=1e-9)
    kinds = ["infeasible"] if not answer.tied else ["tied"] if len(answer.tied) > 1 else []
    return [*kinds, "agree"] if agree else kinds


def one_portfolio(seed: int) -> list[str]:
    """Choose one portfolio; ``agree`` if its objective is the right one."""
    problem = random_portfolio(random.Random(f"fleet {seed}"))  # noqa: S311 - a sample, no secret
    decision, best = decide_portfolio(problem), expected_portfolio(problem)
    if best is None:
        return ["infeasible", "agree"] if decision.status is DecisionStatus.INFEASIBLE else ["infeasible"]
    return ["agree"] if decision.objective is not None and math.isclose(decision.objective, best, abs_tol=1e-9) else []


if __name__ == "__main__":
    sys.exit(main())
