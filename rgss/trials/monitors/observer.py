"""Observer of the physics steps of a task."""

from __future__ import annotations

from typing import Protocol

from rgss.physics import Contacts, ContactWorld


class StepObserver(Protocol):
    """Callback after each physics step; read-only."""

    def after_step(
        self,
        world: ContactWorld,
        phase: str,
        contacts: Contacts,
        grip_margin: float | None,
        commanded_force_n: float | None,
    ) -> None:
        """Receive a step.

        Args:
            world: The world after the step.
            phase: The phase of the step.
            contacts: The contacts of the step.
            grip_margin: Friction available over friction needed; None while unknown.
            commanded_force_n: Commanded force of each finger; None while the hand opens.
        """
