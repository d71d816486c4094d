"""Bodies that are too light for the solver to pass the force of a finger's motor through them."""

from __future__ import annotations

from rgss.physics.settings import MOST_ITERATIONS, PhysicsSettings
from rgss.scenes import Gripper

_SHARE_BY_GEARS = 6.0


def passing_mass_kg(gripper: Gripper) -> float:
    """Mass of a finger that counts when the solver passes its motor's force to an object.

    A linkage passes it through gears, which takes six times the iterations of sliding fingers. Measured on two cranks,
    a Robotiq 2F-85 and a 2F-140: with fewer, held objects slip by up to five times as much as with four times the rate,
    and with a third of them light fingers press with half of their force.
    """
    return gripper.driven_mass_kg / _iteration_share(gripper)


def light_fingers(gripper: Gripper, physics: PhysicsSettings) -> tuple[str, str] | None:
    """Problem and remedy of fingers that do not press with their force, whatever the iterations; None for others."""
    if gripper.suction is not None:
        return None
    least_kg = _least_kg(gripper, physics)
    if passing_mass_kg(gripper) >= least_kg:
        return None
    is_linkage = gripper.geometry.linkage is not None
    problem = (
        f"fingers of {gripper.driven_mass_kg:.3g} kg{' at their pads' if is_linkage else ''} are too light for the "
        f"solver to press with {gripper.finger_force_n:g} N; it needs {least_kg * _iteration_share(gripper):.3g} kg"
    )
    stated = "give their links the masses and inertias of the real ones" if is_linkage else "state their drive_inertia"
    return problem, f"{stated}, or increase the physics rate"


def light_object(mass_kg: float, gripper: Gripper, physics: PhysicsSettings) -> tuple[str, str] | None:
    """Problem and remedy of an object that creeps out of the fingers, whatever the iterations; None for others."""
    least_kg = _least_kg(gripper, physics)
    if gripper.suction is not None or mass_kg >= least_kg:
        return None
    problem = (
        f"{mass_kg:.3g} kg are too light for the solver to press with {gripper.finger_force_n:g} N on it; it needs "
        f"{least_kg:.3g} kg"
    )
    return problem, "lower the force of the fingers, or increase the physics rate"


def _iteration_share(gripper: Gripper) -> float:
    return 1.0 if gripper.geometry.linkage is None else _SHARE_BY_GEARS


def _least_kg(gripper: Gripper, physics: PhysicsSettings) -> float:
    return physics.lightest_body_kg(
        force_n=gripper.finger_force_n, speed_m_s=gripper.finger_velocity_m_s, iterations=MOST_ITERATIONS
    )
