"""Sampling-based planning of one move within a budget of validity checks."""

from __future__ import annotations

import math

import numpy as np

from rgss.errors import MotionError
from rgss.evidence.records import PlanOutcome
from rgss.motion.clock import ClockKind, PlanningClock
from rgss.motion.engine import load_engine
from rgss.motion.paths import JointPath
from rgss.motion.planners import PLANNERS
from rgss.motion.problem import PlanningProblem, PlanResult, spent
from rgss.motion.search import search
from rgss.motion.simplification import shorten
from rgss.motion.validity import StateValidity

_SEARCH_STREAM = 1
_SIMPLIFICATION_STREAM = 2


def plan(
    problem: PlanningProblem,
    validity: StateValidity,
    planner: str,
    *,
    seed: int,
    budget_checks: int,
    simplification_checks: int,
    clock: PlanningClock,
    limit_s: float = math.inf,
    simplification_limit_s: float = math.inf,
    range_rad: float | None = None,
) -> PlanResult:
    """Plan one move and shorten the path that is found.

    With a counted clock the result is a function of the arguments: neither the machine, nor the process,
    nor earlier calls change it, and neither the budget nor the clock changes the path of a search that
    is solved.

    Args:
        problem: The move.
        validity: Validity of a state; depends on the state alone.
        planner: Name of one of `PLANNERS`.
        seed: Seed of the search and of the simplification, at least 0.
        budget_checks: Greatest number of validity checks of the search.
        simplification_checks: Greatest number of validity checks of looking for shortcuts; 0 leaves the path as found.
        clock: The planning clock.
        limit_s: Greatest time of the search by a wall clock; with a counted clock the budget alone counts.
        simplification_limit_s: Greatest time of the whole simplification by the planning clock, the final check of
            its result included. A path that cannot be checked by then is left as it was found.
        range_rad: Longest step of the planner's tree; the planner's own default when None.

    Raises:
        MotionError: The planner is unknown, or the seed or a budget is negative.
    """
    _check_arguments(planner, seed, budget_checks, simplification_checks, simplification_limit_s)
    for state, outcome in ((problem.start, PlanOutcome.INVALID_START), (problem.goal, PlanOutcome.INVALID_GOAL)):
        if not problem.in_range(state) or not validity.is_valid(state):
            return PlanResult(outcome=outcome, path=None, checks=0, simplification_checks=0, search_time_s=0.0)
    if problem.start == problem.goal:
        # A planner may wander off and come back.
        return PlanResult(
            outcome=PlanOutcome.SOLVED,
            path=JointPath(np.array([problem.start, problem.goal])),
            checks=0,
            simplification_checks=0,
            search_time_s=0.0,
        )
    counted = clock.kind is ClockKind.COUNTED
    load_engine()  # The first use in a process takes longer than many a search and must not count as one.
    elapsed_s = clock.start()
    found = search(
        problem,
        validity,
        planner,
        seed=_derived_seed(seed, _SEARCH_STREAM),
        # Not "at least": a step that needs no check may still solve within the budget.
        is_over=lambda checks: checks > budget_checks or (not counted and elapsed_s(checks) > limit_s),
        range_rad=range_rad,
    )
    time_s = elapsed_s(found.checks)
    if found.corners is None or found.checks > budget_checks or (not counted and time_s > limit_s):
        return spent(budget_checks, elapsed_s(budget_checks)) if counted else spent(found.checks, time_s)
    corners, simplification, simplification_s = found.corners, 0, 0.0
    if simplification_checks:
        shortening_s = clock.start()
        limit_checks = (
            clock.checks_within(simplification_limit_s) if counted and simplification_limit_s < math.inf else None
        )
        corners, simplification = shorten(
            found.corners,
            validity,
            generator=np.random.default_rng(_derived_seed(seed, _SIMPLIFICATION_STREAM)),
            budget_checks=simplification_checks,
            resolution_rad=problem.resolution_rad,
            limit_checks=limit_checks,
            is_over=None if counted else lambda: shortening_s(0) > simplification_limit_s,
        )
        # By a wall clock the simplification is over at its limit: nothing that came later is used.
        simplification_s = min(shortening_s(simplification), simplification_limit_s)
    return PlanResult(
        outcome=PlanOutcome.SOLVED,
        path=JointPath(corners),
        checks=found.checks,
        simplification_checks=simplification,
        search_time_s=time_s,
        simplification_time_s=simplification_s,
    )


def _check_arguments(
    planner: str, seed: int, budget_checks: int, simplification_checks: int, simplification_limit_s: float
) -> None:
    if planner not in PLANNERS:
        raise MotionError(f"unknown planner {planner!r}", hint=f"the planners are {', '.join(PLANNERS)}")
    if seed < 0:
        raise MotionError(f"seed must be at least 0, got {seed}", hint="give a whole number")
    if budget_checks < 0 or simplification_checks < 0:
        least = min(budget_checks, simplification_checks)
        raise MotionError(f"a budget of validity checks must be at least 0, got {least}", hint="give a whole number")
    if not simplification_limit_s >= 0.0:
        raise MotionError(
            f"the simplification limit must be at least 0 s, got {simplification_limit_s:g} s",
            hint="0 leaves a path as it was found",
        )


def _derived_seed(seed: int, stream: int) -> int:
    """An independent seed, at least 1, for each use of a trial's seed."""
    return int(np.random.SeedSequence([seed, stream]).generate_state(1)[0]) or 1
