"""Reading gripper files."""

from __future__ import annotations

from pathlib import Path

from rgss.documents import load_document
from rgss.errors import DocumentError
from rgss.scenes.document import GripperDocument
from rgss.scenes.findings import Location, not_positive, too_slow
from rgss.scenes.gripper import GripperFile, GripperGeometry
from rgss.scenes.shapes import Box, Cylinder


def load_gripper(path: Path, *, label: str | None = None) -> GripperGeometry:
    """Read a gripper's shape.

    Args:
        path: The gripper file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is wrong; with every problem in it.
    """
    return load_gripper_file(path, label=label).geometry


def load_gripper_file(path: Path, *, label: str | None = None) -> GripperFile:
    """Read a gripper's shape, and what it has where no design sets it.

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
    own: dict[Location, float | None] = {
        ("base", "mass"): entry.base.mass,
        ("finger", "mass"): entry.finger.mass,
        ("finger", "speed"): entry.finger.speed,
        ("finger", "force"): entry.finger.force,
        ("finger", "friction"): entry.finger.friction,
    }
    given = {location: value for location, value in own.items() if value is not None}
    findings = list(not_positive(document, [*lengths, *given.items()]))
    findings.extend(too_slow(document, (item for item in given.items() if item[0] == ("finger", "speed"))))
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
    geometry = GripperGeometry(
        id=entry.gripper,
        azimuths_rad=entry.azimuths,
        base=Cylinder(radius_m=entry.base.radius, height_m=entry.base.height),
        finger=Box(size_m=(entry.finger.thickness, entry.finger.width, entry.finger.length)),
        largest_opening_m=entry.largest_opening,
        stroke_m=entry.stroke,
        grasp_depth_m=entry.grasp_depth,
    )
    settings = {".".join(("gripper", *map(str, location))): value for location, value in given.items()}
    return GripperFile(geometry=geometry, settings=settings)
