"""The robot file of a new project, from the limits of a URDF; what the URDF lacks is a stated assumption."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence

from rgss.scenes import JointKind
from rgss.studies.robot_project.reach import SAMPLES
from rgss.studies.robot_project.urdf import UrdfArm, UrdfJoint

_ACCELERATION_TIME_S = 0.4
_LARGEST_ACCELERATION = {JointKind.REVOLUTE: 5.0, JointKind.PRISMATIC: 3.0}
_SPEED = {JointKind.REVOLUTE: 1.5, JointKind.PRISMATIC: 0.5}
_EFFORT = {JointKind.REVOLUTE: 100.0, JointKind.PRISMATIC: 500.0}

_LEAST_PAYLOAD_KG, _MOST_PAYLOAD_KG = 0.01, 100.0

TOOL_ACCELERATION_M_S2 = 1.2


def robot_text(arm: UrdfArm, *, id_: str, urdf: str, home: Sequence[float], held_kg: float) -> str:
    """The text of a robot file.

    Args:
        arm: The arm.
        id_: The robot's id.
        urdf: The URDF's name beside the robot file.
        home: Joint positions in rad or m, shape (n,).
        held_kg: What the joints hold, 0 or infinite where that is no payload.
    """
    payload_kg, reason = _payload(held_kg)
    lines = [
        "# Limits of the arm, from its URDF. What the URDF does not say is an assumption below: replace it by the",
        "# manufacturer's figures. rgss robot describes the arm, and reports problems of its description.",
        f"robot: {id_}",
        f"description: {urdf}",
        f"flange: {arm.flange}",
        "joints:",
        *(_joint_line(joint) for joint in arm.joints),
        f"payload: {payload_kg:g} kg",
        f"tool_acceleration: {TOOL_ACCELERATION_M_S2:g} m/s^2",
        f"home: [{', '.join(_position(joint, value) for joint, value in zip(arm.joints, home, strict=True))}]",
    ]
    if arm.hands or arm.rods:
        lines.append(f"without: [{', '.join((*arm.hands, *arm.rods))}]")
    lines.append("assumptions:")
    for about, rationale in _assumptions(arm, reason):
        lines += [f"  - about: {about}", f"    rationale: {json.dumps(rationale, ensure_ascii=False)}"]
    return "\n".join(lines) + "\n"


def _payload(held_kg: float) -> tuple[float, str]:
    """Payload that is written down, and its rationale."""
    if held_kg <= 0.0:
        reason = "The joints' efforts hold no payload: replace it by the manufacturer's figure."
        return _LEAST_PAYLOAD_KG, reason
    if math.isinf(held_kg):
        return _MOST_PAYLOAD_KG, "No joint carries weight, so that the efforts do not limit it."
    return held_kg, f"What the joints' efforts hold in every one of {SAMPLES:,} configurations, rounded down."


def _assumptions(arm: UrdfArm, payload: str) -> Sequence[tuple[str, str]]:
    most = _LARGEST_ACCELERATION[JointKind.REVOLUTE]
    found = [
        (
            "joints.acceleration",
            f"A URDF has none; each joint reaches its speed in {_ACCELERATION_TIME_S:g} s, {most:g} rad/s^2 at most.",
        ),
        ("payload", payload),
        ("tool_acceleration", "That of a common collaborative arm."),
        ("home", "A configuration above the object's place, free of collisions."),
    ]
    slow = [joint.name for joint in arm.joints if joint.speed <= 0.0]
    weak = [joint.name for joint in arm.joints if joint.effort <= 0.0]
    unbounded = [joint.name for joint in arm.joints if joint.is_unbounded]
    narrowed = [joint.name for joint in arm.joints if joint.whole not in (None, (joint.lower, joint.upper))]
    if narrowed:
        turn = "the turn about the task's configurations, so that planners search no others"
        found.append(("joints.range", f"Of {', '.join(narrowed)}, which turn further, {turn}."))
    if unbounded:
        found.append(("joints.range", f"The URDF has no range of {', '.join(unbounded)}: half a turn either way."))
    if slow:
        found.append(("joints.speed", f"The URDF has no speed of {', '.join(slow)}."))
    if weak:
        found.append(("joints.torque", f"The URDF has no effort of {', '.join(weak)}."))
    if arm.hands:
        found.append(("without", "The hand of the URDF is left out; the design's gripper takes its place."))
    if arm.rods:
        rationale = (
            "What moves with the arm's joints beside it, as the rods of a parallelogram do, is left out: "
            f"{', '.join(arm.rods)}. Neither its masses nor collisions with it are simulated."
        )
        found.append(("without", rationale))
    return [*found, *((note.about, note.rationale) for note in arm.notes)]


def _joint_line(joint: UrdfJoint) -> str:
    slides = joint.kind is JointKind.PRISMATIC
    speed = joint.speed if joint.speed > 0.0 else _SPEED[joint.kind]
    effort = joint.effort if joint.effort > 0.0 else _EFFORT[joint.kind]
    acceleration = min(speed / _ACCELERATION_TIME_S, _LARGEST_ACCELERATION[joint.kind])
    position, force = ("m", "N") if slides else ("rad", "N*m")
    return (
        f"  - {{name: {joint.name}, range: [{joint.lower!r} {position}, {joint.upper!r} {position}], "
        f"speed: {speed:g} {position}/s, acceleration: {acceleration:g} {position}/s^2, torque: {effort:g} {force}}}"
        + _whole_range(joint, position)
    )


def _whole_range(joint: UrdfJoint, unit: str) -> str:
    """Comment with the range of the URDF, to which that of the file may be widened for another task."""
    if joint.whole in (None, (joint.lower, joint.upper)):
        return ""
    lower, upper = (f"{value:.6g} {unit}" for value in joint.whole)
    return f" # of {lower} to {upper}"


def _position(joint: UrdfJoint, value: float) -> str:
    """A position in round numbers where they lie within the range."""
    slides = joint.kind is JointKind.PRISMATIC
    text = f"{value * 1e3:.1f}" if slides else f"{math.degrees(value):.2f}"
    rounded = float(text) / 1e3 if slides else math.radians(float(text))
    if joint.lower < rounded < joint.upper:
        return f"{text} {'mm' if slides else 'deg'}"
    return f"{value!r} {'m' if slides else 'rad'}"
