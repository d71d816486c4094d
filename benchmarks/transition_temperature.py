"""TRRT's initial temperature in the reference scene: which paths are RRT's, what they cost, and what they take.

    python benchmarks/transition_temperature.py [REPLICATES]

The moves of variants 5 and 65 are searched for with the study's range and goal bias and a limit of 8 s, and compared
where both planners found a path. The same command gives the same figures on any machine.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from statistics import fmean, median

from rgss.evidence import PlanOutcome
from rgss.motion import Objective, PlannerSettings
from rgss.studies import load_project, trial_specs
from rgss.trials import TrialSpec, cell_of, searches_of
from rgss.trials.planning import PlannedMove, state_cost

REPOSITORY = Path(__file__).parents[1]
VARIANTS = (65, 5)
LIMIT_S = 8.0
TEMPERATURES = (100.0, 10.0, 1.0, 0.1, 1e-3, 1e-6)

Move = tuple[TrialSpec, str, PlannedMove]


def main() -> int:
    """Write the table in Markdown."""
    replicates = int(sys.argv[1]) if sys.argv[1:] else 8
    project = load_project(REPOSITORY)
    own = dict(project.study.planning.planners["TRRT"].parameters)
    specs = [
        spec
        for number in VARIANTS
        for spec in trial_specs(project, variants=[project.designs.variant(number)], seeds=range(1, replicates + 1))
    ]
    rrt = _moves(specs, PlannerSettings(algorithm="RRT", parameters=tuple(sorted(own.items()))))
    out = sys.stdout
    out.write(
        f"RRT: {_solved(rrt)} of {len(rrt)} solved, median {median(move.checks for _, _, move in rrt):.0f} checks\n\n"
    )
    out.write("| initial temperature | solved | median checks | paths that are RRT's | cost of a path: TRRT | RRT |\n")
    out.write("|---:|---:|---:|---:|---:|---:|\n")
    for temperature in TEMPERATURES:
        parameters = tuple(sorted({**own, "init_temperature": temperature}.items()))
        found = _moves(specs, PlannerSettings(algorithm="TRRT", parameters=parameters, objective=Objective.CLEARANCE))
        both = [(a, b) for a, b in zip(rrt, found, strict=True) if _is_solved(a[2]) and _is_solved(b[2])]
        same = sum(a[2].path_rad.tobytes() == b[2].path_rad.tobytes() for a, b in both)
        checks = median(move.checks for _, _, move in found)
        costs = [fmean(_cost(move) for move in side) for side in zip(*both, strict=True)]
        out.write(
            f"| {temperature:g} | {_solved(found)} of {len(found)} | {checks:.0f} | {same} of {len(both)} "
            f"| {costs[1]:.1f} | {costs[0]:.1f} |\n"
        )
        out.flush()
    return 0


def _moves(specs: list[TrialSpec], settings: PlannerSettings) -> list[Move]:
    searched = (replace(spec, planner_settings=settings, planning_limit_s=LIMIT_S) for spec in specs)
    return [(spec, phase, move) for spec in searched for phase, move in searches_of(spec).moves.items()]


def _is_solved(move: PlannedMove) -> bool:
    return move.outcome is PlanOutcome.SOLVED


def _solved(moves: list[Move]) -> int:
    return sum(_is_solved(move) for _, _, move in moves)


def _cost(move: Move) -> float:
    """Sum of the increases of the cost between the states of a path, in 1/m."""
    spec, phase, planned = move
    cost = state_cost(cell_of(spec), phase, Objective.CLEARANCE)
    values = [] if cost is None else [cost(state) for state in planned.path_rad]
    return sum(max(0.0, after - before) for before, after in pairwise(values))


if __name__ == "__main__":
    sys.exit(main())
