"""Further objects, and places without an object: their entries and findings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.document import PlaceRegionEntry, SceneDocument
from rgss.scenes.findings import Location
from rgss.scenes.objects.object_entry import object_lengths
from rgss.scenes.objects.object_file import ObjectSolid, object_solid, workpiece_of
from rgss.scenes.objects.supports import Supports
from rgss.scenes.scene import ColourRgba, NamedPlace, SceneObject

_GREY = "#9b958c"
_COLOURS = ("#d55e00", "#0072b2", "#009e73", "#e69f00", "#cc79a7", "#56b4e9", "#f0e442")


def other_solids(
    path: Path, entry: SceneDocument, document: Document, findings: list[Finding], project: Path
) -> tuple[ObjectSolid, ...]:
    """Solids of the further objects, without invalid ones, for which findings are added.

    Args:
        path: The scene's file.
        entry: The scene file.
        document: The file, for positions.
        findings: List to which findings are added.
        project: The folder that must contain all referenced files.
    """
    solids = (
        object_solid(path, one, document, findings, project, at=("workpieces", index))
        for index, one in enumerate(entry.workpieces)
    )
    return tuple(solid for solid in solids if solid is not None)


def other_objects(entry: SceneDocument, solids: Sequence[ObjectSolid], supports: Supports) -> tuple[SceneObject, ...]:
    """The further objects of a scene."""
    return tuple(
        SceneObject(
            workpiece=workpiece_of(one, solid, pose=supports.poses[one.id], colour=object_colour(one.colour, number)),
            support=one.stands_on,
            place=supports.region(one.place_region),
            place_support=one.place_region.stands_on,
        )
        for number, (one, solid) in enumerate(zip(entry.workpieces, solids, strict=True), start=1)
    )


def named_places(entry: SceneDocument, supports: Supports) -> tuple[NamedPlace, ...]:
    """The places without an object."""
    return tuple(NamedPlace(id=one.id, region=supports.region(one), support=one.stands_on) for one in entry.places)


def name_findings(entry: SceneDocument, document: Document) -> Iterator[Finding]:
    """Findings about duplicate names.

    Args:
        entry: The scene file.
        document: The file, for positions.
    """
    bodies = {body.id for body in entry.bodies}
    taken = bodies | {entry.workpiece.id}
    for index, one in enumerate(entry.workpieces):
        if one.id in taken:
            message = f"id {one.id!r} is taken by a body or another object"
            yield document.finding("scene.duplicate-id", message, ("workpieces", index, "id"))
        taken.add(one.id)
    known = set[str]()
    for index, place in enumerate(entry.places):
        if place.id in known:
            message = f"id {place.id!r} is taken by an earlier place"
            yield document.finding("scene.duplicate-id", message, ("places", index, "id"))
        known.add(place.id)


def positive_values(entry: SceneDocument) -> Iterator[tuple[Location, float]]:
    """Values of these entries that must be greater than zero, with their locations."""
    for index, one in enumerate(entry.workpieces):
        yield from object_lengths(one, at=("workpieces", index))
        for key in ("friction", "force_limit", "force_window", "landing_limit"):
            yield ("workpieces", index, key), getattr(one, key)
        yield from place_limits(one.place_region, at=("workpieces", index, "place_region"))
    for index, place in enumerate(entry.places):
        yield from place_limits(place, at=("places", index))


def place_limits(place: PlaceRegionEntry, *, at: Location) -> Iterator[tuple[Location, float]]:
    """Limits of a place region that must be greater than zero, with their locations."""
    for key in ("radius", "largest_tilt", "largest_drag", "largest_turn"):
        limit = getattr(place, key)
        if limit is not None:
            yield (*at, key), limit


def object_colour(text: str | None, number: int) -> ColourRgba:
    """Colour of an object; by default one of a palette for any colour vision (Okabe and Ito, 2008).

    Args:
        text: The text ``#rrggbb``; None if the file states none.
        number: Number of the object, the first is 0.
    """
    return colour_of(text or _COLOURS[number % len(_COLOURS)])


def colour_of(text: str | None) -> ColourRgba:
    """Colour from its text ``#rrggbb``; grey if there is none."""
    text = text or _GREY
    red, green, blue = (int(text[start : start + 2], 16) / 255 for start in (1, 3, 5))
    return (red, green, blue, 1.0)
