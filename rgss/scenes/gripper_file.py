"""Reader of gripper files."""

from __future__ import annotations

from pathlib import Path

from rgss.documents import load_document, read_document
from rgss.errors import DocumentError
from rgss.scenes.gripper import GripperFile, GripperGeometry
from rgss.scenes.hands import LinkageGripper, kind_of_gripper


def load_gripper(path: Path, *, label: str | None = None) -> GripperGeometry:
    """Read a gripper's shape, in its default mounting.

    Args:
        path: The gripper file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is invalid; with every problem in it.
    """
    return load_gripper_file(path, label=label).geometry


def load_gripper_file(path: Path, *, label: str | None = None, project: Path | None = None) -> GripperFile:
    """Read a gripper of any kind, with the values that apply if no design sets them.

    Args:
        path: The gripper file.
        label: The file's name in messages; the path by default.
        project: The folder that must contain all referenced files; that of the gripper file by default.

    Raises:
        DocumentError: The file is invalid; with every problem in it.
    """
    kind = kind_of_gripper(read_document(path, label=label))
    if isinstance(kind, LinkageGripper):
        described = load_document(path, kind.model, label=label)
        folder = path.parent if project is None else project
        return kind.read(described.value, described.document, path=path, project=folder)
    loaded = load_document(path, kind.model, label=label)
    findings = list(kind.findings(loaded.value, loaded.document))
    if findings:
        raise DocumentError(sorted(findings))
    return kind.gripper_file(loaded.value)
