"""Findings about joint values of a robot file: units that do not match the joint, and home positions out of range."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from rgss.counted import counted
from rgss.documents import Document, JointQuantity
from rgss.findings import Finding
from rgss.scenes.document import RobotDocument
from rgss.scenes.findings import Location
from rgss.scenes.joints import JointKind


def unit_findings(entry: RobotDocument, document: Document, kinds: Mapping[str, JointKind | None]) -> Iterable[Finding]:
    """A finding for each value with the unit of the other kind of joint.

    Args:
        entry: The robot file's content.
        document: The robot file, for positions.
        kinds: Kind of each joint of the URDF by its name.
    """
    for name, location, quantity, examples in _quantities(entry):
        kind = kinds.get(name)
        if kind is None or quantity.is_linear == (kind is JointKind.PRISMATIC):
            continue
        yield document.finding(
            "scene.joint-unit",
            f"joint {name!r} is {kind.value} in the URDF, and its {location[0] if len(location) < 3 else location[2]} "
            f"must be {'linear' if kind is JointKind.PRISMATIC else 'angular'}",
            location,
            hint=f"write {examples[kind is JointKind.PRISMATIC]}, for one",
        )


def home_findings(entry: RobotDocument, document: Document) -> Iterable[Finding]:
    """A finding for each home position out of range, or for a wrong number of home positions.

    Args:
        entry: The robot file's content.
        document: The robot file, for positions.
    """
    if len(entry.home) != len(entry.joints):
        yield document.finding(
            "scene.home",
            f"home has {counted(len(entry.home), 'position')}, and the arm {counted(len(entry.joints), 'joint')}",
            ("home",),
            hint="give a position for each joint, from the base to the flange",
        )
        return
    for index, (joint, home) in enumerate(zip(entry.joints, entry.home, strict=True)):
        lower, upper = joint.range
        if lower.value >= upper.value or lower.value <= home.value <= upper.value:
            continue
        below = home.value < lower.value
        side, limit = ("below its lower", lower) if below else ("above its upper", upper)
        yield document.finding(
            "scene.home",
            f"home of joint {joint.name!r} is {_shown(home)}, {side} limit of {_shown(limit)}",
            ("home", index),
            hint=f"give a position from {_shown(lower)} to {_shown(upper)}",
        )


def _quantities(entry: RobotDocument) -> Iterator[tuple[str, Location, JointQuantity, tuple[str, str]]]:
    """Joint, location, value, and an angular and a linear example, of all joint quantities."""
    positions = ("90 deg", "120 mm")
    for index, joint in enumerate(entry.joints):
        for end, quantity in enumerate(joint.range):
            yield joint.name, ("joints", index, "range", end), quantity, positions
        yield joint.name, ("joints", index, "speed"), joint.speed, ("90 deg/s", "0.5 m/s")
        yield joint.name, ("joints", index, "acceleration"), joint.acceleration, ("3 rad/s^2", "2 m/s^2")
        yield joint.name, ("joints", index, "torque"), joint.torque, ("50 N*m", "200 N")
    for index, (joint, quantity) in enumerate(zip(entry.joints, entry.home, strict=False)):
        yield joint.name, ("home", index), quantity, positions
    for name, quantity in entry.frozen.items():
        yield name, ("frozen", name), quantity, positions


def _shown(quantity: JointQuantity) -> str:
    if quantity.is_linear:
        return f"{quantity.value * 1e3:.6g} mm"
    return f"{math.degrees(quantity.value):.6g} deg"
