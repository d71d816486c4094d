"""Keys of a calibration file and units of the fitted parameters of a servo."""

from __future__ import annotations

_KEYS = {
    "velocity_gain_hz": ("velocity_gain", "s^-1"),
    "position_gain_hz2": ("position_gain", "s^-2"),
    "delay_s": ("delay", "s"),
    "viscous_hz": ("viscous_friction", "s^-1"),
    "coulomb_rad_s2": ("coulomb_friction", "rad/s^2"),
}


def parameter_key(name: str, unit_of_joint: str = "rad") -> tuple[str, str]:
    """Key of a calibration file and unit of a parameter.

    Args:
        name: Name of the parameter, such as ``coulomb_rad_s2``.
        unit_of_joint: ``rad`` or, for a sliding joint, ``m``.
    """
    key, unit = _KEYS[name]
    return key, unit.replace("rad", unit_of_joint)
