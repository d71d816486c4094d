"""Decide a million variants by five measures: optimum, Pareto front and runner-up; write a table in Markdown.

Run it from the repository's folder: ``python benchmarks/tradeoff_scale.py [NUMBER]``. Each row is a
process of its own, so that its memory is its own. It is judged by processor time, which other work
on the machine does not lengthen; the wall clock is given beside it. The largest front, of which nothing is
dominated, is the worst case; it is run with a hundredth of the variants.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import time

import numpy as np

from rgss.tradeoff import (
    AdditiveValue,
    Aim,
    Comparison,
    EpsilonConstraint,
    EvidenceTable,
    Lexicographic,
    MinimaxRegret,
    PiecewiseValue,
    Program,
    Tchebycheff,
    Threshold,
    TradeProblem,
    Weighting,
    decide,
)
from rgss.tradeoff.problem.dominance import nondominated
from rgss.tradeoff.programs.enumeration import enumerate_alternatives

MEASURES = "abcde"


def programs() -> dict[str, Program]:
    """The programs by name."""
    limit = Threshold(requirement="limit:b", measure="b", comparison=Comparison.AT_LEAST, value=0.7, unit="1")
    aims = tuple(Aim(measure=measure, sense=Comparison.AT_LEAST, relative=0.05) for measure in MEASURES)
    return {
        "additive": AdditiveValue(),
        "lexicographic": Lexicographic(aims=aims),
        "epsilon_constraint": EpsilonConstraint(aim=aims[0], bounds=(limit,)),
        "tchebycheff": Tchebycheff(),
        "minimax_regret": MinimaxRegret(),
    }


def problem_of(number: int, program: Program, *, worst_case: bool) -> TradeProblem:
    """Uniform measures under three requirements; in the worst case what one gains another loses."""
    rng = np.random.default_rng(1)
    quantities = rng.dirichlet(np.ones(5), number) if worst_case else rng.random((number, 5))
    columns = {measure: quantities[:, place] for place, measure in enumerate(MEASURES)}
    return TradeProblem(
        alternatives=EvidenceTable.of(np.arange(1, number + 1), columns),
        thresholds=tuple(
            Threshold(
                requirement=f"R-{measure}",
                measure=measure,
                comparison=Comparison.AT_LEAST,
                value=0.0 if worst_case else 0.1,
                unit="1",
            )
            for measure in MEASURES[:3]
        ),
        value_functions=tuple(PiecewiseValue(measure=measure, worst=0.0, best=1.0) for measure in MEASURES),
        weighting=Weighting(weights=dict.fromkeys(MEASURES, 0.2)),
        program=program,
    )


def measure_one(number: int, name: str, *, worst_case: bool) -> None:
    """Decide once and write what it took, as JSON."""
    problem = problem_of(number, programs()[name], worst_case=worst_case)
    start, cpu = time.perf_counter(), time.process_time()
    decision = decide(problem)
    decided, decided_cpu = time.perf_counter() - start, time.process_time() - cpu
    start, cpu = time.perf_counter(), time.process_time()
    enumeration = enumerate_alternatives(problem)
    front = int(nondominated(enumeration.table.quantities[enumeration.feasible]).sum())
    front_s, front_cpu = time.perf_counter() - start, time.process_time() - cpu
    sys.stdout.write(
        json.dumps(
            {
                "variants": number,
                "program": name,
                "feasible": decision.counts.feasible,
                "considered": decision.certificate.considered,
                "chosen": decision.chosen,
                "runner_up": decision.runner_up,
                "front": front,
                "decide_s": decided,
                "decide_cpu_s": decided_cpu,
                "front_s": front_s,
                "front_cpu_s": front_cpu,
                "memory_gb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6,
            }
        )
        + "\n"
    )


def main() -> int:
    """Run each row in a process of its own; 1 if one takes more than ten seconds or two gigabytes."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    rows = [(number, name, "") for name in programs()] + [(number // 100, "additive", "worst")]
    out = sys.stdout
    heads = ("variants", "program", "feasible", "considered", "chosen", "runner_up", "front")
    heads += ("decide_s", "decide_cpu_s", "front_s", "front_cpu_s", "memory_gb")
    out.write("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads) + "\n")
    slow = False
    for row in rows:
        command = [sys.executable, __file__, "--one", *map(str, row)]
        told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)  # noqa: S603 - itself
        slow |= told["decide_cpu_s"] + told["front_cpu_s"] > 10.0 or told["memory_gb"] > 2.0
        cells = [f"{told[head]:.2f}" if isinstance(told[head], float) else str(told[head]) for head in heads]
        out.write("| " + " | ".join(cells) + " |\n")
        out.flush()
    return int(slow)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        measure_one(int(sys.argv[2]), sys.argv[3], worst_case=sys.argv[4] == "worst")
    else:
        sys.exit(main())
