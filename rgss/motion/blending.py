"""Blending of the corners of a joint path, so that a move does not stop at each of them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import MotionError
from rgss.motion.paths import JointPath, segment_states
from rgss.motion.validity import StateValidity, first_invalid_between

Vector = NDArray[np.float64]

_HALVINGS = 6
_BLEND_DENSITY = 4
_SHARPEST_TURN_COSINE = math.cos(math.radians(150.0))
_STRAIGHT = 1e-9
# Coefficients of the quintic Bézier polynomials in powers of the parameter: a row for each control point.
_BEZIER = np.array(
    [
        [1, -5, 10, -10, 5, -1],
        [0, 5, -20, 30, -20, 5],
        [0, 0, 10, -30, 30, -10],
        [0, 0, 0, 10, -20, 10],
        [0, 0, 0, 0, 5, -5],
        [0, 0, 0, 0, 0, 1],
    ],
    dtype=float,
)
# Distances of the control points from the corner as fractions of the blend's reach: with equal steps along
# both tangents the curve has unit speed and no curvature at its ends.
_BLEND_OFFSETS = np.array([1.0, 0.6, 0.2])
# Deviation of a blend from its corner, as a fraction of reach × |difference of the directions|.
_BLEND_DEPTH = 0.1875


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SmoothPath:
    """A path in joint space with two continuous derivatives between its stops.

    Piecewise quintic in a parameter s, which equals the arc length on straight pieces and approximates it on blends.

    Attributes:
        breaks: The parameter at the ends of the pieces, shape (pieces + 1,), from 0.
        coefficients: Of each piece in powers of (s - its start), shape (pieces, 6, joints).
        stops: Indices of the breaks at which a motion must come to rest, the first and the last included.
        curved: For each piece, whether it is a blend.
    """

    breaks: Vector
    coefficients: Vector
    stops: tuple[int, ...]
    curved: tuple[bool, ...]

    def __call__(self, s: Vector, order: int = 0) -> Vector:
        """Evaluate the path or a derivative with respect to its parameter.

        Args:
            s: Parameters, shape (n,).
            order: 0, 1 or 2.

        Returns:
            Shape (n, joints).
        """
        piece = np.clip(np.searchsorted(self.breaks, s, side="right") - 1, 0, len(self.coefficients) - 1)
        local = (s - self.breaks[piece])[:, None]
        value: Vector = np.zeros((len(piece), self.coefficients.shape[2]))
        for power in range(5, order - 1, -1):
            value *= local
            value += (math.perm(power, order) * self.coefficients[:, power])[piece]
        return value


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BlendedPath:
    """Result of the blending of a joint path.

    Attributes:
        path: The smooth path.
        is_valid: Whether every state that was checked along it is valid.
        blended: Number of blended corners.
        stops: Number of corners at which the motion comes to rest.
        checks: Number of validity checks.
    """

    path: SmoothPath
    is_valid: bool
    blended: int
    stops: int
    checks: int


def blend(
    path: JointPath, validity: StateValidity, *, resolution_rad: float, largest_deviation_rad: float = 0.1
) -> BlendedPath:
    """Blend the corners of a path as far as it stays valid.

    A corner between the directions u and v is replaced, from a reach r before it to r after it, by the quintic Bézier
    curve that meets both segments with their direction and without curvature, so that the path has two continuous
    derivatives. The curve stays within the triangle of the corner, 0.1875 r |v - u| away from it. The reach of a blend
    in collision is halved up to six times; after that, or if the path nearly reverses, the motion stops at the corner.

    Args:
        path: A valid polyline.
        validity: State-validity checker.
        resolution_rad: Greatest distance between two checked states. The straight pieces are checked at the states of
            the polyline, so that they are valid if it was; the blends four times as densely.
        largest_deviation_rad: Greatest distance of a blend from its corner.

    Raises:
        MotionError: The resolution is not positive.
    """
    _require_resolution(resolution_rad)
    corners = _distinct(path.points_rad)
    steps = np.diff(corners, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    directions = steps / lengths[:, None]
    counted = _Counter(validity)
    reaches = np.zeros(len(corners))
    stops = 0
    for index in range(1, len(corners) - 1):
        incoming, outgoing = directions[index - 1], directions[index]
        turn = float(np.linalg.norm(outgoing - incoming))
        room = min(
            lengths[index - 1] * (0.5 if index > 1 else 1.0),
            lengths[index] * (0.5 if index < len(corners) - 2 else 1.0),
        )
        reach = min(room, largest_deviation_rad / (_BLEND_DEPTH * max(turn, _STRAIGHT)))
        if incoming @ outgoing > _SHARPEST_TURN_COSINE:
            reaches[index] = _valid_reach(corners[index], incoming, outgoing, reach, counted, resolution_rad)
        stops += int(reaches[index] == 0.0)
    smooth = _assemble(corners, directions, lengths, reaches)
    valid = counted.are_valid(_straight_states(corners, lengths, reaches, resolution_rad))
    return BlendedPath(
        path=smooth, is_valid=valid, blended=max(len(corners) - 2, 0) - stops, stops=stops, checks=counted.checks
    )


def unblended(path: JointPath, validity: StateValidity, *, resolution_rad: float) -> BlendedPath:
    """Polyline as a smooth path with a stop at each corner.

    Args:
        path: A valid polyline.
        validity: State-validity checker.
        resolution_rad: Greatest distance between two checked states.

    Raises:
        MotionError: The resolution is not positive.
    """
    _require_resolution(resolution_rad)
    corners = _distinct(path.points_rad)
    steps = np.diff(corners, axis=0)
    lengths, reaches = np.linalg.norm(steps, axis=1), np.zeros(len(corners))
    smooth = _assemble(corners, steps / lengths[:, None], lengths, reaches)
    counted = _Counter(validity)
    valid = counted.are_valid(_straight_states(corners, lengths, reaches, resolution_rad))
    return BlendedPath(path=smooth, is_valid=valid, blended=0, stops=max(len(corners) - 2, 0), checks=counted.checks)


def _require_resolution(resolution_rad: float) -> None:
    if not resolution_rad > 0.0:
        raise MotionError(
            f"the resolution must be above 0 rad, got {resolution_rad:g} rad", hint="give a distance above zero"
        )


class _Counter:
    def __init__(self, validity: StateValidity) -> None:
        self._first_invalid = first_invalid_between(validity)
        self.checks = 0

    def are_valid(self, states: Vector) -> bool:
        index = self._first_invalid(states)
        self.checks += len(states) if index is None else index + 1
        return index is None


def _distinct(points: Vector) -> Vector:
    kept = [points[0]]
    kept.extend(point for before, point in itertools.pairwise(points) if np.any(point != before))
    return np.array(kept)


def _valid_reach(
    corner: Vector, incoming: Vector, outgoing: Vector, reach: float, counted: _Counter, resolution_rad: float
) -> float:
    for _ in range(_HALVINGS + 1):
        piece = _blend_piece(corner, incoming, outgoing, reach)
        count = max(2, math.ceil(2 * reach / (resolution_rad / _BLEND_DENSITY))) + 1
        powers = np.linspace(0.0, 2 * reach, count)[:, None] ** np.arange(6)
        # A blend lies in the triangle of its corner, and so within the joint ranges.
        if counted.are_valid(powers @ piece):
            return reach
        reach /= 2
    return 0.0


def _blend_piece(corner: Vector, incoming: Vector, outgoing: Vector, reach: float) -> Vector:
    """Coefficients of a blend in powers of its parameter, which runs from 0 to twice the reach."""
    offsets = (reach * _BLEND_OFFSETS)[:, None]
    controls = np.vstack([corner - offsets * incoming, corner + offsets[::-1] * outgoing])
    scaled: Vector = (_BEZIER.T @ controls) / ((2 * reach) ** np.arange(6))[:, None]
    return scaled


def _assemble(corners: Vector, directions: Vector, lengths: Vector, reaches: Vector) -> SmoothPath:
    breaks, pieces, curved, stops = [0.0], [], [], [0]
    for index, direction in enumerate(directions):
        straight = lengths[index] - reaches[index] - reaches[index + 1]
        if straight > 1e-12 * lengths[index]:
            piece = np.zeros((6, corners.shape[1]))
            piece[0] = corners[index] + reaches[index] * direction
            piece[1] = direction
            pieces.append(piece)
            curved.append(False)
            breaks.append(breaks[-1] + straight)
        if reaches[index + 1] > 0.0:
            pieces.append(_blend_piece(corners[index + 1], direction, directions[index + 1], reaches[index + 1]))
            curved.append(True)
            breaks.append(breaks[-1] + 2 * reaches[index + 1])
        else:
            stops.append(len(breaks) - 1)
    if not pieces:
        piece = np.zeros((6, corners.shape[1]))
        piece[0] = corners[0]
        pieces, curved, breaks, stops = [piece], [False], [0.0, 0.0], [0, 1]
    return SmoothPath(breaks=np.array(breaks), coefficients=np.array(pieces), stops=tuple(stops), curved=tuple(curved))


def _straight_states(corners: Vector, lengths: Vector, reaches: Vector, resolution_rad: float) -> Vector:
    """States at which the polyline is checked, without those that blends replace."""
    states = [corners[:1]]
    for index, length in enumerate(lengths):
        segment = segment_states(corners[index], corners[index + 1], resolution_rad)
        along = np.arange(1, len(segment) + 1) / len(segment) * length
        states.append(segment[(along >= reaches[index]) & (along <= length - reaches[index + 1])])
    return np.vstack(states)
