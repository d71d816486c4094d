"""The task that a scene names, for the studies that name none."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from rgss.documents import FilePlace, place_of, read_document
from rgss.errors import DocumentError
from rgss.findings import Finding, shown


def task_of_scene(project: Path, scene: str, findings: list[Finding]) -> str | None:
    """Name of the task file of a scene, relative to the project.

    Args:
        project: The project's folder.
        scene: Name of the scene file, relative to it.
        findings: Collects the problems.

    Returns:
        None for a scene that names no task, or that cannot be read, which has its own findings.
    """
    try:
        document = read_document(project / scene, label=scene)
    except DocumentError:
        return None
    task = document.data.get("task") if isinstance(document.data, dict) else None
    steps = task.get("steps") if isinstance(task, dict) else None
    if not isinstance(steps, str):
        return None
    path = PurePosixPath(steps)
    place = place_of((project / scene).parent / steps, project)
    if path.is_absolute() or ".." in path.parts or place is FilePlace.OUTSIDE:
        message, hint = f"{shown(steps)} lies outside the scene's folder", "name a file in it"
    elif place is FilePlace.MISSING:
        message, hint = f"there is no file {shown(steps)}", "file names are relative to the scene"
    else:
        return (PurePosixPath(scene).parent / path).as_posix()
    findings.append(document.finding("scene.task", message, ("task", "steps"), hint=hint))
    return None
