"""Followers of an arm in MuJoCo, which equality constraints hold on their driven joints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics.mujoco.engine import mujoco
from rgss.scenes import Robot

Array = NDArray[np.float64]
# How long a constraint exceeds an effort before its coupling counts as slipping.
_SLIPPING_S = 0.01


class MujocoFollowers:
    """Positions and efforts of an arm's followers; no effect for an arm without.

    Attributes:
        slipped: Name of a follower whose coupling does not transmit what it needs; empty if none. Its constraint holds
            all the same.
    """

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
        self._bounds = {int(model.equality(one.name).id): one for one in robot.followers if math.isfinite(one.effort)}
        self._beyond = dict.fromkeys(self._bounds, 0)
        self._steps = max(1, round(_SLIPPING_S / model.opt.timestep))
        self._of_equality = int(mujoco().mjtConstraint.mjCNSTR_EQUALITY)
        self.slipped = ""

    def reset(self, driven: Array) -> None:
        """Put the followers where the driven joints put them.

        Args:
            driven: Positions of the driven joints in rad or m, shape (n,).
        """
        self._data.qpos[self._positions] = self._robot.follower_positions(driven.tolist())
        self._beyond, self.slipped = dict.fromkeys(self._bounds, 0), ""

    def after_step(self) -> None:
        """Compare the efforts of the equality constraints in the last step with those that couplings transmit."""
        if not self._bounds:
            return
        data, of_equality = self._data, self._of_equality
        kinds, ids = data.efc_type[: data.nefc].tolist(), data.efc_id[: data.nefc].tolist()
        for row, (kind, number) in enumerate(zip(kinds, ids, strict=True)):
            if kind != of_equality or number not in self._bounds:
                continue
            is_beyond = abs(float(data.efc_force[row])) > self._bounds[number].effort
            self._beyond[number] = self._beyond[number] + 1 if is_beyond else 0
            if self._beyond[number] >= self._steps:
                self.slipped = self._bounds[number].name

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
