"""Findings about the mesh of an object: its size, its surface, and the volume of its simulated shapes."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

from rgss.documents import Document, load_document
from rgss.findings import Finding, Severity
from rgss.scenes.document import CollisionShapes, SceneDocument, WorkpieceEntry
from rgss.scenes.findings import Location
from rgss.scenes.mesh_shapes import MeshSummary, mesh_mass, mesh_summary, shapes_of_mesh, shapes_volume_m3

_LARGEST_M, _SMALLEST_M = 3.0, 1.0e-3
_CONVEX = 1.02
_CLEARLY_MORE = 1.2
_DIVIDING = "write 'collision: decompose' (package coacd)"
_HINTS = {
    CollisionShapes.HULL: _DIVIDING,
    CollisionShapes.BOXES: f"{_DIVIDING}, or give the mesh a body for each box",
    CollisionShapes.DECOMPOSE: "give the mesh a convex body for each part",
}


def mesh_findings(
    entry: WorkpieceEntry, summary: MeshSummary, document: Document, location: Location
) -> Iterator[Finding]:
    """Errors of a mesh that cannot be simulated as it is described.

    Args:
        entry: The object.
        summary: Properties of its mesh.
        document: The scene's document.
        location: Location of the mesh.
    """
    size = max(summary.extent_m)
    if not _SMALLEST_M <= size <= _LARGEST_M:
        hint = "give 'scale: 0.001' for a mesh in millimetres" if size > _LARGEST_M else "give a greater 'scale'"
        yield document.finding(
            "scene.mesh-units", f"the mesh is {size:.3g} m long; lengths are in m", location, hint=hint
        )
    is_stated = entry.centre_of_mass is not None and entry.inertia is not None and entry.mass is not None
    if not summary.is_closed and not is_stated:
        yield document.finding(
            "scene.mesh-open",
            "the mesh must be closed for mass properties",
            location,
            hint="close it, or give mass, centre_of_mass and inertia",
        )
    if summary.is_closed and summary.hull_ratio > _CONVEX and entry.collision is None:
        yield document.finding(
            "scene.mesh-concave",
            f"the mesh is concave: its hull has {summary.hull_ratio:.2f} times its volume",
            location,
            hint="write 'collision: decompose' (package coacd), or 'hull' for the hull",
        )


def mesh_volume_findings(path: Path, *, label: str) -> Iterator[Finding]:
    """Warnings of shapes with clearly more volume than their mesh: an object can rest on, and be held by, nothing.

    Args:
        path: A scene file, which is valid.
        label: Its name in messages.

    Raises:
        DocumentError: The file is invalid.
    """
    loaded = load_document(path, SceneDocument, label=label)
    own: Location = ("workpiece",)
    entries = [(own, loaded.value.workpiece)]
    entries += [(("workpieces", index), one) for index, one in enumerate(loaded.value.workpieces)]
    for at, entry in entries:
        if entry.mesh is None:
            continue
        file, scale = path.parent / entry.mesh, (entry.scale,) * 3
        if not mesh_summary(file, scale=scale).is_closed:
            continue
        how = entry.collision or CollisionShapes.HULL
        sha256 = hashlib.sha256(file.read_bytes()).hexdigest()
        parts = shapes_of_mesh(file, sha256=sha256, scale=scale, how=how)
        ratio = shapes_volume_m3(parts) / mesh_mass(file, scale=entry.scale).volume_m3
        if ratio <= _CLEARLY_MORE:
            continue
        shapes = f"{len(parts)} convex shapes" if len(parts) > 1 else "one convex shape"
        yield loaded.document.finding(
            "scene.mesh-volume",
            f"'collision: {how.value}' simulates {entry.id} as {shapes} with {ratio:.2f} times the volume of its mesh: "
            "it can rest and be held where the mesh is empty",
            (*at, "mesh"),
            severity=Severity.WARNING,
            hint=_HINTS[how],
        )
