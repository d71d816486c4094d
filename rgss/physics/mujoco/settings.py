"""Step, solver and contact stiffness of a world of MuJoCo."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.physics.contact_world import ContactWorld
from rgss.physics.mujoco.world import MujocoWorld
from rgss.physics.opening import OtherEngineSettings
from rgss.scenes import Gripper, Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class MujocoSettings(OtherEngineSettings):
    """Resolution of a simulation in MuJoCo.

    Attributes:
        rate_hz: Steps a second.
        solver_iterations: Greatest number of Newton iterations in a step; they end at a tolerance of 1e-10, mostly
        after a few.
        contact_time_constant_s: Time constant of contacts and joint limits, which yield like critically damped springs.
        The impact of a closing finger depends on it (12 N at 4 ms and 15 N at 2 ms for a command of 7 N), the holding
        force does not.
    """

    engine: str = "mujoco"
    rate_hz: float = 2000.0
    solver_iterations: int = 100
    contact_time_constant_s: float = 4.0e-3

    def open(self, scene: Scene, gripper: Gripper, *, joint_offsets_rad: Sequence[float] = ()) -> ContactWorld:
        """A fresh world of MuJoCo; see `OtherEngineSettings.open`."""
        return MujocoWorld(
            *(scene, gripper, self),
            contact_time_constant_s=self.contact_time_constant_s,
            joint_offsets_rad=joint_offsets_rad,
        )

    def lightest_body_kg(self, *, force_n: float, speed_m_s: float, iterations: int | None = None) -> float:  # noqa: ARG002
        """Least mass of a body that transmits a finger's force: 0, since Newton's method solves a step exactly."""
        return 0.0
