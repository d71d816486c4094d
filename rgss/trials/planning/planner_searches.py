"""Searches of a planner for every move of a task, including moves after one without a path."""

from __future__ import annotations

from rgss.trials.planning.plan import plan_task
from rgss.trials.planning.planned_moves import TaskPlan
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import cell_of


def searches_of(spec: TrialSpec) -> TaskPlan:
    """Plan of a trial, including the moves after one without a path.

    All planners have the same problems, so that they are compared move by move.

    Raises:
        MotionError: The planner is not available.
    """
    settings = spec.settings.planning
    return plan_task(cell_of(spec), spec.planned_by, seed=spec.seed, settings=settings, past_failures=True)
