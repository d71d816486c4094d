"""Grip control: commanded finger force and its increases."""

from __future__ import annotations

from rgss.physics import ContactWorld
from rgss.trials.monitors import GripEstimate
from rgss.trials.plants import ControlSettings


class GripControl:
    """Commanded finger force of a task, from a share of the greatest force up to the greatest force.

    Attributes:
        force_n: Commanded force of each finger.
        tightenings: Number of increases in this phase.
        since_tightening_s: Carrying time since the last increase; the caller adds each step.
        mass_kg: Mass of the object assumed by the robot.
        friction: Coefficient of a finger on the object assumed by the robot.
    """

    def __init__(
        self,
        world: ContactWorld,
        control: ControlSettings,
        estimate: GripEstimate | None = None,
        *,
        is_regulated: bool = True,
    ) -> None:
        """Start with the share for an object at rest.

        Args:
            world: The world with the fingers.
            control: The shares, and the least time between two increases.
            estimate: Grip estimate of the robot; None if the true values are known.
            is_regulated: Whether the force can be increased; otherwise it is the greatest from the start.
        """
        self._world = world
        self._control = control
        self.force_n = (control.holding_share if is_regulated else 1.0) * world.gripper.finger_force_n
        self.tightenings = 0
        self.since_tightening_s = 0.0
        workpiece = world.scene.workpiece
        self._estimate = estimate
        self.mass_kg = workpiece.mass_kg if estimate is None else estimate.mass_kg
        own = world.gripper.grip_coefficient(workpiece.friction)
        self.friction = own if estimate is None else estimate.friction

    def begin_phase(self) -> None:
        """Restart counting and averaging."""
        self.tightenings = 0
        if self._estimate is not None:
            self._estimate.begin_phase()

    def readings(self, forces_n: tuple[float, ...]) -> tuple[float, ...]:
        """Sensed normal forces of the fingers in this step.

        Args:
            forces_n: The true forces.
        """
        return forces_n if self._estimate is None else self._estimate.read(forces_n)

    def margin(self, true_margin: float | None, forces_n: tuple[float, ...], load_m_s2: float) -> float | None:
        """Grip margin estimated by the robot after a step; None before an estimate is available.

        Args:
            true_margin: The true margin.
            forces_n: The fingers' true normal forces.
            load_m_s2: Tool acceleration minus gravity, in magnitude.
        """
        return true_margin if self._estimate is None else self._estimate.after_step(forces_n, load_m_s2)

    def close(self) -> None:
        """Close the fingers with the commanded force."""
        self._world.drive_fingers(self._world.gripper.finger_velocity_m_s, self.force_n)

    def keep(self) -> None:
        """Increase the force if friction is insufficient for the load, at most once in the force window."""
        if self.since_tightening_s >= self._control.force_window_s:
            self.tighten()

    def tighten(self) -> None:
        """Increase the force by one share, up to the greatest."""
        greatest_n = self._world.gripper.finger_force_n
        if self.force_n >= greatest_n:
            return
        self.force_n = min(greatest_n, self.force_n + self._control.tightening_share * greatest_n)
        self.since_tightening_s = 0.0
        self.tightenings += 1
        self.close()
