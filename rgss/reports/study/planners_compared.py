"""Planners compared on the same moves, as plain data and as a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rgss.evidence import PlanOutcome
from rgss.sweep import ComparedPlanner
from rgss.trace.views import value_in_words

PLANNERS_NOTE = "checks within which half and 90 % of all searches are solved; – if fewer are solved."
_DASH = "–"


def planner_data(one: ComparedPlanner, limits_s: Sequence[float]) -> dict[str, Any]:
    """A planner's searches as plain data.

    Args:
        one: The planner.
        limits_s: The planning limits of the designs in s, from the shortest.
    """
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


def planner_comparison(
    compared: Sequence[ComparedPlanner], limits_s: Sequence[float], seeds: Sequence[int]
) -> dict[str, Any]:
    """The comparison for a report: plain data, and the table.

    Args:
        compared: The planners.
        limits_s: The planning limits of the designs in s, from the shortest.
        seeds: The seeds of the searches.
    """
    titles, rows = planner_table(compared, limits_s)
    return {
        "seeds": list(seeds),
        "limits_s": list(limits_s),
        "planners": [planner_data(one, limits_s) for one in compared],
        "table": {"titles": titles, "rows": rows, "note": PLANNERS_NOTE},
    }


def planner_table(compared: Sequence[ComparedPlanner], limits_s: Sequence[float]) -> tuple[list[str], list[list[str]]]:
    """The titles and the rows of a table of planners; all columns but the first two are numbers.

    Args:
        compared: The planners.
        limits_s: The planning limits of the designs in s, from the shortest.
    """
    rows = []
    for one in compared:
        entry = planner_data(one, limits_s)
        rows.append(
            [
                one.label + (", reference" if one.is_reference else ""),
                _settings_text(entry),
                str(entry["searches"]),
                *(f"{100.0 * share:.0f} %" for share in entry["solved"]),
                *(_DASH if entry[key] is None else str(entry[key]) for key in ("checks_median", "checks_90")),
                value_in_words(entry["mean_time_s"]),
                value_in_words(entry["mean_path_m"]),
                str(entry["not_verified"]),
                str(entry["repaired"]),
            ]
        )
    titles = [
        "planner",
        "settings",
        "searches",
        *(f"solved in {limit_s:g} s" for limit_s in limits_s),
        "checks, median",
        "checks, 90 %",
        "time [s]",
        "path [m]",
        "not valid",
        "repaired",
    ]
    return titles, rows


def _settings_text(entry: dict[str, Any]) -> str:
    parts = [f"{name} {value:g}" for name, value in entry["parameters"].items()]
    parts += [] if entry["objective"] is None else [entry["objective"]]
    algorithm = [] if entry["algorithm"] == entry["name"] else [entry["algorithm"]]
    return ", ".join([*algorithm, *parts]) or "OMPL's defaults"
