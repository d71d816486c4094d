"""``rgss planners``: planners compared on the moves of a study's task."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from rgss.cli.options import add_study, chosen_project
from rgss.cli.safe_output import errors_are_seen

if TYPE_CHECKING:
    from rgss.sweep import ComparedPlanner

HELP = "compare the designs' planners, and the study's references, on every move of the task"
EXAMPLE = "rgss planners --seeds 10"
MORE_EXAMPLES = (("rgss planners --only RRT,RRTConnect,PRM --seeds 30", "any planners of OMPL, or of the study"),)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    parser.add_argument("--seeds", type=int, metavar="N", help="number of seeds (default: the study's replicates)")
    parser.add_argument("--only", metavar="NAMES", help="these planners, by name, such as RRT,PRM")


def run(options: argparse.Namespace) -> int:
    """Plan every move with every planner and show the statistics."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.engines import require_engines
    from rgss.errors import DefinitionError
    from rgss.reports.study import planner_data
    from rgss.studies import MOST_REPLICATES
    from rgss.sweep import KeptSearches, compared_planners, limits_of

    require_engines("'rgss planners'")
    project = chosen_project(options)
    number = project.study.replicates if options.seeds is None else options.seeds
    if not 1 <= number <= MOST_REPLICATES:
        raise DefinitionError(f"--seeds must be from 1 to {MOST_REPLICATES}", hint="omit it for the study's number")
    seeds = range(project.study.seed, project.study.seed + number)
    names = [name.strip() for name in (options.only or "").split(",") if name.strip()]
    kept = KeptSearches.beside(project.evidence)
    compared = compared_planners(project, seeds=seeds, names=names, kept=kept, on_plan=_report)
    limits_s = limits_of(project)
    if options.json:
        print_json(
            {
                "seeds": list(seeds),
                "limits_s": list(limits_s),
                "planners": [planner_data(one, limits_s) for one in compared],
            }
        )
    else:
        _show(compared, limits_s, len(seeds))
    return CLEAN


def _report(done: int, total: int) -> None:
    """Progress on standard error, where that is a terminal."""
    if errors_are_seen():
        print(f"\rplanned {done} of {total}", end="\n" if done == total else "", file=sys.stderr, flush=True)


def _show(compared: Sequence[ComparedPlanner], limits_s: Sequence[float], seeds: int) -> None:
    from rgss.cli.output import print_table
    from rgss.reports.study import PLANNERS_NOTE, planner_table

    titles, rows = planner_table(compared, limits_s)
    print_table(titles, rows, right=tuple(range(2, len(titles))))
    print(f"{seeds} seed{'s' if seeds > 1 else ''}; {PLANNERS_NOTE}")
