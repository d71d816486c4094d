"""Kinds of motion of the task's moves."""

from __future__ import annotations

from enum import Enum


class MoveKind(str, Enum):
    """Kind of motion of a move."""

    PLANNED = "planned"
    """Path found by the planner."""
    STRAIGHT = "straight"
    """Straight line of the tool at constant turning rate, in one branch of the inverse kinematics."""
    JOINT = "joint"
    """Straight line in joint space."""
