"""Common parts of the files of grippers with fingers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.document import BaseEntry, FingerEntry, FirmGraspEntry
from rgss.scenes.findings import Location, not_positive, too_slow
from rgss.scenes.gripper import GripperDrive


def body_findings(
    base: BaseEntry,
    finger: FingerEntry,
    firm_grasp: FirmGraspEntry | None,
    document: Document,
    others: Iterable[tuple[Location, float]],
) -> Iterable[Finding]:
    """Findings for sizes, masses, speeds and forces that are not positive, and for a drive that is too heavy.

    Args:
        base: The base.
        finger: A finger.
        firm_grasp: The condition of a firm grasp.
        document: The file, for positions.
        others: Other values that must be positive.
    """
    lengths: list[tuple[Location, float]] = [
        (("base", "radius"), base.radius),
        (("base", "height"), base.height),
        (("finger", "thickness"), finger.thickness),
        (("finger", "width"), finger.width),
        (("finger", "length"), finger.length),
        *others,
    ]
    given = _given(base, finger)
    optional: list[tuple[Location, float]] = [*given.items()]
    if finger.drive_inertia is not None:
        optional.append((("finger", "drive_inertia"), finger.drive_inertia))
    if firm_grasp is not None:
        optional.append((("firm_grasp", "finger_force"), firm_grasp.finger_force))
    yield from not_positive(document, [*lengths, *optional])
    yield from too_slow(document, (item for item in given.items() if item[0] == ("finger", "speed")))


def drive_of(finger: FingerEntry, firm_grasp: FirmGraspEntry | None) -> GripperDrive:
    """Drive of the fingers from a file."""
    return GripperDrive(
        inertia_kg=finger.drive_inertia or 0.0, firm_force_n=None if firm_grasp is None else firm_grasp.finger_force
    )


def settings_of(base: BaseEntry, finger: FingerEntry) -> dict[str, float | str]:
    """Values in SI, by quantity, that apply if no design sets them."""
    given = _given(base, finger)
    return {".".join(("gripper", *map(str, location))): value for location, value in given.items()}


def grasp_depth_findings(depth_m: float, base: BaseEntry, finger: FingerEntry, document: Document) -> Iterable[Finding]:
    """A finding for a grasp centre outside the fingers.

    Args:
        depth_m: Distance of the grasp centre from the flange.
        base: The base.
        finger: A finger.
        document: The file, for positions.
    """
    reach_m = base.height + finger.length
    if not base.height < depth_m < reach_m:
        yield document.finding(
            "scene.grasp-depth",
            "the grasp centre lies outside the fingers",
            ("grasp_depth",),
            hint=f"give a depth between {base.height} m and {reach_m:.4g} m",
        )


def _given(base: BaseEntry, finger: FingerEntry) -> Mapping[Location, float]:
    own: dict[Location, float | None] = {
        ("base", "mass"): base.mass,
        ("finger", "mass"): finger.mass,
        ("finger", "speed"): finger.speed,
        ("finger", "force"): finger.force,
        ("finger", "friction"): finger.friction,
    }
    return {location: value for location, value in own.items() if value is not None}
