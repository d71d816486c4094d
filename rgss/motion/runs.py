"""Motions between two stops of a path: their parameter grid, and their concatenation to a trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.motion.blending import SmoothPath
from rgss.motion.trajectory import Trajectory

Vector = NDArray[np.float64]

_CELL_RAD = 0.04
_SHORTEST_CELL_RAD = 1e-9
_TURN_OF_CELL = 0.12
_FEWEST_CELLS = 24


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Run:
    """Motion between two stops, from rest to rest.

    Attributes:
        parameters: The path's parameter s at the knots, shape (n,).
        rates: Its rate ds/dt at the knots in 1/s, shape (n,); between knots d²s/dt² is constant.
        tool_speed_m_s: Greatest speed of the tool centre.
        tool_acceleration_m_s2: Greatest acceleration of the tool centre.
    """

    parameters: Vector
    rates: Vector
    tool_speed_m_s: float
    tool_acceleration_m_s2: float


def run_grid(path: SmoothPath, first: int, last: int, refinement: int) -> Vector:
    """Parameter grid between two stops: the ends of all pieces, denser where the path turns.

    Args:
        path: The path.
        first: Index of the break at which the run begins.
        last: Index of the break at which it ends.
        refinement: Multiple of the number of cells.
    """
    breaks = path.breaks[first : last + 1]
    starts, ends = path(breaks[:-1], 1), path(breaks[1:] - 1e-12 * np.diff(breaks), 1)
    turns = np.linalg.norm(ends - starts, axis=1)
    smallest = min(_CELL_RAD, (breaks[-1] - breaks[0]) / _FEWEST_CELLS)
    counts = np.maximum(np.ceil(np.diff(breaks) / smallest), np.ceil(turns / _TURN_OF_CELL)).astype(int) * refinement
    parts = [
        np.linspace(start, end, count, endpoint=False)
        for start, end, count in zip(breaks[:-1], breaks[1:], counts, strict=True)
    ]
    grid = np.concatenate(parts)
    # The reachability analysis divides by the cell length; a cell as short as a rounding error stalls the motion.
    apart = np.append(True, np.diff(grid) > _SHORTEST_CELL_RAD) & (breaks[-1] - grid > _SHORTEST_CELL_RAD)
    apart[0] = True
    return np.append(grid[apart], breaks[-1])


def joined(path: SmoothPath, runs: Sequence[Run]) -> Trajectory:
    """Trajectory through all runs in sequence; a rest if there is none.

    Args:
        path: The path.
        runs: The runs between its stops, in order.
    """
    if not runs:
        still = np.zeros(2)
        return Trajectory(
            path=path,
            parameters=still,
            rates=still,
            times_s=still,
            peak_tool_speed_m_s=0.0,
            peak_tool_acceleration_m_s2=0.0,
        )
    parameters = np.concatenate([run.parameters for run in runs])
    rates = np.concatenate([run.rates for run in runs])
    steps = []
    for run in runs:
        # Constant acceleration over a cell: its mean rate is the mean of the rates at its ends.
        steps.extend([0.0, *(2 * np.diff(run.parameters) / (run.rates[:-1] + run.rates[1:]))])
    return Trajectory(
        path=path,
        parameters=parameters,
        rates=rates,
        times_s=np.cumsum(steps),
        peak_tool_speed_m_s=max(run.tool_speed_m_s for run in runs),
        peak_tool_acceleration_m_s2=max(run.tool_acceleration_m_s2 for run in runs),
    )
