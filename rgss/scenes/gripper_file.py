"""Reading a gripper's shape."""

from __future__ import annotations

from pathlib import Path

from rgss.documents import load_document
from rgss.errors import DocumentError
from rgss.scenes.document import GripperDocument
from rgss.scenes.findings import Location, not_positive
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.shapes import Box, Cylinder


def load_gripper(path: Path, *, label: str | None = None) -> GripperGeometry:
    """Read a gripper's shape.

    Args:
        path: The gripper file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is wrong; with every problem in it.
    """
    loaded = load_document(path, GripperDocument, label=label)
    entry, document = loaded.value, loaded.document
    lengths: list[tuple[Location, float]] = [
        (("base", "radius"), entry.base.radius),
        (("base", "height"), entry.base.height),
        (("finger", "thickness"), entry.finger.thickness),
        (("finger", "width"), entry.finger.width),
        (("finger", "length"), entry.finger.length),
        (("stroke",), entry.stroke),
        (("grasp_depth",), entry.grasp_depth),
    ]
    findings = list(not_positive(document, lengths))
    if entry.stroke >= entry.largest_opening:
        findings.append(
            document.finding(
                "scene.stroke",
                "the stroke is not shorter than the largest opening, so the fingers would cross",
                ("stroke",),
                hint=f"make it less than {entry.largest_opening} m",
            )
        )
    reach = entry.base.height + entry.finger.length
    if not entry.base.height < entry.grasp_depth < reach:
        findings.append(
            document.finding(
                "scene.grasp-depth",
                "the grasp centre lies outside the fingers",
                ("grasp_depth",),
                hint=f"give a depth between {entry.base.height} m and {reach:.4g} m",
            )
        )
    if findings:
        raise DocumentError(sorted(findings))
    return GripperGeometry(
        id=entry.gripper,
        azimuths_rad=entry.azimuths,
        base=Cylinder(radius_m=entry.base.radius, height_m=entry.base.height),
        finger=Box(size_m=(entry.finger.thickness, entry.finger.width, entry.finger.length)),
        largest_opening_m=entry.largest_opening,
        stroke_m=entry.stroke,
        grasp_depth_m=entry.grasp_depth,
    )
