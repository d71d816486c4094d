"""Grippers of two parallel fingers, whose mounting determines the range of widths."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import Document, DocumentModel, Identifier, Metres
from rgss.findings import Finding
from rgss.scenes.document import AssumptionEntry, BaseEntry, CommandEntry, FingerEntry, FirmGraspEntry
from rgss.scenes.findings import Location, negative
from rgss.scenes.gripper import GripperFile, GripperGeometry
from rgss.scenes.hands.finger_entries import body_findings, drive_of, grasp_depth_findings, settings_of
from rgss.scenes.shapes import Box, Cylinder


class MountingEntry(DocumentModel):
    """Distances between the two pads, closed and open."""

    closed: Metres
    open: Metres


class ParallelGripperDocument(DocumentModel):
    """Gripper file of two parallel fingers."""

    gripper: Identifier
    kind: Literal["parallel"]
    base: BaseEntry
    finger: FingerEntry
    mountings: Annotated[dict[Identifier, MountingEntry], Field(min_length=1)]
    mounting: Identifier | None = None
    grasp_depth: Metres
    firm_grasp: FirmGraspEntry | None = None
    command: CommandEntry | None = None
    assumptions: tuple[AssumptionEntry, ...] = ()


class ParallelGripper:
    """The kind ``parallel``."""

    name = "parallel"
    model: type[DocumentModel] = ParallelGripperDocument
    document = "parallel-gripper"
    title = "Parallel gripper"
    own_key = "mountings"

    def findings(self, entry: ParallelGripperDocument, document: Document) -> Iterable[Finding]:
        """Findings about sizes, mountings without travel, and a default that is not a mounting."""
        others: list[tuple[Location, float]] = [(("grasp_depth",), entry.grasp_depth)]
        if entry.command is not None:
            others.append((("command", "travel_time"), entry.command.travel_time))
            yield from negative(document, [(("command", "unpowered_force"), entry.command.unpowered_force)])
            travels = {round(one.open - one.closed, 9) for one in entry.mountings.values()}
            if len(travels) > 1:
                yield document.finding(
                    "scene.command",
                    "the mountings of a gripper with a command must have the same travel",
                    ("mountings",),
                    hint="write a file for each mounting",
                )
            if entry.finger.speed is not None:
                yield document.finding(
                    "scene.command",
                    "the speed of the fingers follows from the mounting's travel and the command's travel_time",
                    ("finger", "speed"),
                    hint="remove 'speed', or 'command'",
                )
        yield from body_findings(entry.base, entry.finger, entry.firm_grasp, document, others)
        widths = ((("mountings", name, "closed"), one.closed) for name, one in entry.mountings.items())
        yield from negative(document, widths)
        for name, one in entry.mountings.items():
            if one.open <= one.closed:
                yield document.finding(
                    "scene.mounting",
                    f"mounting {name!r} opens to {one.open * 1e3:g} mm and closes to {one.closed * 1e3:g} mm",
                    ("mountings", name, "open"),
                    hint=f"make it more than {one.closed * 1e3:g} mm",
                )
        if entry.mounting is None and len(entry.mountings) > 1:
            yield document.finding(
                "scene.mounting",
                "a gripper with several mountings must name its default mounting",
                ("mountings",),
                hint=f"add 'mounting:' with one of {', '.join(entry.mountings)}",
            )
        elif entry.mounting is not None and entry.mounting not in entry.mountings:
            yield document.finding(
                "scene.mounting",
                f"there is no mounting {entry.mounting!r}",
                ("mounting",),
                hint=f"mountings: {', '.join(entry.mountings)}",
            )
        yield from grasp_depth_findings(entry.grasp_depth, entry.base, entry.finger, document)

    def gripper_file(self, entry: ParallelGripperDocument) -> GripperFile:
        """Gripper with each of its mountings."""
        mountings = {name: _geometry(entry, name, one) for name, one in entry.mountings.items()}
        mounting = entry.mounting or next(iter(mountings))
        settings = {**settings_of(entry.base, entry.finger), "gripper.mounting": mounting}
        drive = drive_of(entry.finger, entry.firm_grasp)
        if entry.command is not None:
            # The fingers of each mounting cover their own travel in the duration of the command.
            drive = replace(
                drive,
                command_s=entry.command.travel_time,
                unpowered_force_n=entry.command.unpowered_force,
            )
            settings["gripper.finger.speed"] = mountings[mounting].stroke_m / entry.command.travel_time
        return GripperFile(mountings=mountings, mounting=mounting, drive=drive, settings=settings)


def _geometry(entry: ParallelGripperDocument, name: str, mounting: MountingEntry) -> GripperGeometry:
    return GripperGeometry(
        id=entry.gripper,
        azimuths_rad=(0.0, math.pi),
        base=Cylinder(radius_m=entry.base.radius, height_m=entry.base.height),
        finger=Box(size_m=(entry.finger.thickness, entry.finger.width, entry.finger.length)),
        largest_opening_m=mounting.open / 2,
        stroke_m=(mounting.open - mounting.closed) / 2,
        grasp_depth_m=entry.grasp_depth,
        mounting=name,
    )
