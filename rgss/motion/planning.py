"""Sampling-based planning of one move within a budget of validity checks."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.errors import MotionError
from rgss.evidence.records import PlanOutcome
from rgss.motion.clock import ClockKind, PlanningClock
from rgss.motion.engine import load_engine
from rgss.motion.paths import JointPath
from rgss.motion.planner_catalogue import OnUnverified, PlannerSettings, available_planners, refusal_of
from rgss.motion.problem import PlanningProblem, PlanResult, spent
from rgss.motion.roadmap import SearchGraph
from rgss.motion.search import search
from rgss.motion.simplification import ShortenedPath, shorten
from rgss.motion.validity import StateCost, StateValidity
from rgss.motion.verification import verified

Vector = NDArray[np.float64]

_SEARCH_STREAM = 1
_SIMPLIFICATION_STREAM = 2
_REPAIR_STREAM = 3


# long function: the stages of one plan in order, each with its charge to the clock.
def plan(
    problem: PlanningProblem,
    validity: StateValidity,
    planner: PlannerSettings | str,
    *,
    seed: int,
    budget_checks: int,
    simplification_checks: int,
    clock: PlanningClock,
    limit_s: float = math.inf,
    simplification_limit_s: float = math.inf,
    on_unverified: OnUnverified = OnUnverified.FAIL,
    cost: StateCost | None = None,
    on_graph: Callable[[SearchGraph], None] | None = None,
) -> PlanResult:
    """Plan one move, verify the path found, and shorten it.

    With a counted clock the result is a function of the arguments, independent of machine, process and earlier calls;
    budget and clock do not change the path of a solved search.

    Args:
        problem: The move.
        validity: Validity of a state; depends on the state alone.
        planner: The planner with its parameters, or the name of one with OMPL's.
        seed: Seed of the search and of the simplification, at least 0.
        budget_checks: Greatest number of validity checks of search, verification and repair.
        simplification_checks: Greatest number of validity checks of the search for shortcuts; 0 leaves the path as
            found.
        clock: The planning clock.
        limit_s: Greatest time of the search by a wall clock; with a counted clock the budget alone counts.
        simplification_limit_s: Greatest time of the simplification and the final check of its result by the planning
            clock. A path that cannot be checked by then is returned as found.
        on_unverified: Handling of a path that is not valid at its verification resolution.
        cost: Cost of a state, for an objective that needs it; each evaluation is charged like a check.
        on_graph: Callback with the graph of the first search, before its path is repaired.

    Raises:
        MotionError: The planner is unknown or refused, or the seed or a budget is negative.
    """
    chosen = PlannerSettings(algorithm=planner) if isinstance(planner, str) else planner
    _check_arguments(chosen, seed, budget_checks, simplification_checks, simplification_limit_s)
    if (known := _known_without_search(problem, validity)) is not None:
        return known
    counted = clock.kind is ClockKind.COUNTED
    load_engine()  # The first use in a process takes longer than many searches and must not count as search time.
    elapsed_s = clock.start()
    found = _verified_search(
        problem,
        validity,
        chosen,
        seed=seed,
        # Not "at least": a step that needs no check may still solve within the budget.
        is_over=lambda checks: checks > budget_checks or (not counted and elapsed_s(checks) > limit_s),
        on_unverified=on_unverified,
        cost=cost,
        on_graph=on_graph,
    )
    time_s = elapsed_s(found.checks)
    if found.corners is None or found.checks > budget_checks or (not counted and time_s > limit_s):
        return spent(budget_checks, elapsed_s(budget_checks)) if counted else spent(found.checks, time_s)
    if not found.is_valid:
        return replace(spent(found.checks, time_s), outcome=PlanOutcome.NOT_VERIFIED)
    shortened, simplification_s = ShortenedPath(corners=found.corners, checks=0, unlimited_from=0), 0.0
    if simplification_checks:
        shortening_s = clock.start()
        shortened = shorten(
            found.corners,
            validity,
            generator=np.random.default_rng(_derived_seed(seed, _SIMPLIFICATION_STREAM)),
            budget_checks=simplification_checks,
            resolution_rad=problem.verified_every_rad,
            limit_checks=_limit_checks(clock, simplification_limit_s),
            is_over=None if counted else lambda: shortening_s(0) > simplification_limit_s,
        )
        simplification_s = min(shortening_s(shortened.checks), simplification_limit_s)  # By a wall clock, too.
    return PlanResult(
        outcome=PlanOutcome.SOLVED,
        path=JointPath(shortened.corners),
        checks=found.checks,
        simplification_checks=shortened.checks,
        search_time_s=time_s,
        simplification_time_s=simplification_s,
        verification_checks=found.verification_checks,
        repairs=found.repairs,
        simplification_unlimited_from=shortened.unlimited_from,
    )


def _limit_checks(clock: PlanningClock, limit_s: float) -> int | None:
    return clock.checks_within(limit_s) if clock.kind is ClockKind.COUNTED and limit_s < math.inf else None


def _known_without_search(problem: PlanningProblem, validity: StateValidity) -> PlanResult | None:
    """Result of an ill-posed or trivial problem; None if a search is needed."""
    for state, outcome in ((problem.start, PlanOutcome.INVALID_START), (problem.goal, PlanOutcome.INVALID_GOAL)):
        if not problem.in_range(state) or not validity.is_valid(state):
            return PlanResult(outcome=outcome, path=None, checks=0, simplification_checks=0, search_time_s=0.0)
    if problem.start == problem.goal:
        # A planner may leave the start and return to it.
        return PlanResult(
            outcome=PlanOutcome.SOLVED,
            path=JointPath(np.array([problem.start, problem.goal])),
            checks=0,
            simplification_checks=0,
            search_time_s=0.0,
        )
    return None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Found:
    """Search with the verification of its path; `checks` includes search, verification and repairs."""

    corners: Vector | None
    checks: int
    is_valid: bool = True
    verification_checks: int = 0
    repairs: int = 0


def _verified_search(
    problem: PlanningProblem,
    validity: StateValidity,
    planner: PlannerSettings,
    *,
    seed: int,
    is_over: Callable[[int], bool],
    on_unverified: OnUnverified,
    cost: StateCost | None,
    on_graph: Callable[[SearchGraph], None] | None,
) -> _Found:
    first = search(
        problem,
        validity,
        planner,
        seed=_derived_seed(seed, _SEARCH_STREAM),
        is_over=is_over,
        cost=cost,
        on_graph=on_graph,
    )
    if first.corners is None or problem.verified_every_rad >= problem.resolution_rad:
        return _Found(corners=first.corners, checks=first.checks)

    def replan(start: Vector, end: Vector, number: int, checks: int) -> tuple[Vector | None, int]:
        motion = replace(
            problem,
            start=tuple(start.tolist()),
            goal=tuple(end.tolist()),
            resolution_rad=problem.verified_every_rad,
        )
        before = first.checks + checks
        repaired = search(
            motion,
            validity,
            planner,
            seed=_derived_seed(seed, _REPAIR_STREAM, number),
            is_over=lambda more: is_over(before + more),
            cost=cost,
        )
        return repaired.corners, repaired.checks

    result = verified(
        first.corners,
        validity,
        resolution_rad=problem.verified_every_rad,
        replan=replan if on_unverified is OnUnverified.REPAIR else None,
    )
    return _Found(
        corners=None if result.gave_up else result.corners,
        checks=first.checks + result.checks + result.repair_checks,
        is_valid=result.is_valid,
        verification_checks=result.checks,
        repairs=result.repairs,
    )


def _check_arguments(
    planner: PlannerSettings, seed: int, budget_checks: int, simplification_checks: int, simplification_limit_s: float
) -> None:
    name = planner.algorithm
    if name not in available_planners():
        reason = refusal_of(name)
        message = f"planner {name} cannot be run: {reason}" if reason else f"unknown planner {name!r}"
        raise MotionError(message, hint=f"the planners are {', '.join(available_planners())}")
    known = available_planners()[name].parameters
    for parameter, value in planner.parameters:
        if parameter not in known:
            listed = ", ".join(known) or "none"
            raise MotionError(f"{name} has no parameter {parameter!r}", hint=f"its parameters: {listed}")
        if problem := known[parameter].problem_of(value):
            raise MotionError(f"{name}: {problem}")
    if seed < 0:
        raise MotionError(f"seed must be at least 0, got {seed}", hint="give a whole number")
    if budget_checks < 0 or simplification_checks < 0:
        least = min(budget_checks, simplification_checks)
        raise MotionError(f"a budget of validity checks must be at least 0, got {least}", hint="give a whole number")
    if not simplification_limit_s >= 0.0:
        raise MotionError(
            f"the simplification limit must be at least 0 s, got {simplification_limit_s:g} s",
            hint="0 leaves the path as found",
        )


def _derived_seed(seed: int, *stream: int) -> int:
    """Independent seed, at least 1, derived from a trial's seed."""
    return int(np.random.SeedSequence([seed, *stream]).generate_state(1)[0]) or 1
