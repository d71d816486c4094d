"""Command of the motor of a linkage for a velocity and a force of its pads."""

from __future__ import annotations

from rgss.scenes import Linkage, motion_of


def motor_command(
    linkage: Linkage, driven: float, *, velocity_m_s: float, force_n: float, step_s: float
) -> tuple[float, float]:
    """Velocity and greatest effort of the driven joint, by the Jacobian J at its position: v / J and 2 J F.

    Args:
        linkage: The mechanism.
        driven: Present position of the driven joint in rad or m.
        velocity_m_s: Velocity of each pad; positive closes.
        force_n: Greatest force of each pad; the effort of the driven joint limits it.
        step_s: Length of a step; the joint does not pass its end within one.
    """
    transmission = motion_of(linkage).transmission(driven)
    towards = 1.0 if linkage.closed > linkage.opened else -1.0
    end = linkage.closed if velocity_m_s >= 0.0 else linkage.opened
    # A joint limit of an engine yields to the motor by a tenth of a millimetre and more.
    left = abs(end - driven) / step_s if (end - driven) * towards * velocity_m_s > 0.0 else 0.0
    speed = min(abs(velocity_m_s) / transmission, linkage.speed, left)
    effort = min(len(linkage.pads) * transmission * force_n, linkage.effort)
    return towards * (speed if velocity_m_s >= 0.0 else -speed), effort
