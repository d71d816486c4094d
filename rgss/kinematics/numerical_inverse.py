"""Numerical inverse kinematics: damped least squares from many deterministic starts."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.arm import Arm
from rgss.kinematics.configurations import TOLERANCE, RangeExcess, excesses_of, sorted_distinct, whole_turns
from rgss.kinematics.description import transform
from rgss.kinematics.planar_reach import PlanarReach
from rgss.kinematics.pose_residual import PoseResidual
from rgss.kinematics.serial_chain import SerialChain
from rgss.kinematics.sobol_points import sobol_points
from rgss.scenes import Pose

Vector = NDArray[np.float64]

_STARTS = 128
_ROUNDS_OF_FULL_POSE = (1, 7, 24, 96)
_ROUNDS = (*_ROUNDS_OF_FULL_POSE, 384)
_MOST_TRIED = 512
_ITERATIONS = 60
_CONVERGED = 1e-11
_ERROR_DAMPING, _LEAST_DAMPING = 0.5, 1e-12
_LARGEST_STEP = 1.0
# Configurations nearer than this in every joint are duplicates: two descents with the same end.
_SAME = 1e-5
_REDUNDANT_SAME = 1e-2
_DIGITS = 11
_POSE_FREEDOMS = 6


class NumericalInverse:
    """Inverse kinematics of any serial arm by damped least squares from many starts.

    The starts are the arm's home and the points of a Sobol sequence over the joints' ranges, so that the result is a
    function of arm and pose alone. All descents run at once. An arm of six joints has isolated configurations; every
    branch that a descent reaches is kept. An arm of more joints has a continuum: each descent gives one member, and
    keeps its positions within the ranges. An arm of fewer joints, which cannot orient its tool freely, may rotate it
    about its own axis if the full pose is out of reach.

    Source: T. Sugihara, "Solvability-Unconcerned Inverse Kinematics by the Levenberg-Marquardt Method", IEEE T-RO
    27(5), 2011: the damping is proportional to the squared error.

    If the rotation about the tool's axis is free, only position and axis are requested, five degrees of freedom. The
    configurations then count as a continuum: an arm of more joints has one, and an arm of five has one if its last axis
    is the tool's.

    Args:
        arm: The arm with its tool.
        is_turn_free: True if the tool may be rotated about its own axis, z.
    """

    def __init__(self, arm: Arm, *, is_turn_free: bool = False) -> None:
        self.arm = arm
        self._is_turn_free = is_turn_free
        self._chain = SerialChain(arm)
        self._reach = PlanarReach(arm)
        self._joints = arm.robot.joints
        self._turns = np.array(arm.robot.whole_turns_are_equal)
        self._lower, self._upper = arm.lower_rad, arm.upper_rad
        self._home = np.array(arm.robot.home_rad)

    @property
    def is_redundant(self) -> bool:
        """True if the configurations of a pose form a continuum, of which a sample is returned."""
        return self._is_turn_free or len(self._joints) > _POSE_FREEDOMS

    def solve(self, tool_pose_world: Pose) -> tuple[Vector, ...]:
        """Find configurations within the planning ranges that reach a pose.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            Joint positions, each of shape (n,), in lexicographic order; isolated configurations with all whole turns
            within the ranges. Empty if none is found.
        """
        for residual in self._residuals_in_reach(tool_pose_world):
            ends = self._reached(residual, self._starts(_STARTS))
            found = ends if self.is_redundant else [q for end in ends for q in self._turned(end)]
            if found:
                return sorted_distinct(found)
        return ()

    def nearest(self, tool_pose_world: Pose, reference: Sequence[float] | Vector) -> Vector | None:
        """Find a configuration within the planning ranges near another.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.
            reference: Joint positions, shape (n,).

        Returns:
            Joint positions, shape (n,): the end of the descent from the reference; if it does not converge, among the
            solutions of the first starts the one with the least maximum joint difference; None if no start converges.
        """
        near = np.asarray(reference, dtype=float)
        residuals = self._residuals_in_reach(tool_pose_world)
        starts = np.vstack([near, self._starts(_MOST_TRIED - 1)])
        for residual in residuals:
            first = 0
            # The full pose of an arm of fewer joints is given up after as many starts as in `solve`.
            for count in _ROUNDS if residual is residuals[-1] else _ROUNDS_OF_FULL_POSE:
                found = [
                    near + self._least_turn(q - near)
                    for q in self._reached(residual, starts[first : first + count])
                    if self.is_redundant or self._turned(q)
                ]
                found = [q for one in found for q in self._kept(one, near)]
                if found:
                    return min(sorted_distinct(found), key=lambda q: float(np.max(np.abs(q - near))))
                first += count
        return None

    def excess_of_ranges(self, tool_pose_world: Pose) -> tuple[RangeExcess, ...]:
        """Greatest violation of a planning range in each configuration that reaches a pose and leaves a range.

        Args:
            tool_pose_world: Transform of the tool-centre frame to the world.

        Returns:
            One entry a configuration, the least excess first; empty if the pose is out of reach.
        """
        for residual in self._residuals(tool_pose_world):
            found = excesses_of(self._reached(residual, self._starts(_STARTS), limited=False), self.arm.robot)
            if found:
                return found
        return ()

    def _residuals_in_reach(self, pose: Pose) -> tuple[PoseResidual, ...]:
        """Residuals to descend; none for a pose that no configuration within the ranges can reach."""
        target = transform(pose)
        return self._residuals(pose) if self._reach.admits(target.translation, target.rotation[:, 2]) else ()

    def _residuals(self, pose: Pose) -> tuple[PoseResidual, ...]:
        target = transform(pose)
        whole = PoseResidual(position_m=target.translation, rotation=target.rotation)
        axis = PoseResidual(position_m=target.translation, rotation=target.rotation, is_axis_alone=True)
        if self._is_turn_free:
            return (axis,)
        return (whole,) if len(self._joints) >= _POSE_FREEDOMS else (whole, axis)

    def _starts(self, count: int) -> Vector:
        """Start configurations: home, then quasi-random points, shape (count, n)."""
        # Isolated configurations are brought back into the ranges by whole turns afterwards.
        free = self._turns & (not self.is_redundant)
        lower, upper = np.where(free, -math.pi, self._lower), np.where(free, math.pi, self._upper)
        # Without the first point, the corner.
        shares = sobol_points(len(self._joints), count)[1:]
        return np.vstack([self._home, lower + shares * (upper - lower)])

    def _reached(self, residual: PoseResidual, starts: Vector, *, limited: bool = True) -> list[Vector]:
        """Distinct ends of the descents that converge to the pose."""
        is_limited = limited and self.is_redundant
        ends = np.round(self._descend(residual, starts, limited=is_limited), _DIGITS)
        if is_limited:
            # Rounding may leave the range of a joint at its limit.
            ends = np.clip(ends, self._lower, self._upper)
        same = _REDUNDANT_SAME if self.is_redundant else _SAME
        ends = ends[residual.deviation(self._chain.state(ends)) < TOLERANCE]
        if not is_limited:
            ends[:, self._turns] = _principal(ends[:, self._turns])
        kept: list[Vector] = []
        while len(ends):
            kept.append(ends[0])
            ends = ends[np.max(np.abs(self._least_turn(ends - ends[0])), axis=1) >= same]
        return kept

    def _descend(self, residual: PoseResidual, starts: Vector, *, limited: bool) -> Vector:
        qs = np.clip(starts, self._lower, self._upper) if limited else starts.copy()
        active = np.arange(len(qs))
        unit = np.eye(qs.shape[1])
        for _ in range(_ITERATIONS):
            state = self._chain.state(qs[active])
            errors, jacobians = residual.linearised(state)
            squares = np.einsum("ki,ki->k", errors, errors)
            going = squares > _CONVERGED**2
            if not going.any():
                break
            active, errors, jacobians, squares = active[going], errors[going], jacobians[going], squares[going]
            damping = (_ERROR_DAMPING * squares + _LEAST_DAMPING)[:, None, None] * unit
            transposed = jacobians.transpose(0, 2, 1)
            gradient = transposed @ errors[:, :, None]
            normal = transposed @ jacobians + damping
            steps = np.linalg.solve(normal, gradient)[:, :, 0]
            if limited:
                steps = self._within(qs[active], steps, normal, gradient)
            largest = np.max(np.abs(steps), axis=1, keepdims=True)
            qs[active] += steps * np.minimum(1.0, _LARGEST_STEP / np.maximum(largest, _LARGEST_STEP))
            if limited:
                qs[active] = np.clip(qs[active], self._lower, self._upper)
        return qs

    def _within(self, qs: Vector, steps: Vector, normal: Vector, gradient: Vector) -> Vector:
        """Steps without the components that would move a joint beyond its limit."""
        outside = ((qs <= self._lower) & (steps < 0.0)) | ((qs >= self._upper) & (steps > 0.0))
        rows = np.flatnonzero(outside.any(axis=1))
        if not len(rows):
            return steps
        fixed = outside[rows]
        free = ~fixed
        system = normal[rows] * (free[:, :, None] & free[:, None, :]) + fixed[:, :, None] * np.eye(qs.shape[1])
        steps[rows] = np.linalg.solve(system, gradient[rows] * free[:, :, None])[:, :, 0]
        return steps

    def _turned(self, q: Vector) -> list[Vector]:
        """All configurations within the ranges that equal one modulo whole turns."""
        choices = []
        for joint, position, turns in zip(self._joints, q.tolist(), self._turns.tolist(), strict=True):
            if turns:
                choices.append(whole_turns(position, joint.lower_rad, joint.upper_rad))
            else:
                choices.append([position] if joint.lower_rad - _SAME <= position <= joint.upper_rad + _SAME else [])
        return [np.clip(choice, self._lower, self._upper) for choice in itertools.product(*choices)]

    def _kept(self, q: Vector, near: Vector) -> list[Vector]:
        """A configuration if it is within the ranges, else the nearest equivalent one modulo whole turns."""
        if np.all((q >= self._lower) & (q <= self._upper)):
            return [q]
        return sorted(self._turned(q), key=lambda one: float(np.max(np.abs(one - near))))[:1]

    def _least_turn(self, difference: Vector) -> Vector:
        """Difference of joint positions modulo whole turns; unchanged for a redundant arm, whose ranges bound it."""
        if self.is_redundant:
            return difference
        turn = 2 * math.pi
        return np.where(self._turns, difference - turn * np.round(difference / turn), difference)


def _principal(angles: Vector) -> Vector:
    turn = 2 * math.pi
    found: Vector = angles - turn * np.round(angles / turn)
    return found
