"""A MuJoCo model in motion: joints that follow targets, fingers that press, contacts that are read."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from .machine import CUP, TOOL

_FREQUENCY_RAD_S = 300.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Touching:
    """What touched what in a step.

    Attributes:
        finger_forces_n: Normal force of each finger on the cup.
        cup: Names of the other shapes that the cup touched.
        machine: Names of the shapes of machine and scene that touched, in pairs.
    """

    finger_forces_n: tuple[float, ...]
    cup: tuple[str, ...]
    machine: tuple[tuple[str, str], ...]


class SteppedModel:
    """A model with driven joints, a hand and a cup.

    The driven joints follow their targets by computed torque: inverse dynamics of the target
    acceleration, by the engine's own mass matrix and bias forces, and a critically damped
    correction. So the machine is dynamic and its torques are bounded. With positions written into
    the state instead, the contact solver would see a hand that is elsewhere in every step without
    having moved, and friction would not carry the cup along.

    Attributes:
        step_s: Length of a step.
        torque_ratio: Greatest share of its limit that was asked of a driven joint's motor.
    """

    def __init__(self, root: ET.Element, *, driven: Sequence[str], fingers: Sequence[str]) -> None:
        """Compile a model.

        Args:
            root: The model.
            driven: Names of the joints that follow targets, each with a motor of the same name.
            fingers: Names of the fingers.
        """
        model = mujoco.MjModel.from_xml_string(ET.tostring(root, encoding="unicode"))
        self._model, self._data = model, mujoco.MjData(model)
        self.step_s = float(model.opt.timestep)
        self.torque_ratio = 0.0
        self._positions = np.array([model.joint(name).qposadr[0] for name in driven])
        self._speeds = np.array([model.joint(name).dofadr[0] for name in driven])
        self._motors = np.array([model.actuator(name).id for name in driven])
        self._limits = model.actuator_forcerange[self._motors, 1]
        self._travels = np.array([model.joint(name).qposadr[0] for name in fingers])
        self._finger_motors = np.array([model.actuator(name).id for name in fingers])
        self._names = [model.geom(index).name for index in range(model.ngeom)]
        self._cup_shape = model.geom(CUP).id
        self._finger_of_shape = {model.geom(name).id: index for index, name in enumerate(fingers)}
        self._tool, self._cup = self._data.site(TOOL), self._data.body(CUP)
        first = model.body(CUP).dofadr[0]
        self._cup_speeds = slice(first, first + 6)
        self._previous_speed = np.zeros(len(driven))
        self._wanted, self._needed = np.zeros(model.nv), np.zeros(model.nv)

    def reset(self, position: Sequence[float]) -> None:
        """Put the driven joints at rest at a position."""
        mujoco.mj_resetData(self._model, self._data)
        self._data.qpos[self._positions] = position
        self._previous_speed = np.zeros(len(self._positions))
        mujoco.mj_forward(self._model, self._data)

    def drive_fingers(self, speed_m_s: float, force_n: float) -> None:
        """Move every finger at a speed (positive closes) with at most a force."""
        self._data.ctrl[self._finger_motors] = speed_m_s
        self._model.actuator_forcerange[self._finger_motors] = (-force_n, force_n)

    def step(self, position: np.ndarray, speed: np.ndarray) -> None:
        """Advance by one step.

        Args:
            position: Target of the driven joints at its start.
            speed: Their mean target speed over it.

        Raises:
            RuntimeError: The engine warned, of an instability for instance.
        """
        model, data = self._model, self._data
        mujoco.mj_step1(model, data)
        lag = position - data.qpos[self._positions]
        slowness = self._previous_speed - data.qvel[self._speeds]
        correction = _FREQUENCY_RAD_S**2 * lag + 2 * _FREQUENCY_RAD_S * slowness
        self._wanted[self._speeds] = (speed - self._previous_speed) / self.step_s + correction
        self._previous_speed = speed
        mujoco.mj_mulM(model, data, self._needed, self._wanted)
        torque = (self._needed + data.qfrc_bias)[self._speeds]
        data.ctrl[self._motors] = torque
        self.torque_ratio = max(self.torque_ratio, float(np.max(np.abs(torque) / self._limits)))
        mujoco.mj_step2(model, data)
        mujoco.mj_kinematics(model, data)
        if data.warning.number.any():
            raise RuntimeError(f"the engine warned: {data.warning.number.tolist()}")

    @property
    def tool_m(self) -> np.ndarray:
        """Position (3,) of the grasp centre in the world."""
        return self._tool.xpos.copy()

    @property
    def cup_m(self) -> np.ndarray:
        """Position (3,) of the cup's centre in the world."""
        return self._cup.xpos.copy()

    @property
    def cup_axis(self) -> np.ndarray:
        """Direction (3,) of the cup's axis in the world."""
        return self._cup.xmat.reshape(3, 3)[:, 2].copy()

    @property
    def cup_in_hand_m(self) -> np.ndarray:
        """Position (3,) of the cup's centre in the frame of the grasp centre."""
        return self._tool.xmat.reshape(3, 3).T @ (self._cup.xpos - self._tool.xpos)

    @property
    def cup_speed(self) -> tuple[float, float]:
        """Linear (m/s) and angular (rad/s) speed of the cup."""
        speed = self._data.qvel[self._cup_speeds]
        return float(np.linalg.norm(speed[:3])), float(np.linalg.norm(speed[3:]))

    @property
    def finger_travel_m(self) -> np.ndarray:
        """How far each finger has closed from its open end."""
        return self._data.qpos[self._travels]

    def touching(self) -> Touching:
        """What touched what in the last step."""
        contact, force = self._data.contact, self._data.efc_force
        forces = [0.0] * len(self._finger_motors)
        cup, machine = [], []
        for (one, other), row in zip(contact.geom.tolist(), contact.efc_address.tolist(), strict=True):
            if self._cup_shape not in (one, other):
                machine.append((self._names[one], self._names[other]))
                continue
            partner = other if one == self._cup_shape else one
            finger = self._finger_of_shape.get(partner)
            if finger is None:
                cup.append(self._names[partner])
            elif row >= 0:
                # With elliptic cones the first row of a contact is its normal force.
                forces[finger] += float(force[row])
        return Touching(finger_forces_n=tuple(forces), cup=tuple(cup), machine=tuple(machine))
