"""The payload rig: a hand on a vertical rail over a cup that stands."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rgss.scenes import Cylinder, Gripper, Pose

from .machine import RAIL, add_cup, add_hand, add_rail, add_support, empty_model, finger_names
from .stepping import SteppedModel

_STEP_S = 5.0e-4
_SUPPORT = "support"
# So heavy that the load, which the motor learns of only through the correction, takes nothing from the acceleration.
_CARRIAGE_KG = 1.0e4
_RAIL_FORCE_N = 1.0e6
_CLOSING_S = 1.2
_LIFT_S = 0.4
_SETTLING_S = 0.2
_HOLDING_S = 1.0
_CREEP_LIFT_M = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class Lift:
    """A cup that was grasped and lifted.

    Attributes:
        finger_forces_n: Normal force of each finger after closing.
        slip_m: Displacement of the cup in the hand since then.
        risen_m: Height that the hand rose.
    """

    finger_forces_n: tuple[float, ...]
    slip_m: float
    risen_m: float


class Rig:
    """A hand over a cup; the cup is gripped at its centre."""

    def __init__(
        self, gripper: Gripper, shape: Cylinder, mass_kg: float, *, friction: float, gravity_m_s2: float
    ) -> None:
        """Build the rig.

        Args:
            gripper: The gripper.
            shape: The cup's shape.
            mass_kg: Its mass.
            friction: Coefficient of the pair of finger and cup.
            gravity_m_s2: Magnitude of gravity.
        """
        root = empty_model(gravity_m_s2, step_s=_STEP_S)
        half_m = shape.half_height_m
        add_support(root, _SUPPORT)
        above = (0.0, 0.0, half_m + gripper.geometry.grasp_depth_m)
        flange = Pose.from_roll_pitch_yaw(above, (math.pi, 0.0, 0.0))
        add_hand(root, add_rail(root, flange, carriage_kg=_CARRIAGE_KG, force_n=_RAIL_FORCE_N), gripper)
        # The cup stands without friction, so that the support takes nothing of what the fingers press.
        frictions = {_SUPPORT: 0.0, **dict.fromkeys(finger_names(gripper), friction)}
        add_cup(root, shape, mass_kg, Pose(position_m=(0.0, 0.0, half_m)), frictions)
        self._engine = SteppedModel(root, driven=[RAIL], fingers=finger_names(gripper))
        self._gripper = gripper
        self._height_m = 0.0

    def lift(self, acceleration_m_s2: float) -> Lift:
        """Close the hand and lift it with a constant acceleration."""
        engine = self._engine
        self._close()
        held, forces = engine.cup_in_hand_m, engine.touching().finger_forces_n
        height_m = acceleration_m_s2 * (np.arange(round(_LIFT_S / _STEP_S) + 1) * _STEP_S) ** 2 / 2
        begin = engine.tool_m[2]
        self._follow(height_m)
        slip = float(np.linalg.norm(engine.cup_in_hand_m - held))
        return Lift(finger_forces_n=forces, slip_m=slip, risen_m=float(engine.tool_m[2] - begin))

    def creep_m_s(self) -> float:
        """Close the hand, lift the cup, and see how fast it moves in the hand that stands."""
        engine = self._engine
        self._close()
        phase = np.linspace(0.0, np.pi, round(_LIFT_S / _STEP_S) + 1)
        self._follow(_CREEP_LIFT_M * (1 - np.cos(phase)) / 2)
        self._stand(_SETTLING_S)
        assert engine.touching().cup == ()
        before = engine.cup_in_hand_m
        self._stand(_HOLDING_S)
        return float(np.linalg.norm(engine.cup_in_hand_m - before)) / _HOLDING_S

    def _close(self) -> None:
        self._engine.reset([0.0])
        self._engine.drive_fingers(self._gripper.finger_velocity_m_s, self._gripper.finger_force_n)
        self._stand(_CLOSING_S)

    def _stand(self, duration_s: float) -> None:
        here, still = np.array([self._height_m]), np.zeros(1)
        for _ in range(round(duration_s / _STEP_S)):
            self._engine.step(here, still)

    def _follow(self, height_m: np.ndarray) -> None:
        for start, end in pairwise(height_m.tolist()):
            self._engine.step(np.array([start]), np.array([(end - start) / _STEP_S]))
        self._height_m = float(height_m[-1])
