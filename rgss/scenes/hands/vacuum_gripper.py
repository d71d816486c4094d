"""Vacuum grippers: one suction cup on the tool axis."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Literal

from rgss.documents import Dimensionless, Document, DocumentModel, Identifier, Metres, Newtons, Radians, Seconds
from rgss.findings import Finding, Severity
from rgss.scenes.document import AssumptionEntry, BaseEntry
from rgss.scenes.findings import Location, negative, not_positive
from rgss.scenes.gripper import GripperDrive, GripperFile, GripperGeometry, Suction
from rgss.scenes.shapes import Box, Cylinder, ObjectShape

_NO_FINGER = Box(size_m=(0.0, 0.0, 0.0))
_LEAST_SPEED_M_S = 1.0
_APPROACH_SHARE = 0.5
_ATMOSPHERE_PA = 101_325.0


class CupEntry(DocumentModel):
    """A suction cup: size, sealing conditions and holding force."""

    radius: Metres
    length: Metres
    normal_force: Newtons
    tangential_force: Newtons
    largest_gap: Metres
    largest_angle: Radians
    leak: Dimensionless = 0.0
    build_up: Seconds
    release: Seconds


class VacuumGripperDocument(DocumentModel):
    """Gripper file of one suction cup."""

    gripper: Identifier
    kind: Literal["vacuum"]
    base: BaseEntry
    cup: CupEntry
    mounting: Identifier | None = None
    assumptions: tuple[AssumptionEntry, ...] = ()


class VacuumGripper:
    """The kind ``vacuum``."""

    name = "vacuum"
    model: type[DocumentModel] = VacuumGripperDocument
    document = "vacuum-gripper"
    title = "Vacuum gripper"
    own_key = "cup"

    def findings(self, entry: VacuumGripperDocument, document: Document) -> Iterable[Finding]:
        """Findings about sizes, forces and times, a leak that leaves no force, and a cup that cannot be."""
        cup, base = entry.cup, entry.base
        names = ("radius", "length", "normal_force", "tangential_force", "largest_gap", "largest_angle")
        values: list[tuple[Location, float]] = [
            (("base", "radius"), base.radius),
            (("base", "height"), base.height),
            *((("cup", name), getattr(cup, name)) for name in (*names, "build_up", "release")),
        ]
        if base.mass is not None:
            values.append((("base", "mass"), base.mass))
        yield from not_positive(document, values)
        yield from negative(document, [(("cup", "leak"), cup.leak)])
        if cup.leak >= 1.0:
            yield document.finding(
                "scene.leak",
                f"a leak of {cup.leak * 100:g} % leaves no force",
                ("cup", "leak"),
                hint="make it less than 100 %",
            )
        if cup.largest_angle >= math.pi / 2:
            yield document.finding(
                "scene.cup",
                f"a cup does not seal at an angle of {math.degrees(cup.largest_angle):g} deg",
                ("cup", "largest_angle"),
                hint="make it less than 90 deg, such as 5 deg",
            )
        if cup.largest_gap >= cup.length > 0.0:
            yield document.finding(
                "scene.cup",
                f"a largest gap of {cup.largest_gap * 1e3:g} mm is not shorter than the cup, {cup.length * 1e3:g} mm",
                ("cup", "largest_gap"),
                hint="give the distance that the lip of the cup bridges, some millimetres",
            )
        greatest_n = _ATMOSPHERE_PA * math.pi * cup.radius**2
        if cup.normal_force > greatest_n > 0.0:
            yield document.finding(
                "scene.cup",
                f"a normal force of {cup.normal_force:g} N exceeds that of the whole air pressure on a lip of "
                f"{cup.radius * 1e3:g} mm, {greatest_n:.3g} N",
                ("cup", "normal_force"),
                hint="take the force from the cup's data sheet, or its outer radius",
                severity=Severity.WARNING,
            )

    def gripper_file(self, entry: VacuumGripperDocument) -> GripperFile:
        """Gripper with one cup; placeholders with the least admissible values replace the missing fingers."""
        cup = entry.cup
        base = Cylinder(radius_m=entry.base.radius, height_m=entry.base.height)
        geometry = GripperGeometry(
            id=entry.gripper,
            azimuths_rad=(),
            base=base,
            finger=_NO_FINGER,
            largest_opening_m=0.0,
            stroke_m=0.0,
            grasp_depth_m=base.height_m + cup.length + _APPROACH_SHARE * cup.largest_gap,
            cup=Cylinder(radius_m=cup.radius, height_m=cup.length),
        )
        suction = Suction(
            tangential_force_n=cup.tangential_force,
            leak=cup.leak,
            largest_gap_m=cup.largest_gap,
            largest_angle_rad=cup.largest_angle,
            build_up_s=cup.build_up,
            release_s=cup.release,
        )
        settings: dict[str, float | str] = {
            "gripper.finger.mass": 0.0,
            "gripper.finger.speed": _LEAST_SPEED_M_S,
            "gripper.finger.force": cup.normal_force,
            "gripper.finger.friction": 1.0,
        }
        if entry.base.mass is not None:
            settings["gripper.base.mass"] = entry.base.mass
        name = entry.mounting or ""
        return GripperFile(
            mountings={name: geometry}, mounting=name, drive=GripperDrive(), suction=suction, settings=settings
        )


def at_top(geometry: GripperGeometry, shape: ObjectShape) -> GripperGeometry:
    """Gripper with its grasp centre at the centre of the object below its cup; a gripper with fingers unchanged.

    The task's grasp is at the centre of the object, a cup's on its top.

    Args:
        geometry: The gripper's shape; the grasp centre of a cup is a gap below its lip.
        shape: The object.
    """
    if geometry.cup is None:
        return geometry
    return replace(geometry, grasp_depth_m=geometry.grasp_depth_m + shape.half_height_m)
