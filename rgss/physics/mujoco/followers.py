"""Followers of an arm in MuJoCo, which equality constraints hold on their driven joints."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import Robot

Array = NDArray[np.float64]


class MujocoFollowers:
    """Positions and efforts of an arm's followers; no effect for an arm without."""

    def __init__(self, model: Any, data: Any, robot: Robot) -> None:
        """Look up the joints.

        Args:
            model: The engine's model.
            data: Its state.
            robot: The arm.
        """
        self._data, self._robot = data, robot
        driven = [joint.name for joint in robot.joints]
        self._driven_at = np.array([model.joint(name).qposadr[0] for name in driven], dtype=int)
        self._driven_dofs = np.array([model.joint(name).dofadr[0] for name in driven], dtype=int)
        self._positions = np.array([model.joint(one.name).qposadr[0] for one in robot.followers], dtype=int)
        self._dofs = np.array([model.joint(one.name).dofadr[0] for one in robot.followers], dtype=int)
        self._ratios = np.zeros((len(robot.followers), len(driven)))
        for row, one in enumerate(robot.followers):
            self._ratios[row, one.driver] = one.multiplier

    def reset(self, driven: Array) -> None:
        """Put the followers where the driven joints put them.

        Args:
            driven: Positions of the driven joints in rad or m, shape (n,).
        """
        self._data.qpos[self._positions] = self._robot.follower_positions(driven.tolist())

    def accelerate(self, accelerations: Array) -> None:
        """Complete accelerations of all degrees of freedom of the model by those of the followers.

        Args:
            accelerations: With those of the driven joints; modified in place.
        """
        if len(self._dofs):
            accelerations[self._dofs] = self._ratios @ accelerations[self._driven_dofs]

    def driven_efforts(self, efforts: Array) -> Array:
        """Efforts of the driven joints in N·m or N with what they transmit to followers, shape (n,).

        Args:
            efforts: Efforts that each degree of freedom of the model needs by itself.
        """
        own: Array = efforts[self._driven_dofs]
        return own + self._ratios.T @ efforts[self._dofs] if len(self._dofs) else own

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a follower from where its driven joint puts it, in rad or m; 0 without followers."""
        qpos = self._data.qpos
        wanted = self._robot.follower_positions(qpos[self._driven_at].tolist())
        return float(np.abs(qpos[self._positions] - np.array(wanted)).max(initial=0.0))
