"""Find equal settings for the source's planners over random scenes that no study contains; write tables in Markdown.

    python benchmarks/planner_settings.py                               range and goal bias of the source's planners
    python benchmarks/planner_settings.py --resolutions RANGE BIAS      share of paths that are not valid at 0.01 rad
    python benchmarks/planner_settings.py --planners RANGE BIAS         every planner that can be run, at one setting

A search has 8 s at 0.25 ms a check, which is 32,000 checks; it is cut off at the limits of 4 and 6 s afterwards, as a
search is a prefix of itself. The measure of a setting is the geometric mean over the planners of the mean checks of a
search, one that finds nothing being counted with its limit. Paths are not shortened. The same command gives the same
figures on any machine.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from statistics import fmean, median

from planner_scenes import random_cells

from rgss.evidence import PlanOutcome
from rgss.motion import SOURCE_PLANNERS, Objective, OnUnverified, PlannerSettings, PlanningClock, available_planners
from rgss.trials import PlanningSettings
from rgss.trials.planning import PlannedMove, plan_task
from rgss.trials.workcell import Workcell

RANGES_RAD = (0.3, 0.6, 1.0, 1.5, 2.13)
BIASES = (0.05, 0.2)
RESOLUTIONS_RAD = (0.02, 0.05, 0.107)
LIMITS_S = (4.0, 6.0, 8.0)
SCENES = 12
_CLOCK = PlanningClock(charge_s=0.00025)


@dataclass(frozen=True, kw_only=True)
class Searches:
    """The searches of one planner at one setting.

    Attributes:
        moves: Every move of every scene and seed.
    """

    moves: tuple[PlannedMove, ...]

    def checks(self, move: PlannedMove) -> int:
        """Checks of a move; those of the limit where it found nothing."""
        return move.checks if move.outcome is PlanOutcome.SOLVED else _CLOCK.checks_within(LIMITS_S[-1])

    @property
    def mean(self) -> float:
        """Mean of the checks."""
        return fmean(self.checks(move) for move in self.moves)

    @property
    def median(self) -> float:
        """Median of the checks."""
        return median(self.checks(move) for move in self.moves)

    def solved(self, limit_s: float) -> float:
        """Share that finds a path within a limit."""
        budget = _CLOCK.checks_within(limit_s)
        return fmean(move.outcome is PlanOutcome.SOLVED and move.checks <= budget for move in self.moves)

    @property
    def unverified(self) -> float:
        """Share of the paths found that are not valid at the resolution of the verification."""
        found = [move for move in self.moves if move.outcome is not PlanOutcome.BUDGET_SPENT]
        return fmean(move.outcome is PlanOutcome.NOT_VERIFIED for move in found) if found else math.nan

    @property
    def repaired(self) -> float:
        """Share of the paths found of which a motion was planned anew."""
        found = [move for move in self.moves if move.outcome is PlanOutcome.SOLVED]
        return fmean(move.repairs > 0 for move in found) if found else math.nan


def searches(
    cells: Iterable[Workcell], planner: PlannerSettings, settings: PlanningSettings, *, seeds: Sequence[int] = (1,)
) -> Searches:
    """The searches of a planner for every move of every scene."""
    plans = (
        plan_task(cell, planner, seed=seed, settings=settings, past_failures=True) for cell in cells for seed in seeds
    )
    return Searches(moves=tuple(move for plan in plans for move in plan.moves.values()))


def settings_of(resolution_rad: float, on_unverified: OnUnverified = OnUnverified.REPAIR) -> PlanningSettings:
    """Planning as the study does it, without shortening."""
    return PlanningSettings(
        clock=_CLOCK,
        search_limit_s=LIMITS_S[-1],
        resolution_rad=resolution_rad,
        verification_resolution_rad=0.01,
        on_unverified=on_unverified,
        simplification_checks=0,
    )


def planner_of(
    name: str, range_rad: float, goal_bias: float, objective: Objective = Objective.CLEARANCE
) -> PlannerSettings:
    """A planner at a setting, as far as it has these parameters."""
    known = available_planners()[name].parameters
    wanted = {"range": range_rad, "goal_bias": goal_bias}
    return PlannerSettings(
        algorithm=name,
        parameters=tuple((key, value) for key, value in wanted.items() if key in known),
        objective=objective if name == "TRRT" else None,
    )


def row(name: str, found: Searches) -> str:
    """A row of a table."""
    solved = " | ".join(f"{100 * found.solved(limit_s):.0f}" for limit_s in LIMITS_S)
    return f"| {name} | {solved} | {found.median:.0f} | {found.mean:.0f} |"


def scan_settings(cells: Sequence[Workcell], resolution_rad: float) -> None:
    """Every range with every goal bias."""
    limits = " | ".join(f"{limit_s:g} s (%)" for limit_s in LIMITS_S)
    _write(f"| planner, range (rad), goal bias | {limits} | median checks | mean checks |\n|---|---|---|---|---|---|")
    measures = {}
    for range_rad in RANGES_RAD:
        for bias in BIASES:
            means = []
            for name in SOURCE_PLANNERS:
                found = searches(cells, planner_of(name, range_rad, bias), settings_of(resolution_rad))
                means.append(found.mean)
                _write(row(f"{name}, {range_rad:g}, {bias:g}", found))
            measures[range_rad, bias] = math.exp(fmean(map(math.log, means)))
    _write("\n| range (rad) | goal bias | geometric mean of the mean checks |\n|---|---|---|")
    for (range_rad, bias), measure in sorted(measures.items(), key=lambda item: item[1]):
        _write(f"| {range_rad:g} | {bias:g} | {measure:.0f} |")


def scan_resolutions(cells: Sequence[Workcell], range_rad: float, bias: float) -> None:
    """How many paths are not valid between the states that a search checked, and what repairs cost."""
    _write(
        "| planner, resolution (rad) | not valid (%) | solved with repairs, 8 s (%) | mean checks |\n|---|---|---|---|"
    )
    for name in SOURCE_PLANNERS:
        for resolution_rad in (0.01, *RESOLUTIONS_RAD):
            planner = planner_of(name, range_rad, bias)
            failing = searches(cells, planner, settings_of(resolution_rad, OnUnverified.FAIL))
            repairing = searches(cells, planner, settings_of(resolution_rad))
            figures = (
                f"{100 * failing.unverified:.0f} | {100 * repairing.solved(LIMITS_S[-1]):.0f} | {repairing.mean:.0f}"
            )
            _write(f"| {name}, {resolution_rad:g} | {figures} |")


def scan_planners(
    cells: Sequence[Workcell], resolution_rad: float, range_rad: float, bias: float, names: Sequence[str]
) -> None:
    """Planners at one setting; TRRT with each of its costs and with none."""
    limits = " | ".join(f"{limit_s:g} s (%)" for limit_s in LIMITS_S)
    _write(f"| planner | {limits} | median checks | mean checks |\n|---|---|---|---|---|---|")
    for name in names:
        planner = planner_of(name, range_rad, bias)
        labelled = [(name, planner)]
        if name == "TRRT":
            costs = [(f"TRRT, {one.value}", replace(planner, objective=one)) for one in list(Objective)[1:]]
            labelled = [*costs, ("TRRT (no cost)", replace(planner, objective=None))]
        for label, one in labelled:
            _write(row(label, searches(cells, one, settings_of(resolution_rad))))


def _write(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def main() -> int:
    """Scan and write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=SCENES)
    parser.add_argument("--resolution", type=float, default=0.02, metavar="RAD", help="resolution of the searches")
    parser.add_argument("--resolutions", nargs=2, type=float, metavar=("RANGE", "BIAS"))
    parser.add_argument("--planners", nargs=2, type=float, metavar=("RANGE", "BIAS"))
    parser.add_argument("--only", default=",".join(available_planners()), metavar="NAMES", help="with --planners")
    options = parser.parse_args()
    cells = tuple(random_cells(options.scenes))
    _write(f"{len(cells)} scenes: {', '.join(cell.scene.id for cell in cells)}\n")
    if options.resolutions:
        scan_resolutions(cells, *options.resolutions)
    elif options.planners:
        scan_planners(cells, options.resolution, *options.planners, options.only.split(","))
    else:
        scan_settings(cells, options.resolution)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
