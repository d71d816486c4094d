"""Planned paths of a trial and the graphs of their searches, as lines of the tool."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from rgss.motion import SearchGraph, segment_states
from rgss.trials.planning import plan_task
from rgss.trials.replay.replay_scene import Line, LineKind
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import Workcell, cell_of

MOST_EDGES = 3000
"""Greatest number of shown edges of a graph; larger graphs are thinned evenly."""

_RESOLUTION_RAD = 0.05


def planned_lines(spec: TrialSpec) -> tuple[Line, ...]:
    """Plan a trial again, with the graphs of its searches.

    A move without a solution has a graph but no path.

    Raises:
        MotionError: The planner is not available.
    """
    cell = cell_of(spec)
    graphs: dict[str, SearchGraph] = {}
    plan = plan_task(
        cell, spec.planned_by, seed=spec.seed, settings=spec.settings.planning, on_graph=graphs.__setitem__
    )
    lines = []
    for phase in spec.task.phases:
        if phase in graphs and len(graphs[phase].edges):
            lines.append(Line(phase=phase, kind=LineKind.GRAPH, points_m=_graph_points(cell, graphs[phase])))
        move = plan.moves.get(phase)
        path = plan.direct.get(phase) if move is None else move.path_rad
        if path is not None and len(path) > 1:
            lines.append(Line(phase=phase, kind=LineKind.PATH, points_m=_path_points(cell, path)))
    return tuple(lines)


def _graph_points(cell: Workcell, graph: SearchGraph) -> NDArray[np.float64]:
    """Tool positions of the ends of the edges, shape (2 m, 3)."""
    edges = graph.edges[:: -(-len(graph.edges) // MOST_EDGES)]
    return cell.arm.tool_position(graph.states_rad[edges.reshape(-1)])


def _path_points(cell: Workcell, path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Tool positions along a joint path; the line is curved between the corners."""
    states = [path[:1]]
    for start, end in itertools.pairwise(path):
        states.append(segment_states(start, end, _RESOLUTION_RAD))
    return cell.arm.tool_position(np.vstack(states))
