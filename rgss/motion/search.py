"""Run of an OMPL planner with its effort counted in validity checks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import MotionError
from rgss.motion.engine import Engine, load_engine
from rgss.motion.motion_validation import motion_validator
from rgss.motion.objectives import objective_of
from rgss.motion.planner_catalogue import (
    ROADMAP_PLANNERS,
    Objective,
    ParameterType,
    PlannerSettings,
    available_planners,
)
from rgss.motion.problem import PlanningProblem
from rgss.motion.roadmap import SearchGraph, graph_of, solve_by_roadmap
from rgss.motion.validity import StateCost, StateValidity, first_invalid_between

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SearchResult:
    """Result of a search.

    Attributes:
        corners: Corners of the path found in rad, shape (n, joints); None if it was terminated before.
        checks: Number of validity checks and cost evaluations; a terminated search exceeds its budget by the checks of
        its last step.
    """

    corners: Vector | None
    checks: int


# long function: the engine's objects must live as long as the search that uses them.
def search(
    problem: PlanningProblem,
    validity: StateValidity,
    planner: PlannerSettings,
    *,
    seed: int,
    is_over: Callable[[int], bool],
    cost: StateCost | None = None,
    on_graph: Callable[[SearchGraph], None] | None = None,
) -> SearchResult:
    """Run a planner until it finds a path or its termination predicate holds.

    Args:
        problem: The move; its start and goal are valid.
        validity: Validity of a state.
        planner: The planner with its parameters.
        seed: Seed of the engine's random numbers, at least 1.
        is_over: Termination predicate, called with the check count before every step of the planner.
        cost: Cost of a state, for the planner's objective; each evaluation counts as a check.
        on_graph: Callback with the planner's graph after the search.

    Raises:
        MotionError: OMPL refuses a parameter, or the objective needs a cost that is not given.
    """
    engine = load_engine()
    # Reading the engine's states element by element is most of the overhead of a check.
    angles_of = itemgetter(*range(len(problem.start))) if len(problem.start) > 1 else lambda state: (state[0],)
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

    # Every random generator of the engine draws its seed from one generator of the process at construction; seeding
    # that one first makes the search independent of earlier ones.
    engine.util.RNG.setSeed(seed)
    information = _space(engine, problem)
    information.setStateValidityChecker(engine.base.StateValidityCheckerFn(lambda state: is_valid(angles_of(state))))
    # The engine keeps a pointer without owning the object.
    validator = motion_validator(engine, information, angles_of, is_valid, first_invalid)
    information.setMotionValidator(validator)
    information.setup()
    definition = _definition(engine, information, problem)
    costs: dict[tuple[float, ...], float] = {}

    def cost_at(state: Any) -> float:
        nonlocal checks
        angles = angles_of(state)
        # A planner compares a new state with one whose cost was evaluated before; another tree would cache it.
        if angles not in costs:
            checks += 1
            costs[angles] = _cost_of(cost, angles)
        return costs[angles]

    if (objective := _objective(planner)) is not None:
        cost_of = None if objective is Objective.PATH_LENGTH else cost_at
        definition.setOptimizationObjective(objective_of(engine, information, cost_of))
    algorithm = _algorithm(engine, information, planner)
    algorithm.setProblemDefinition(definition)
    algorithm.setup()
    if planner.algorithm in ROADMAP_PLANNERS:
        corners = solve_by_roadmap(engine, algorithm, information, angles_of, lambda: is_over(checks))
    else:
        corners = _solved(engine, algorithm, definition, angles_of, lambda: is_over(checks))
    if on_graph is not None:
        on_graph(graph_of(engine, algorithm, information, angles_of, joints=len(problem.start)))
    return SearchResult(corners=corners, checks=checks)


def _definition(engine: Engine, information: Any, problem: PlanningProblem) -> Any:
    definition = engine.base.ProblemDefinition(information)
    definition.setStartAndGoalStates(
        _state(engine, information, problem.start), _state(engine, information, problem.goal)
    )
    return definition


def _solved(
    engine: Engine,
    algorithm: Any,
    definition: Any,
    angles_of: Callable[[Any], tuple[float, ...]],
    is_over: Callable[[], bool],
) -> Vector | None:
    stop = engine.base.PlannerTerminationConditionFn(is_over)
    algorithm.solve(engine.base.PlannerTerminationCondition(stop))
    if not definition.hasExactSolution():
        return None
    return np.array([angles_of(state) for state in definition.getSolutionPath().getStates()])


def _objective(planner: PlannerSettings) -> Objective | None:
    """Objective of a planner; an optimising planner needs one, or it runs to its limit."""
    if planner.objective is None and available_planners()[planner.algorithm].optimizing:
        return Objective.PATH_LENGTH
    return planner.objective


def _cost_of(cost: StateCost | None, angles: Sequence[float]) -> float:
    if cost is None:
        raise MotionError("the planner's objective needs the cost of a state, got none", hint="pass 'cost'")
    return cost(angles)


def _algorithm(engine: Engine, information: Any, planner: PlannerSettings) -> Any:
    algorithm = getattr(engine.geometric, planner.algorithm)(information)
    known = available_planners()[planner.algorithm].parameters
    for name, value in planner.parameters:
        text = repr(float(value)) if known[name].type is ParameterType.REAL else str(int(value))
        if not algorithm.params().setParam(name, text):
            raise MotionError(f"{planner.algorithm} rejects {name} = {text}", hint="give another value")
    return algorithm


def _space(engine: Engine, problem: PlanningProblem) -> Any:
    joints = len(problem.start)
    space = engine.base.RealVectorStateSpace(joints)
    bounds = engine.base.RealVectorBounds(joints)
    for index, (lower, upper) in enumerate(zip(problem.lower_rad, problem.upper_rad, strict=True)):
        bounds.setLow(index, lower)
        bounds.setHigh(index, upper)
    space.setBounds(bounds)
    information = engine.base.SpaceInformation(space)
    # The engine expects the resolution as a fraction of the diagonal of the space.
    information.setStateValidityCheckingResolution(problem.resolution_rad / space.getMaximumExtent())
    return information


def _state(engine: Engine, information: Any, values: tuple[float, ...]) -> Any:
    state = engine.base.State(information)
    for index, value in enumerate(values):
        state[index] = value
    return state
