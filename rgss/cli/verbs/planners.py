"""``rgss planners``: planners compared on the moves of a study's task."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rgss.cli.options import add_study, chosen_project

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
    """Plan every move with every planner and show what it took."""
    from rgss.cli.main import CLEAN
    from rgss.cli.output import print_json
    from rgss.engines import require_engines
    from rgss.errors import DefinitionError
    from rgss.studies import MOST_REPLICATES
    from rgss.sweep import compared_planners, limits_of

    require_engines("'rgss planners'")
    project = chosen_project(options)
    number = project.study.replicates if options.seeds is None else options.seeds
    if not 1 <= number <= MOST_REPLICATES:
        raise DefinitionError(f"--seeds must be from 1 to {MOST_REPLICATES}", hint="omit it for the study's number")
    seeds = range(project.study.seed, project.study.seed + number)
    names = [name.strip() for name in (options.only or "").split(",") if name.strip()]
    compared = compared_planners(project, seeds=seeds, names=names, on_plan=_report)
    limits_s = limits_of(project)
    if options.json:
        print_json(
            {"seeds": list(seeds), "limits_s": list(limits_s), "planners": [_plain(one, limits_s) for one in compared]}
        )
    else:
        _show(compared, limits_s, len(seeds))
    return CLEAN


def _report(done: int, total: int) -> None:
    """Progress on standard error, where that is a terminal."""
    if sys.stderr.isatty():
        print(f"\rplanned {done} of {total}", end="\n" if done == total else "", file=sys.stderr, flush=True)


def _plain(one: ComparedPlanner, limits_s: Sequence[float]) -> dict[str, Any]:
    from rgss.evidence import PlanOutcome

    longest_s = limits_s[-1]
    objective = one.settings.objective
    return {
        "name": one.name,
        "label": one.label,
        "reference": one.is_reference,
        "algorithm": one.settings.algorithm,
        "parameters": dict(one.settings.parameters),
        "objective": None if objective is None else objective.value,
        "searches": len(one.moves(longest_s)),
        "solved": [one.solved(limit_s) for limit_s in limits_s],
        "checks_median": one.checks_quantile(0.5, longest_s),
        "checks_90": one.checks_quantile(0.9, longest_s),
        "mean_time_s": one.mean_time_s(longest_s),
        "mean_path_m": one.mean_path_m(longest_s),
        "not_verified": one.count(longest_s, lambda move: move.outcome is PlanOutcome.NOT_VERIFIED),
        "repaired": one.count(longest_s, lambda move: move.repairs > 0),
    }


def _show(compared: Sequence[ComparedPlanner], limits_s: Sequence[float], seeds: int) -> None:
    from rgss.cli.output import number, print_table

    rows = []
    for one in compared:
        entry = _plain(one, limits_s)
        rows.append(
            [
                one.label + (", reference" if one.is_reference else ""),
                _settings_text(entry),
                str(entry["searches"]),
                *(f"{100.0 * share:.0f} %" for share in entry["solved"]),
                *("–" if entry[key] is None else str(entry[key]) for key in ("checks_median", "checks_90")),
                number(entry["mean_time_s"]),
                number(entry["mean_path_m"]),
                str(entry["not_verified"]),
                str(entry["repaired"]),
            ]
        )
    solved = [f"solved in {limit_s:g} s" for limit_s in limits_s]
    titles = [
        "planner",
        "settings",
        "searches",
        *solved,
        "checks, median",
        "90 %",
        "time [s]",
        "path [m]",
        "not valid",
        "repaired",
    ]
    print_table(titles, rows, right=tuple(range(2, len(titles))))
    print(f"{seeds} seeds; checks within which half and 90 % of all searches are solved, – where fewer are.")


def _settings_text(entry: dict[str, Any]) -> str:
    parts = [f"{name} {value:g}" for name, value in entry["parameters"].items()]
    parts += [] if entry["objective"] is None else [entry["objective"]]
    algorithm = [] if entry["algorithm"] == entry["name"] else [entry["algorithm"]]
    return ", ".join([*algorithm, *parts]) or "OMPL's defaults"
