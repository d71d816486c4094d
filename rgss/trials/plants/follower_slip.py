"""Detail of a failure by a follower whose coupling gives way."""

from __future__ import annotations

from rgss.scenes import JointKind, Robot


def slip_detail(robot: Robot, name: str) -> str:
    """Detail of the failure, with the driven joint and the effort of the coupling."""
    one = next(one for one in robot.followers if one.name == name)
    unit = "N" if one.kind is JointKind.PRISMATIC else "N·m"
    driver = robot.joints[one.driver].name
    return f"{name} slipped on {driver}, whose coupling transmits {one.effort:g} {unit} at most"
