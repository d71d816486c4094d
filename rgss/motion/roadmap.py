"""Planner graphs: probabilistic roadmaps grown one milestone at a time, and the graph of any search."""

from __future__ import annotations

import heapq
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.motion.engine import Engine

Vector = NDArray[np.float64]


def solve_by_roadmap(
    engine: Engine,
    algorithm: Any,
    information: Any,
    angles_of: Callable[[Any], tuple[float, ...]],
    is_over: Callable[[], bool],
) -> Vector | None:
    """Shortest path through a roadmap that is grown until start and goal are connected.

    OMPL's ``PRM::solve`` searches for a solution in a second thread by a wall clock, so that its result differs from
    run to run. Here the roadmap is searched after each added milestone, independently of any clock.

    Args:
        engine: The planning engine.
        algorithm: A PRM of the engine, set up with its problem.
        information: Its space information.
        angles_of: Reads the joint angles (rad) of a state.
        is_over: Termination predicate.

    Returns:
        Corners of the path in rad, shape (n, joints); None if it was terminated before.
    """
    condition = engine.base.PlannerTerminationCondition
    predicate = engine.base.PlannerTerminationConditionFn
    at_once = predicate(lambda: True)
    # Adds start and goal as the first two milestones without growing the roadmap.
    algorithm.solve(condition(at_once))
    while True:
        corners = _shortest_path(engine, algorithm, information, angles_of)
        if corners is not None or is_over():
            return corners
        before = algorithm.milestoneCount()
        until = predicate(lambda before=before: is_over() or algorithm.milestoneCount() > before)
        algorithm.growRoadmap(condition(until))


def _shortest_path(
    engine: Engine, algorithm: Any, information: Any, angles_of: Callable[[Any], tuple[float, ...]]
) -> Vector | None:
    """The shortest path from the start to the goal by Dijkstra's algorithm; None if they are not connected."""
    data = engine.base.PlannerData(information)
    algorithm.getPlannerData(data)
    if data.numStartVertices() == 0 or data.numGoalVertices() == 0:
        return None
    start, goal = data.getStartIndex(0), data.getGoalIndex(0)
    states = [np.array(angles_of(data.getVertex(index).getState())) for index in range(data.numVertices())]
    distances, before = {start: 0.0}, {start: start}
    queue = [(0.0, start)]
    while queue:
        distance, here = heapq.heappop(queue)
        if here == goal:
            path = [goal]
            while path[-1] != start:
                path.append(before[path[-1]])
            return np.array([states[index] for index in reversed(path)])
        if distance > distances[here]:
            continue
        neighbours = engine.util.vectorUint()
        data.getEdges(here, neighbours)
        for other in neighbours:
            further = distance + float(np.linalg.norm(states[other] - states[here]))
            if further < distances.get(other, np.inf):
                distances[other], before[other] = further, here
                heapq.heappush(queue, (further, other))
    return None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SearchGraph:
    """Graph of a planner: its states and the motions between them.

    Attributes:
        states_rad: The states, shape (n, joints).
        edges: Indices of the two states of each motion, shape (m, 2).
    """

    states_rad: NDArray[np.float64]
    edges: NDArray[np.int64]


def graph_of(
    engine: Engine, algorithm: Any, information: Any, angles_of: Callable[[Any], tuple[float, ...]], *, joints: int
) -> SearchGraph:
    """Graph of a planner after its search.

    Args:
        engine: The planning engine.
        algorithm: A planner of the engine.
        information: Its space information.
        angles_of: Reads the joint angles (rad) of a state.
        joints: Number of joints.
    """
    data = engine.base.PlannerData(information)
    algorithm.getPlannerData(data)
    states = [angles_of(data.getVertex(index).getState()) for index in range(data.numVertices())]
    edges: list[tuple[int, int]] = []
    for here in range(len(states)):
        neighbours = engine.util.vectorUint()
        data.getEdges(here, neighbours)
        edges += [(here, int(other)) for other in neighbours]
    return SearchGraph(
        states_rad=np.array(states, dtype=np.float64).reshape(-1, joints),
        edges=np.array(edges, dtype=np.int64).reshape(-1, 2),
    )
