"""Kinds of joints of an arm."""

from __future__ import annotations

from enum import Enum


class JointKind(str, Enum):
    """Motion of a joint."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
