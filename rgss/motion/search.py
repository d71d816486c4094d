"""One run of an OMPL planner whose effort is counted in validity checks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.motion.engine import Engine, load_engine
from rgss.motion.motion_validation import motion_validator
from rgss.motion.planners import PLANNERS
from rgss.motion.problem import PlanningProblem
from rgss.motion.validity import StateValidity, first_invalid_between

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SearchResult:
    """Result of a search.

    Attributes:
        corners: Corners of the path found in rad, shape (n, joints); None when it was ended before.
        checks: Validity checks made; a search that is ended exceeds its budget by what its last step takes.
    """

    corners: Vector | None
    checks: int


def search(
    problem: PlanningProblem,
    validity: StateValidity,
    planner: str,
    *,
    seed: int,
    is_over: Callable[[int], bool],
    range_rad: float | None = None,
) -> SearchResult:
    """Run a planner until it finds a path or its termination predicate holds.

    Args:
        problem: The move; its start and goal are valid.
        validity: Validity of a state.
        planner: Name of one of `PLANNERS`.
        seed: Seed of the engine's random numbers, at least 1.
        is_over: Termination predicate, called with the check count before every step of the planner.
        range_rad: Longest step of the planner's tree; the planner's own default when None.
    """
    engine = load_engine()
    joints = len(problem.start)
    # The engine's states are read element by element, which is most of what a check costs beside its verdict.
    angles_of = itemgetter(*range(joints)) if joints > 1 else lambda state: (state[0],)
    is_valid_at = validity.is_valid
    checks = 0

    def is_valid(angles: Sequence[float]) -> bool:
        nonlocal checks
        checks += 1
        return is_valid_at(angles)

    find = first_invalid_between(validity)

    def first_invalid(states: Vector) -> int | None:
        nonlocal checks
        index = find(states) if len(states) else None
        checks += len(states) if index is None else index + 1
        return index

    # Every random generator of the engine draws its seed from one generator of the process when it is
    # made; seeding that one before anything is made leaves no trace of what ran before.
    engine.util.RNG.setSeed(seed)
    information = _space(engine, problem)
    information.setStateValidityChecker(engine.base.StateValidityCheckerFn(lambda state: is_valid(angles_of(state))))
    # The engine keeps a pointer to it and no count.
    validator = motion_validator(engine, information, angles_of, is_valid, first_invalid)
    information.setMotionValidator(validator)
    information.setup()
    definition = engine.base.ProblemDefinition(information)
    definition.setStartAndGoalStates(
        _state(engine, information, problem.start), _state(engine, information, problem.goal)
    )
    entry = PLANNERS[planner]
    algorithm = getattr(engine.geometric, entry.ompl_class)(information)
    for setter, value in entry.settings.items():
        getattr(algorithm, setter)(value)
    if range_rad is not None:
        algorithm.setRange(range_rad)
    algorithm.setProblemDefinition(definition)
    algorithm.setup()
    stop = engine.base.PlannerTerminationConditionFn(lambda: is_over(checks))
    algorithm.solve(engine.base.PlannerTerminationCondition(stop))
    if not definition.hasExactSolution():
        return SearchResult(corners=None, checks=checks)
    path = definition.getSolutionPath()
    corners = np.array([angles_of(state) for state in path.getStates()])
    return SearchResult(corners=corners, checks=checks)


def _space(engine: Engine, problem: PlanningProblem) -> Any:
    joints = len(problem.start)
    space = engine.base.RealVectorStateSpace(joints)
    bounds = engine.base.RealVectorBounds(joints)
    for index, (lower, upper) in enumerate(zip(problem.lower_rad, problem.upper_rad, strict=True)):
        bounds.setLow(index, lower)
        bounds.setHigh(index, upper)
    space.setBounds(bounds)
    information = engine.base.SpaceInformation(space)
    # The engine takes the resolution as a fraction of the diagonal of the space.
    information.setStateValidityCheckingResolution(problem.resolution_rad / space.getMaximumExtent())
    return information


def _state(engine: Engine, information: Any, values: tuple[float, ...]) -> Any:
    state = engine.base.State(information)
    for index, value in enumerate(values):
        state[index] = value
    return state
