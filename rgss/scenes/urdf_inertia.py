"""Masses and inertias that links of a URDF state."""

from __future__ import annotations

import xml.etree.ElementTree as ET

MOMENTS = ("ixx", "iyy", "izz")


def has_inertia(link: ET.Element) -> bool:
    """Whether a link states a mass above zero, and an inertia.

    Args:
        link: The link.
    """
    mass = link.find("inertial/mass")
    return mass is not None and not _is_zero(mass.get("value", "0")) and link.find("inertial/inertia") is not None


def has_moments(link: ET.Element) -> bool:
    """Whether a link states a moment of inertia that is not zero.

    Args:
        link: The link.
    """
    inertia = link.find("inertial/inertia")
    return inertia is not None and not all(_is_zero(inertia.get(name, "0")) for name in MOMENTS)


def _is_zero(text: str) -> bool:
    """Whether a text is a number that is zero; what is no number is reported elsewhere."""
    try:
        return float(text or "0") == 0.0
    except ValueError:
        return False
