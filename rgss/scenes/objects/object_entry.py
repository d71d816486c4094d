"""Entry of an object in a scene file: form, lengths and grasp candidates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.document import GraspCandidatesEntry, GraspRule, Rest, WorkpieceEntry
from rgss.scenes.findings import Location
from rgss.scenes.grasps import GraspCandidates

OWN: Location = ("workpiece",)
"""Location of the entry of the first object."""

_SHAPES = ("box", "cylinder", "mesh")


def candidates_of(rule: GraspRule | GraspCandidatesEntry) -> GraspCandidates | None:
    """Grasp candidates; None for the stated grasp."""
    if isinstance(rule, GraspRule):
        return None if rule is GraspRule.AS_STATED else GraspCandidates()
    stated = rule.candidates
    return GraspCandidates(
        approaches=stated.approaches, heights=stated.heights, yaws=stated.yaws, samples=stated.samples
    )


def object_lengths(entry: WorkpieceEntry, *, at: Location = OWN) -> Iterator[tuple[Location, float]]:
    """Locations and values of the lengths, which must be above zero."""
    values: dict[Location, float | None] = {
        (*at, "radius"): entry.radius,
        (*at, "height"): entry.height,
        (*at, "mass"): entry.mass,
        (*at, "density"): entry.density,
        (*at, "scale"): entry.scale,
        (*at, "rolling_resistance"): entry.rolling_resistance,
    }
    parts: dict[Location, float] = {}
    if entry.cylinder is not None:
        parts |= {("cylinder", "radius"): entry.cylinder.radius, ("cylinder", "height"): entry.cylinder.height}
    parts |= {("box", axis): edge for axis, edge in enumerate(entry.box or ())}
    parts |= {("grasps", index, "width"): grasp.width for index, grasp in enumerate(entry.grasps)}
    values |= {(*at, *part): value for part, value in parts.items()}
    yield from ((location, value) for location, value in values.items() if value is not None)


def form_findings(entry: WorkpieceEntry, document: Document, at: Location) -> Iterable[Finding]:
    """Findings about an object without exactly one shape and one of mass and density, or with keys of another shape.

    Args:
        entry: The object.
        document: The scene's document.
        at: Location of the entry.
    """
    stated = [key for key in _SHAPES if getattr(entry, key) is not None]
    if entry.radius is not None or entry.height is not None:
        stated.append("radius and height")
    if len(stated) != 1 or (entry.radius is None) != (entry.height is None):
        yield document.finding(
            "scene.shape",
            f"object {entry.id!r} needs exactly one of 'box', 'cylinder', 'mesh', and 'radius' with 'height'",
            at,
        )
    if (entry.mass is None) == (entry.density is None):
        yield document.finding("scene.mass", f"object {entry.id!r} needs exactly one of 'mass' and 'density'", at)
    if entry.mesh is None and (entry.scale != 1.0 or entry.collision is not None):
        key = "scale" if entry.scale != 1.0 else "collision"
        yield document.finding("scene.shape", f"{key!r} is allowed only for a mesh", (*at, key), hint="remove it")
    is_round = entry.cylinder is not None or entry.radius is not None
    if is_round and entry.rests is Rest.LYING and entry.rolling_resistance is None:
        yield document.finding(
            "scene.rolling",
            f"object {entry.id!r} is a lying cylinder and would roll away",
            (*at, "rests"),
            hint="give 'rolling_resistance', a length: 0.5 mm on wood or laminate",
        )
    if entry.inertia is not None and entry.centre_of_mass is None:
        yield document.finding(
            "scene.mass", "'inertia' is about the centre of mass", (*at, "inertia"), hint="add centre_of_mass"
        )
    names = [grasp.id for grasp in entry.grasps]
    for index, name in enumerate(names):
        if name in names[:index]:
            yield document.finding(
                "scene.duplicate-id", f"id {name!r} is taken by an earlier grasp", (*at, "grasps", index, "id")
            )
