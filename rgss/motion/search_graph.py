"""Graph that a planner grew during a search: a tree, two trees or a roadmap."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.motion.engine import Engine


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SearchGraph:
    """States that a planner kept, and the motions between them.

    Attributes:
        states_rad: The states, shape (n, joints).
        edges: Indices of the two states of each motion, shape (m, 2).
    """

    states_rad: NDArray[np.float64]
    edges: NDArray[np.int64]


def graph_of(
    engine: Engine, algorithm: Any, information: Any, angles_of: Callable[[Any], tuple[float, ...]], *, joints: int
) -> SearchGraph:
    """The graph of a planner after its search.

    Args:
        engine: The planning engine.
        algorithm: A planner of it.
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
