"""Registry of the kinds of grippers."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from rgss.documents import Document
from rgss.errors import DocumentError
from rgss.findings import shown
from rgss.scenes.hands.finger_gripper import FingerGripper
from rgss.scenes.hands.gripper_kind import GripperKind
from rgss.scenes.hands.linkage_gripper import LinkageGripper
from rgss.scenes.hands.parallel_gripper import ParallelGripper
from rgss.scenes.hands.vacuum_gripper import VacuumGripper

_FINGERS = FingerGripper()

GRIPPER_KINDS: Mapping[str, GripperKind | LinkageGripper] = MappingProxyType(
    {kind.name: kind for kind in (_FINGERS, ParallelGripper(), VacuumGripper(), LinkageGripper())}
)
"""The kinds of grippers by name in files."""


def kind_of_gripper(document: Document) -> GripperKind | LinkageGripper:
    """Kind of a gripper file; prismatic fingers by default.

    Raises:
        DocumentError: The file names an unknown kind.
    """
    data: Any = document.data
    name = data.get("kind", _FINGERS.name) if isinstance(data, dict) else _FINGERS.name
    if isinstance(name, str) and name in GRIPPER_KINDS:
        return GRIPPER_KINDS[name]
    hint = f"known kinds: {', '.join(GRIPPER_KINDS)}"
    message = f"unknown kind of gripper {shown(str(name))}"
    raise DocumentError([document.finding("scene.gripper-kind", message, ("kind",), hint=hint)])
