"""Grippers of prismatic fingers at any azimuths, which close by the same stroke towards the axis."""

from __future__ import annotations

from collections.abc import Iterable

from rgss.documents import Document, DocumentModel
from rgss.findings import Finding
from rgss.scenes.document import GripperDocument
from rgss.scenes.gripper import GripperFile, GripperGeometry
from rgss.scenes.hands.finger_entries import body_findings, drive_of, grasp_depth_findings, settings_of
from rgss.scenes.shapes import Box, Cylinder


class FingerGripper:
    """The kind ``fingers``."""

    name = "fingers"
    model: type[DocumentModel] = GripperDocument
    document = "gripper"
    title = "Gripper"
    own_key = "azimuths"

    def findings(self, entry: GripperDocument, document: Document) -> Iterable[Finding]:
        """Findings about sizes, and about a stroke at which fingers would cross."""
        others = [(("stroke",), entry.stroke), (("grasp_depth",), entry.grasp_depth)]
        yield from body_findings(entry.base, entry.finger, entry.firm_grasp, document, others)
        if entry.stroke >= entry.largest_opening:
            yield document.finding(
                "scene.stroke",
                "the stroke is not shorter than the largest opening, so the fingers would cross",
                ("stroke",),
                hint=f"make it less than {entry.largest_opening} m",
            )
        yield from grasp_depth_findings(entry.grasp_depth, entry.base, entry.finger, document)

    def gripper_file(self, entry: GripperDocument) -> GripperFile:
        """Gripper with its only mounting."""
        geometry = GripperGeometry(
            id=entry.gripper,
            azimuths_rad=entry.azimuths,
            base=Cylinder(radius_m=entry.base.radius, height_m=entry.base.height),
            finger=Box(size_m=(entry.finger.thickness, entry.finger.width, entry.finger.length)),
            largest_opening_m=entry.largest_opening,
            stroke_m=entry.stroke,
            grasp_depth_m=entry.grasp_depth,
        )
        name = entry.mounting or ""
        return GripperFile(
            mountings={name: geometry},
            mounting=name,
            drive=drive_of(entry.finger, entry.firm_grasp),
            settings=settings_of(entry.base, entry.finger),
        )
