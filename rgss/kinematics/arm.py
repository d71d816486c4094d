"""Forward kinematics and Jacobians of the arm at its tool centre."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rgss.kinematics.coupling import Coupling
from rgss.kinematics.description import build_model, link_frame, pose_of, transform
from rgss.scenes import Pose, Robot

Vector = NDArray[np.float64]


class Arm:
    """A serial arm with a tool at its flange.

    An array of joint positions has one entry for each driven joint, from the base to the flange: in rad for a revolute
    joint, in m for a prismatic one. n is the number of driven joints, m that with followers, k that of configurations.

    Args:
        robot: The arm.
        tool: Transform of the tool-centre frame to the flange.

    Raises:
        DefinitionError: The robot's description and its data contradict each other.
    """

    def __init__(self, robot: Robot, tool: Pose) -> None:
        import pinocchio

        self.robot = robot
        self.tool = tool
        self._engine: Any = pinocchio
        self._model = build_model(robot)
        self.coupling = Coupling.of(robot, self._model)
        flange = link_frame(self._model, robot.flange)
        self._tool = self._model.addFrame(
            pinocchio.Frame(
                "tool_centre", flange.parentJoint, flange.placement * transform(tool), pinocchio.FrameType.OP_FRAME
            )
        )
        self._data = self._model.createData()
        directions, steps = self.joint_axes()
        self._axes = directions
        self._slides = self.coupling.slides.tolist()
        self._rodrigues = [_rodrigues(direction) for direction in directions]
        self._points = np.cumsum(steps, axis=0)

    @property
    def lower_rad(self) -> Vector:
        """Lower limits of the joints' planning ranges, in rad or m, shape (n,)."""
        return np.array([joint.lower_rad for joint in self.robot.joints])

    @property
    def upper_rad(self) -> Vector:
        """Upper limits of the joints' planning ranges, in rad or m, shape (n,)."""
        return np.array([joint.upper_rad for joint in self.robot.joints])

    def tool_pose(self, q: Sequence[float] | Vector) -> Pose:
        """Transform of the tool-centre frame to the world (forward kinematics).

        Args:
            q: Joint positions, shape (n,).
        """
        return pose_of(self._placement(q))

    @property
    def reach_m(self) -> float:
        """Upper bound of the distance between any joint axis and the tool in m.

        The link lengths summed from the first axis to the tool, with prismatic joints extended.
        """
        lower, upper = self.coupling.positions(self.lower_rad), self.coupling.positions(self.upper_rad)
        extended = np.maximum(np.abs(lower), np.abs(upper))[self.coupling.slides]
        slides = math.fsum(extended.tolist())
        return float(np.linalg.norm(np.diff(self._points, axis=0), axis=1).sum()) + slides

    @property
    def first_axis_m(self) -> tuple[float, float, float]:
        """Origin of the first joint in the world in m, shape (3,), from which `reach_m` is measured."""
        x, y, z = self._points[0].tolist()
        return (x, y, z)

    def tool_position(self, qs: ArrayLike) -> Vector:
        """Positions of the tool centre in the world.

        Args:
            qs: Joint positions, shape (k, n).

        Returns:
            Positions in m, shape (k, 3).
        """
        return self._tool_motion(self.coupling.positions(np.atleast_2d(np.asarray(qs, dtype=float))), None)[0]

    def tool_motion(self, qs: ArrayLike, dqs: ArrayLike) -> tuple[Vector, Vector]:
        """Positions and velocities of the tool centre in the world.

        Args:
            qs: Joint positions, shape (k, n).
            dqs: Joint speeds in rad/s or m/s, shape (k, n).

        Returns:
            Positions in m and velocities in m/s, each of shape (k, 3).
        """
        rows, rates = (np.atleast_2d(np.asarray(values, dtype=float)) for values in (qs, dqs))
        return self._tool_motion(self.coupling.positions(rows), self.coupling.rates(rates))

    def _tool_motion(self, rows: Vector, rates: Vector | None) -> tuple[Vector, Vector]:
        # The tool is rotated about one axis after another in their zero configuration, the last first (product of
        # exponentials), by Rodrigues' formula: all configurations at once.
        cosines, sines = np.cos(rows), np.sin(rows)
        positions: Vector = np.tile(self._points[-1], (len(rows), 1))
        velocities = np.zeros((len(rows), 3))
        for joint in reversed(range(len(self._rodrigues))):
            if self._slides[joint]:
                positions = positions + rows[:, joint, None] * self._axes[joint]
                if rates is not None:
                    velocities = velocities + rates[:, joint, None] * self._axes[joint]
                continue
            point, turn = self._points[joint], self._rodrigues[joint]
            cosine, sine = cosines[:, joint, None], sines[:, joint, None]
            arms = _turned(positions - point, turn, cosine, sine)
            positions = point + arms
            if rates is not None:
                velocities = _turned(velocities, turn, cosine, sine) + rates[:, joint, None] * (arms @ turn[:, 6:])
        return positions, velocities

    def tool_jacobian(self, q: Sequence[float] | Vector) -> Vector:
        """Jacobian at the tool centre along the axes of the world: ``(v, ω) = J(q) q̇``.

        Args:
            q: Joint positions, shape (n,).

        Returns:
            Shape (6, n): the linear rows first, in m/rad or m/m, then the angular rows.
        """
        jacobian: Vector = self._engine.computeFrameJacobian(
            self._model,
            self._data,
            self.coupling.positions(q),
            self._tool,
            self._engine.ReferenceFrame.LOCAL_WORLD_ALIGNED,
        )
        # The engine gives a vector for a single joint.
        return self.coupling.reduced(jacobian.reshape(6, -1))

    def joint_axes(self) -> tuple[Vector, Vector]:
        """Axes of the joints, followers among them, and a point of the tool with all of them at zero, in the world.

        Returns:
            Unit directions, shape (m, 3), and the steps between points on consecutive axes, shape (m + 1, 3): from the
            world's origin to the first, …, from the last to the tool centre. This is the product-of-exponentials form,
            the input of the analytic inverse kinematics.
        """
        zero = np.zeros(self._model.nq)
        jacobian = np.array(self._engine.computeJointJacobians(self._model, self._data, zero))
        directions = np.where(self.coupling.slides[:, None], jacobian[:3].T, jacobian[3:].T)
        joints = [self._data.oMi[index].translation for index in range(1, self._model.njoints)]
        points = np.array([np.zeros(3), *joints, self._placed(zero).translation])
        return directions, np.diff(points, axis=0)

    def tool_rotation_at_zero(self) -> Vector:
        """Orientation of the tool-centre frame in the world with all joints at zero, shape (3, 3)."""
        return np.array(self._placed(np.zeros(self._model.nq)).rotation)

    def tool_matrix(self, q: Sequence[float] | Vector) -> Vector:
        """Homogeneous transform of the tool-centre frame to the world, shape (4, 4)."""
        return np.array(self._placement(q).homogeneous)

    def _placement(self, q: Sequence[float] | Vector) -> Any:
        return self._placed(self.coupling.positions(q))

    def _placed(self, positions: Vector) -> Any:
        self._engine.forwardKinematics(self._model, self._data, positions)
        return self._engine.updateFramePlacement(self._model, self._data, self._tool)


def _turned(vectors: Vector, rodrigues: Vector, cosine: Vector, sine: Vector) -> Vector:
    """Vectors, shape (n, 3), each rotated about an axis by its own angle."""
    parts = vectors @ rodrigues
    return parts[:, :3] + cosine * parts[:, 3:6] + sine * parts[:, 6:]


def _rodrigues(axis: Vector) -> Vector:
    """Matrix, shape (3, 9), that splits a vector v into its parts along and across an axis a, and a × v."""
    x, y, z = axis
    along = np.outer(axis, axis)
    return np.hstack([along, np.eye(3) - along, np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])])
