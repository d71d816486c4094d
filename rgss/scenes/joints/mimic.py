"""The ``<mimic>`` elements of a URDF: multiplier and offset relative to the driven joint, and problems."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping

from rgss.scenes.findings import Location

Problem = tuple[str, Location, str]


def follows(name: str, joints: Mapping[str, ET.Element]) -> tuple[float, float]:
    """Multiplier and offset of a joint relative to the driven one, also through chains of ``<mimic>``.

    Args:
        name: The joint.
        joints: All joints by name, without cycles of ``<mimic>``.
    """
    mimic = joints[name].find("mimic")
    if mimic is None:
        return 1.0, 0.0
    multiplier, offset = follows(mimic.get("joint", ""), joints)
    own = float(mimic.get("multiplier", "1"))
    return own * multiplier, own * offset + float(mimic.get("offset", "0"))


def driver_of(name: str, joints: Mapping[str, ET.Element]) -> str:
    """Name of the joint without ``<mimic>`` at the end of a joint's chain of ``<mimic>``; its own if it has none.

    Args:
        name: The joint.
        joints: All joints by name, without cycles of ``<mimic>``.
    """
    mimic = joints[name].find("mimic")
    return name if mimic is None else driver_of(mimic.get("joint", ""), joints)


def mimic_problems(names: Iterable[str], joints: Mapping[str, ET.Element]) -> Iterable[Problem]:
    """Problems of joints that follow another one: message, location in the referring file, hint."""
    for name in names:
        mimic = joints[name].find("mimic")
        if mimic is None:
            continue
        followed = mimic.get("joint", "")
        if followed not in joints:
            hint = f"joints: {', '.join(joints)}"
            yield f"lets the joint {name!r} follow {followed!r}, which is not one of its joints", ("description",), hint
            continue
        if joints[followed].get("type") == "fixed":
            hint = "let it follow the driven joint"
            yield f"lets the joint {name!r} follow the fixed joint {followed!r}", ("description",), hint
        for key in ("multiplier", "offset"):
            if not is_number(mimic.get(key, "0")):
                message = f"has {key}={mimic.get(key)!r} in <mimic> of {name!r}"
                yield message, ("description",), "write a number"
        if is_number(mimic.get("multiplier", "1")) and float(mimic.get("multiplier", "1")) == 0.0:
            yield f"lets the joint {name!r} follow with a multiplier of 0", ("description",), "fix the joint instead"
        seen = {name}
        while followed in joints and followed not in seen:
            seen.add(followed)
            above = joints[followed].find("mimic")
            followed = "" if above is None else above.get("joint", "")
        if followed == name:
            yield f"lets the joint {name!r} follow itself", ("description",), "let it follow the driven joint"


def is_number(text: str) -> bool:
    """True if a text is a finite number."""
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False
