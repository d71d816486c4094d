"""Poses that an arm of few joints cannot reach, found without a search: its links move the tool in a plane."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.arm import Arm

Vector = NDArray[np.float64]

# Right angles of a URDF may be rounded, such as 1.5708. The tolerances are far above what that moves a tool, and above
# the deviation that inverse kinematics accepts, so that no pose that it finds is excluded.
_PARALLEL = 1e-5
_POSITION_TOLERANCE_M = 1e-5
_ANGLE_TOLERANCE_RAD = 0.1
_LEAST_SHARE = 0.1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Turn:
    """Rotation about an axis by the sum of the angles of joints with parallel axes.

    Attributes:
        axis: The axis with all joints at zero, shape (3,).
        lower_rad: Least angle over the joints' ranges.
        upper_rad: Greatest angle.
    """

    axis: Vector
    lower_rad: float
    upper_rad: float

    def admits(self, angle_rad: float) -> bool:
        """True if an angle, or one that differs by whole turns, is within the limits or near them."""
        above = math.remainder(angle_rad - self.lower_rad, math.tau) % math.tau
        width = self.upper_rad - self.lower_rad + _ANGLE_TOLERANCE_RAD
        return above <= width or above >= math.tau - _ANGLE_TOLERANCE_RAD


class PlanarReach:
    """Necessary condition for a tool pose of an arm, of its distance and of the direction of the tool's axis.

    The condition on the axis is for arms that first turn the plane in which the remaining joints move the tool: a
    horizontal arm, a palletiser, an arm of four or five joints. With w the axis of the first joints and n that of the
    others, Rot(w, ψ) n has a constant component along the tool's axis, and along the tool's position if one joint turns
    the plane. The angle of the tool's axis in that plane is the sum of the others' angles; in a palletiser, whose
    followers keep its wrist level, it is constant. A last joint about the tool's axis affects neither.

    Args:
        arm: The arm with its tool.
    """

    def __init__(self, arm: Arm) -> None:
        directions, steps = arm.joint_axes()
        self._centre_m, self._reach_m = np.array(arm.first_axis_m), arm.reach_m
        self._tool_axis = arm.tool_rotation_at_zero()[:, 2]
        self._points_m = np.cumsum(steps, axis=0)
        self._turning = [int(joint) for joint in np.flatnonzero(~arm.coupling.slides)]
        while self._turning and self._is_roll(directions, self._turning[-1]):
            self._turning.pop()
        self._plane: _Turn | None = None
        self._pitch: _Turn | None = None
        self._origin_m: Vector | None = None
        if self._turning:
            self._divide(arm, directions)

    def admits(self, position_m: Sequence[float] | Vector, tool_axis: Sequence[float] | Vector) -> bool:
        """False for a pose that no configuration within the ranges reaches.

        Args:
            position_m: Position of the tool centre in the world, shape (3,).
            tool_axis: The tool's axis, z, in the world, shape (3,).
        """
        position, axis = np.asarray(position_m, dtype=float), np.asarray(tool_axis, dtype=float)
        if np.linalg.norm(position - self._centre_m) > self._reach_m + _POSITION_TOLERANCE_M:
            return False
        if self._pitch is None:
            return True
        if self._plane is None:
            return self._is_pitched(axis)
        angles = self._plane_angles(position, axis)
        if angles is None:
            return True
        return any(
            self._plane.admits(angle) and self._is_pitched(_rotated(axis, self._plane.axis, -angle)) for angle in angles
        )

    def _is_roll(self, directions: Vector, joint: int) -> bool:
        """True for a joint about the tool's axis through the tool's centre."""
        arm_m = self._points_m[-1] - self._points_m[joint]
        across = np.linalg.norm(np.cross(directions[joint], arm_m))
        return _is_parallel(directions[joint], self._tool_axis) and bool(across < _PARALLEL)

    def _divide(self, arm: Arm, directions: Vector) -> None:
        """Divide the joints into those that turn the plane and those within it; without effect for other arms."""
        turning = self._turning
        first = len(turning) - 1
        while first > 0 and _is_parallel(directions[turning[first - 1]], directions[turning[-1]]):
            first -= 1
        base, inner = turning[:first], turning[first:]
        if any(not _is_parallel(directions[joint], directions[base[0]]) for joint in base):
            return
        self._pitch = _turn_of(arm, directions, inner)
        if not base:
            return
        self._plane = _turn_of(arm, directions, base)
        slides = [int(joint) for joint in np.flatnonzero(arm.coupling.slides)]
        is_planar = all(abs(float(directions[joint] @ self._pitch.axis)) < _PARALLEL for joint in slides)
        # A joint that slides before the plane turns must not move it sideways at any angle.
        is_level = all(_is_parallel(directions[joint], self._plane.axis) for joint in slides if joint < base[0])
        if len(base) == 1 and is_planar and is_level:
            self._origin_m = self._points_m[base[0]]

    def _plane_angles(self, position: Vector, axis: Vector) -> tuple[float, ...] | None:
        """Angles of the plane at which it contains the tool; None if they are not determined."""
        plane, pitch = self._plane, self._pitch
        if plane is None or pitch is None:
            raise AssertionError("checked before: joints turn the plane")
        if self._origin_m is not None:
            moved, least = position - self._origin_m, _LEAST_SHARE * self._reach_m
            constant = float(pitch.axis @ (self._points_m[-1] - self._origin_m))
        else:
            moved, least, constant = axis, _LEAST_SHARE, float(pitch.axis @ self._tool_axis)
        along = float(plane.axis @ pitch.axis) * plane.axis
        cosine, sine = float((pitch.axis - along) @ moved), float(np.cross(plane.axis, pitch.axis) @ moved)
        amplitude = math.hypot(cosine, sine)
        if amplitude <= least:
            return None
        share = (constant - float(along @ moved)) / amplitude
        if abs(share) > 1.0 + _ANGLE_TOLERANCE_RAD**2 / 2:
            return ()
        middle, half = math.atan2(sine, cosine), math.acos(min(max(share, -1.0), 1.0))
        return (middle - half, middle + half)

    def _is_pitched(self, axis: Vector) -> bool:
        """True if the joints in the plane may turn the tool's axis to a direction, given with the plane at zero."""
        pitch = self._pitch
        if pitch is None:
            raise AssertionError("checked before: joints turn in the plane")
        if abs(float(pitch.axis @ (axis - self._tool_axis))) > _ANGLE_TOLERANCE_RAD:
            return False
        before = self._tool_axis - float(pitch.axis @ self._tool_axis) * pitch.axis
        after = axis - float(pitch.axis @ axis) * pitch.axis
        if min(np.linalg.norm(before), np.linalg.norm(after)) < _LEAST_SHARE:
            return True
        return pitch.admits(math.atan2(float(pitch.axis @ np.cross(before, after)), float(before @ after)))


def _turn_of(arm: Arm, directions: Vector, joints: Sequence[int]) -> _Turn:
    """Rotation by the sum of some joints of the model, over the ranges of the driven ones."""
    axis = directions[joints[0]]
    signs = np.array([math.copysign(1.0, float(directions[joint] @ axis)) for joint in joints])
    shares = signs @ arm.coupling.matrix[joints]
    offset = float(signs @ arm.coupling.offset[joints])
    ends = np.stack([shares * arm.lower_rad, shares * arm.upper_rad])
    return _Turn(
        axis=axis,
        lower_rad=offset + float(ends.min(axis=0).sum()),
        upper_rad=offset + float(ends.max(axis=0).sum()),
    )


def _is_parallel(one: Vector, other: Vector) -> bool:
    return bool(np.linalg.norm(np.cross(one, other)) < _PARALLEL)


def _rotated(vector: Vector, axis: Vector, angle_rad: float) -> Vector:
    """A vector rotated about a unit axis (Rodrigues' formula)."""
    cosine, sine = math.cos(angle_rad), math.sin(angle_rad)
    rotated: Vector = cosine * vector + sine * np.cross(axis, vector) + (1 - cosine) * float(axis @ vector) * axis
    return rotated
