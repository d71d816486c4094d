"""Time-optimal path parameterisation by reachability analysis (toppra)."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.motion.toppra_module import load_toppra

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RateConstraints:
    """Limits of the rate x = (ds/dt)² and the path acceleration u = d²s/dt² at the grid points.

    At grid point i the quantities ``a[i] u + b[i] x`` keep ``rows @ (…) ≤ bounds``.

    Attributes:
        first: The vectors a, shape (n, m).
        second: The vectors b, shape (n, m).
        rows: The half-spaces' normals, shape (k, m).
        bounds: Their offsets, shape (k,).
    """

    first: Vector
    second: Vector
    rows: Vector
    bounds: Vector


def fastest_rates(grid: Vector, largest_squares: Vector, constraints: list[RateConstraints]) -> Vector | None:
    """Fastest motion along a path, from rest to rest.

    Source: H. Pham, Q.-C. Pham, "A New Approach to Time-Optimal Path Parameterization Based on Reachability
    Analysis", IEEE T-RO 34(3), 2018.

    Args:
        grid: Increasing parameters s, shape (n,).
        largest_squares: Greatest (ds/dt)² at each of them in 1/s², shape (n,).
        constraints: Linear constraints; they are kept at both ends of each cell of the grid.

    Returns:
        ds/dt at the grid points in 1/s, shape (n,); None when the solver finds no motion.
    """
    engine = load_toppra()
    linear = engine.constraint.linear_constraint

    def prepared(parameters: tuple[Any, ...], *, identical: bool) -> Any:
        constraint = linear.LinearConstraint()
        constraint.identical = identical
        constraint.dof = 1
        constraint.compute_constraint_params = lambda _path, _grid: parameters
        return constraint

    squares = np.column_stack([np.zeros(len(grid)), largest_squares])
    problem = [prepared((None, None, None, None, None, None, squares), identical=False)]
    for one in constraints:
        interpolated = linear.canlinear_colloc_to_interpolate(
            one.first, one.second, np.zeros_like(one.first), one.rows, one.bounds, None, None, grid, identical=True
        )
        problem.append(prepared(interpolated, identical=True))
    path = SimpleNamespace(path_interval=np.array([grid[0], grid[-1]]), dof=1)
    solver = engine.algorithm.TOPPRA(problem, path, gridpoints=grid, solver_wrapper="seidel")
    _, rates, _ = solver.compute_parameterization(0.0, 0.0)
    if rates is None or not np.all(np.isfinite(rates)):
        return None
    return np.asarray(rates, dtype=float)
