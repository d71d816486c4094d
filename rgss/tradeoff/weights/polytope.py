"""Bounded polytopes of weights: centre, vertices, volume, extent, nearest point.

Linear programs go to HiGHS, vertices and volumes to Qhull, least distances to NNLS, all through
SciPy. Rows are scaled to unit length within the plane of the weights before anything is solved,
so that tolerances mean distances between weights.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.nonnegative_least_squares import nonnegative_least_squares
from rgss.tradeoff.milp import SOLVER_TOLERANCE, solve_linear, variable_ranges
from rgss.tradeoff.weights.weight_set import Array, WeightSet

THINNEST = 1e-9
"""A polytope whose largest ball is smaller has no interior."""

LARGEST_EXACT_DIMENSION = 5
"""Up to here volumes are computed from vertices; beyond, their number grows too fast."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Polytope:
    """The weights of a set that satisfy further inequalities.

    Attributes:
        weights: The set.
        rows: All inequalities a w <= c, shape (k, m), scaled so that a has unit length within the
            plane of the weights; rows that have no direction in it are not among them.
        limits: Their right-hand sides.
        contradiction: Whether a row without direction cannot hold, so that nothing is left.
    """

    weights: WeightSet
    rows: Array
    limits: Array
    contradiction: bool

    @staticmethod
    def of(weights: WeightSet, rows: Array | None = None, limits: Array | None = None) -> Polytope:
        """Cut a set of weights.

        Args:
            weights: The set.
            rows: Further inequalities a w <= c, shape (k, m).
            limits: Their right-hand sides, shape (k,).
        """
        own_rows, own_limits = weights.conditions()
        if rows is not None and limits is not None:
            own_rows, own_limits = np.vstack([own_rows, rows]), np.concatenate([own_limits, limits])
        lengths = np.linalg.norm(own_rows @ weights.directions(), axis=1)
        flat = lengths <= 1e-13
        # A flat row is the same number for every admitted weight; any point that satisfies the
        # equations shows which.
        equation_rows, equals = weights.equations()
        anywhere = np.linalg.lstsq(equation_rows, equals, rcond=None)[0]
        contradiction = bool((own_rows[flat] @ anywhere > own_limits[flat] + SOLVER_TOLERANCE).any())
        scale = lengths[~flat]
        return Polytope(
            weights=weights,
            rows=np.asarray(own_rows[~flat] / scale[:, None], dtype=np.float64),
            limits=np.asarray(own_limits[~flat] / scale, dtype=np.float64),
            contradiction=contradiction,
        )

    def largest_ball(self) -> tuple[Array, float] | None:
        """The Chebyshev centre, shape (m,), and its distance from the nearest face.

        The radius is 0 (up to rounding) where the polytope has no interior, and for a single point.

        Returns:
            Centre and radius; None if the polytope is empty.
        """
        if self.contradiction:
            return None
        equation_rows, equals = self.weights.equations()
        size = self.weights.size
        if not self.weights.directions().shape[1]:
            return _cleaned(np.linalg.lstsq(equation_rows, equals, rcond=None)[0]), 0.0
        answer = solve_linear(
            np.concatenate([np.zeros(size), [-1.0]]),
            np.hstack([self.rows, np.ones((len(self.rows), 1))]),
            self.limits,
            np.hstack([equation_rows, np.zeros((len(equation_rows), 1))]),
            equals,
            # Negative radii are allowed, so that emptiness shows as one. Sides are at most 1.
            [(None, None)] * size + [(-2.0, 1.0)],
        )
        if answer is None or answer[-1] < -THINNEST:
            return None
        return _cleaned(answer[:size]), max(0.0, float(answer[-1]))

    def interior_point(self) -> Array:
        """The Chebyshev centre, shape (m,), of an interior that is not empty; a single point is its own.

        Raises:
            TradeoffError: The polytope is empty or has no interior.
        """
        ball = self.largest_ball()
        if ball is None or (ball[1] <= THINNEST and self.weights.directions().shape[1]):
            raise TradeoffError(
                "the elicited bounds and orders leave no room for weights", hint="widen a bound, or drop an order"
            )
        return ball[0]

    def extent(self) -> tuple[Array, Array]:
        """The least and the largest value of each weight, shapes (m,) each; the polytope is not empty."""
        equation_rows, equals = self.weights.equations()
        found = variable_ranges(self.rows, self.limits + THINNEST, equation_rows, equals)
        if found is None:
            raise TradeoffError("a region of weights is empty where it was not", hint="report this problem")
        return _cleaned(found[0]), _cleaned(found[1])

    def vertices(self, inside: Array) -> Array | None:
        """The corners, shape (v, m).

        Args:
            inside: A point of the interior, shape (m,).

        Returns:
            The corners; None where their number would be too large, or Qhull gives up.
        """
        directions = self.weights.directions()
        dimension = directions.shape[1]
        if dimension == 0:
            return inside[None, :]
        slopes, gaps = self.rows @ directions, self.limits - self.rows @ inside
        if dimension == 1:
            steps = gaps / slopes[:, 0]
            ends = [steps[slopes[:, 0] < 0.0].max(), steps[slopes[:, 0] > 0.0].min()]
            return _cleaned(inside + np.outer(ends, directions[:, 0]))
        if dimension > LARGEST_EXACT_DIMENSION:
            return None
        from scipy.spatial import HalfspaceIntersection, QhullError

        try:
            found = HalfspaceIntersection(np.hstack([slopes, -gaps[:, None]]), np.zeros(dimension)).intersections
        except QhullError:
            return None
        if not np.isfinite(found).all():
            return None
        # Corners that several faces meet in are found several times, up to rounding.
        _, first = np.unique(found.round(10), axis=0, return_index=True)
        return _cleaned(inside + found[np.sort(first)] @ directions.T)

    def volume(self, vertices: Array) -> float | None:
        """The volume within the plane of the weights; None where Qhull gives up."""
        directions = self.weights.directions()
        points = (vertices - vertices[0]) @ directions
        if points.shape[1] == 0:
            return 1.0
        if points.shape[1] == 1:
            return float(np.ptp(points))
        from scipy.spatial import ConvexHull, QhullError

        try:
            return float(ConvexHull(points).volume)
        except QhullError:
            return None

    def nearest(self, weights: Array) -> Array | None:
        """The point at the least Euclidean distance from given weights of the set.

        A least-distance program, solved in finitely many steps by non-negative least squares
        (Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23).

        Args:
            weights: The weights, shape (m,), which satisfy the equations of the set.

        Returns:
            The nearest point, shape (m,); None if the polytope is empty.
        """
        if self.contradiction:
            return None
        directions = self.weights.directions()
        gaps = self.limits - self.rows @ weights
        if directions.shape[1] == 0 or (gaps >= 0.0).all():
            return np.array(weights, dtype=np.float64) if (gaps >= -THINNEST).all() else None
        # min |z| with G z >= h, where w = weights + directions z.
        stacked = np.vstack([-(self.rows @ directions).T, -gaps[None, :]])
        target = np.zeros(len(stacked))
        target[-1] = 1.0
        multipliers, _ = nonnegative_least_squares(stacked, target, most_steps=50 * stacked.shape[1])
        residual = stacked @ multipliers - target
        if -residual[-1] < 1e-12:
            return None
        return _cleaned(weights + directions @ (residual[:-1] / -residual[-1]))

    def nearest_in_sum(self, weights: Array) -> Array | None:
        """A point at the least sum of absolute differences from given weights.

        Args:
            weights: The weights, shape (m,).

        Returns:
            One such point, shape (m,); None if the polytope is empty.
        """
        if self.contradiction:
            return None
        if (self.rows @ weights <= self.limits).all():
            return np.array(weights, dtype=np.float64)
        size = self.weights.size
        equation_rows, equals = self.weights.equations()
        unit = np.eye(size)
        answer = solve_linear(
            np.concatenate([np.zeros(size), np.ones(size)]),
            np.vstack(
                [np.hstack([self.rows, np.zeros_like(self.rows)]), np.hstack([unit, -unit]), np.hstack([-unit, -unit])]
            ),
            np.concatenate([self.limits, weights, -weights]),
            np.hstack([equation_rows, np.zeros_like(equation_rows)]),
            equals,
            [(None, None)] * size + [(0.0, None)] * size,
        )
        return None if answer is None else _cleaned(answer[:size])


def triangulation(points: Array) -> tuple[NDArray[np.intp], Array] | None:
    """Simplices of a triangulation of points, each by the rows of its corners, and their relative volumes.

    Args:
        points: The points, shape (v, d), d being at least 2.

    Returns:
        Shapes (c, d + 1) and (c,); None where Qhull gives up.
    """
    from scipy.spatial import Delaunay, QhullError

    try:
        cells = Delaunay(points).simplices
    except QhullError:
        return None
    corners = points[cells]
    return cells, np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))


def _cleaned(weights: NDArray[Any]) -> Array:
    """Without the dust of rounding around 0 and 1."""
    near_one = np.where(np.abs(weights - 1.0) < 1e-12, 1.0, weights)
    return np.asarray(np.clip(np.where(np.abs(near_one) < 1e-12, 0.0, near_one), 0.0, 1.0), dtype=np.float64)
