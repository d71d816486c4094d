"""Kinds of motion that a move of the task can be."""

from __future__ import annotations

from enum import Enum


class MoveKind(str, Enum):
    """Kind of motion of a move."""

    PLANNED = "planned"
    """A path that the planner finds."""
    STRAIGHT = "straight"
    """A straight line of the tool, which turns evenly, in one branch of the inverse kinematics."""
    JOINT = "joint"
    """A straight line in joint space."""
