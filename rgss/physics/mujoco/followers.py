"""Followers of an arm in MuJoCo, which equality constraints hold on their driven joints.

A constraint of the engine has no greatest effort. Where a coupling gives way, a tendon with dry friction replaces it,
which resists the deviation of the follower from its ratio with the effort of the coupling, in both directions.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics.mujoco.engine import mujoco
from rgss.physics.mujoco.mjcf import number
from rgss.physics.slipping import slipped
from rgss.scenes import Follower, Robot

Array = NDArray[np.float64]
# How long a constraint exceeds an effort before its coupling gives way.
_OVERLOADED_S = 0.01
# Of the friction of a tendon; with the engine's default a coupling at its effort creeps by 2 mrad/s.
_IMPEDANCE = "0.9999 0.9999 0.001"


def add_clutch(root: ET.Element, follower: Follower, driver: str) -> None:
    """Add the tendon of a follower to a model, without friction as long as its constraint holds.

    Args:
        root: The model.
        follower: A follower with a finite effort.
        driver: Name of its driven joint.
    """
    tendons = root.find("tendon")
    parent = ET.SubElement(root, "tendon") if tendons is None else tendons
    tendon = ET.SubElement(parent, "fixed", {"name": follower.name, "solimpfriction": _IMPEDANCE})
    ET.SubElement(tendon, "joint", {"joint": follower.name, "coef": "1"})
    ET.SubElement(tendon, "joint", {"joint": driver, "coef": number(-follower.multiplier)})


class MujocoFollowers:
    """Positions and efforts of an arm's followers; no effect for an arm without."""

    def __init__(self, model: Any, data: Any, robot: Robot) -> None:
        """Look up the joints.

        Args:
            model: The engine's model.
            data: Its state.
            robot: The arm.
        """
        self._model, self._data, self._robot = model, data, robot
        driven = [joint.name for joint in robot.joints]
        self._driven_at = np.array([model.joint(name).qposadr[0] for name in driven], dtype=int)
        self._driven_dofs = np.array([model.joint(name).dofadr[0] for name in driven], dtype=int)
        self._positions = np.array([model.joint(one.name).qposadr[0] for one in robot.followers], dtype=int)
        self._dofs = np.array([model.joint(one.name).dofadr[0] for one in robot.followers], dtype=int)
        self._ratios = np.zeros((len(robot.followers), len(driven)))
        for row, one in enumerate(robot.followers):
            self._ratios[row, one.driver] = one.multiplier
        self._bounds = {int(model.equality(one.name).id): one for one in robot.followers if math.isfinite(one.effort)}
        self._clutches = {key: int(model.tendon(one.name).id) for key, one in self._bounds.items()}
        self._beyond = dict.fromkeys(self._bounds, 0)
        self._steps = max(1, round(_OVERLOADED_S / model.opt.timestep))
        self._of_equality = int(mujoco().mjtConstraint.mjCNSTR_EQUALITY)

    def reset(self, driven: Array) -> None:
        """Put the followers where the driven joints put them.

        Args:
            driven: Positions of the driven joints in rad or m, shape (n,).
        """
        self._data.qpos[self._positions] = self._robot.follower_positions(driven.tolist())
        self._beyond = dict.fromkeys(self._bounds, 0)
        for constraint, clutch in self._clutches.items():
            self._data.eq_active[constraint], self._model.tendon_frictionloss[clutch] = 1, 0.0

    def after_step(self) -> None:
        """Release the couplings whose equality constraint exceeds the effort that they transmit."""
        if not self._bounds:
            return
        data, of_equality = self._data, self._of_equality
        kinds, ids = data.efc_type[: data.nefc].tolist(), data.efc_id[: data.nefc].tolist()
        for row, (kind, constraint) in enumerate(zip(kinds, ids, strict=True)):
            if kind != of_equality or constraint not in self._bounds:
                continue
            is_beyond = abs(float(data.efc_force[row])) > self._bounds[constraint].effort
            self._beyond[constraint] = self._beyond[constraint] + 1 if is_beyond else 0
            if self._beyond[constraint] >= self._steps:
                self._data.eq_active[constraint] = 0
                self._model.tendon_frictionloss[self._clutches[constraint]] = self._bounds[constraint].effort

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
    def slipped(self) -> str:
        """Name of a follower whose coupling has given way; empty if none has."""
        qpos = self._data.qpos
        return slipped(self._robot, qpos[self._driven_at].tolist(), qpos[self._positions].tolist())

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a follower from where its driven joint puts it, in rad or m; 0 without followers."""
        qpos = self._data.qpos
        wanted = self._robot.follower_positions(qpos[self._driven_at].tolist())
        return float(np.abs(qpos[self._positions] - np.array(wanted)).max(initial=0.0))
