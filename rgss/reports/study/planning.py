"""Planning times of a report: every search once, with the variants that share it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rgss.assessment import VariantMeasures, specs_read
from rgss.evidence import PlanOutcome, TrialRecord
from rgss.reports.plain_numbers import Plain, plain_number, plain_numbers
from rgss.studies import Project
from rgss.sweep import keys_of
from rgss.trials.code import versions
from rgss.trials.pieces import TrialSpec, digests_of

MOST_SEARCHES = 20_000
"""With more searches than this, each planner's distribution is given by quantiles, independent of the brush."""

_QUANTILES = 1_001


def planning_columns(project: Project, measured: Sequence[VariantMeasures]) -> Plain:
    """Planning times by planner.

    Variants that share a search differ in their time limits; the search with the longest limit is taken.
    A move that was not planned, because one before it failed, has no search.

    Returns:
        The planners, and a row for each search: planner, planning time with simplification (None if it
        found no path), the longest limit of the search, and the group of variants that share it.
    """
    records = {
        key: (place, record)
        for place, entry in enumerate(measured)
        for key, record in zip(entry.trials, entry.records, strict=True)
    }
    now = versions()
    longest: dict[str, tuple[TrialSpec, TrialRecord]] = {}
    sharing: dict[str, list[int]] = {}
    specs = specs_read(project, measured)
    for key, spec in zip(keys_of(specs), specs, strict=True):
        if key not in records:
            continue
        place, record = records[key]
        plan = digests_of(spec, now).plan
        sharing.setdefault(plan, []).append(place)
        if plan not in longest or spec.planning_limit_s > longest[plan][0].planning_limit_s:
            longest[plan] = (spec, record)
    groups: dict[tuple[int, ...], int] = {}
    rows = []
    for plan, (spec, record) in longest.items():
        group = groups.setdefault(tuple(dict.fromkeys(sharing[plan])), len(groups))
        rows += [
            (spec.planner, plain_number(planned.time_s if planned.outcome is PlanOutcome.SOLVED else None), group, spec)
            for planned in record.planning
            if planned.outcome is not PlanOutcome.NOT_RUN and planned.subtask in spec.searched
        ]
    planners = sorted({row[0] for row in rows})
    document: Plain = {
        "planners": [
            _summary(planner, [(time, spec.planning_limit_s) for name, time, _, spec in rows if name == planner])
            for planner in planners
        ],
        "simplification_limit_s": max(
            (spec.settings.planning.simplification_limit_s for *_, spec in rows), default=0.0
        ),
        "thinned": len(rows) > MOST_SEARCHES,
    }
    if len(rows) <= MOST_SEARCHES:
        document |= {
            "groups": [list(group) for group in groups],
            "planner": [planners.index(row[0]) for row in rows],
            "time_s": [row[1] for row in rows],
            "group": [row[2] for row in rows],
        }
    return document


def _summary(planner: str, searches: Sequence[tuple[float | None, float]]) -> Plain:
    times = np.array([time for time, _ in searches if time is not None])
    thinned = np.quantile(times, np.linspace(0.0, 1.0, _QUANTILES)) if len(times) else times
    quartiles = np.quantile(times, (0.0, 0.25, 0.5, 0.75, 1.0)).tolist() if len(times) else []
    return {
        "name": planner,
        "searches": len(searches),
        "solved": len(times),
        "longest_limit_s": max(limit for _, limit in searches),
        "quartiles_s": plain_numbers(quartiles),
        "quantiles_s": plain_numbers(thinned.tolist()) if len(times) > _QUANTILES else [],
    }
