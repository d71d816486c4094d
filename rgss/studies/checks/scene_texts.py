"""Messages and hints of findings about a scene."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.trials import SceneProblem

OF_ONE_GRIPPER = "designs with this gripper fail there, and the others do not"
"""Hint of a finding that some grippers of the designs do not have."""

OF_ONE_ARM = "designs with this arm fail there, and those with another do not"
"""Hint of a finding that some arms of the designs do not have."""


def closing_texts(problem: SceneProblem, grippers: Sequence[str]) -> tuple[str, str]:
    """Message and hint of a link that meets an object before the pads do."""
    of = f" of {', '.join(grippers)}" if grippers else ""
    millimetres = f"{abs(problem.distance_m) * 1e3:.3g} mm"
    how = f"be {millimetres} in it" if problem.distance_m > 0.0 else f"come within {millimetres} of it"
    hint = "hold it nearer to the ends of the pads ('grasp_from_tip' of the gripper), or choose among candidates"
    message = f"while the hand{of} closes on {problem.first}, {problem.second} would {how}"
    return message, OF_ONE_GRIPPER if grippers else hint


def instability_texts(problem: SceneProblem) -> tuple[str, str]:
    """Message and hint of an object that cannot stand by itself."""
    foot = f"{'an' if problem.detail == 'edge' else 'a'} {problem.detail} of its shape"
    where = f"{problem.distance_m * 1e3:.3g} mm outside of it" if problem.distance_m > 1e-6 else "above it"
    hint = "turn the shape ('rests'), state its 'centre_of_mass', or let bodies beside it hold it"
    message = f"{problem.first} cannot stand by itself on {problem.second}: it touches it with {foot}, "
    return f"{message}and its centre of mass is {where}", hint


def remedy(problem: SceneProblem) -> str:
    """Hint for a waypoint that the arm does not serve."""
    from rgss.trials import Obstacle

    if problem.serves_turned:
        return "add 180 deg to 'grasp_yaw' and 'place_yaw': the hand so turned holds it alike and serves every waypoint"
    if problem.place_yaw_rad is not None:
        yaw = f"{math.degrees(problem.place_yaw_rad):.3g} deg"
        return f"state 'place_yaw: {yaw}': the hand, and the object with it, so turned, the arm serves every waypoint"
    turn = "turn the grasp or the place about the vertical"
    if problem.is_yaw_stated:
        turn = f"turn the tool about the vertical there ('{'place' if problem.is_at_place else 'grasp'}_yaw')"
    if problem.reason is not None and problem.reason.obstacle is Obstacle.ORIENTATION:
        return f"move it, {turn}, or change the task's heights"
    if problem.reason is None or problem.reason.obstacle is Obstacle.OUT_OF_REACH:
        return "move it nearer to the robot, or lower the task's heights"
    if problem.reason.is_slide:
        return "widen the joint's range in the robot's file, or move it or the robot's base by that much"
    if problem.reason.obstacle is Obstacle.JOINT_RANGE:
        return f"widen the joint's range in the robot's file, or {turn}"
    if problem.reason.obstacle is Obstacle.TILT:
        return "allow more tilt with 'largest_carry_tilt'"
    if problem.reason.obstacle is Obstacle.CLEARANCE:
        return "move one of them, or lower the study's clearance"
    return f"move one of them, or {turn}"


def no_grasp_texts(problem: SceneProblem, of: str, room: str) -> tuple[str, str]:
    """Message and hint on an object of which no candidate can be carried out.

    Args:
        problem: The problem.
        of: The hands that have it, in words; empty if all do.
        room: Text of `lack_of_room`.
    """
    message = f"no grasp candidate of {problem.first}{of} can be carried out: {problem.detail}"
    hint = "let the task try more approaches, turn or move the object, or take another gripper"
    if room:
        return f"{message}; {room}", "lower that clearance, or take a narrower object or a wider gripper"
    if problem.reason is None:
        return message, hint
    message += f"; the best one does not serve {problem.waypoint}: {problem.reason}"
    return message, f"{remedy(problem)}; or {hint}"
