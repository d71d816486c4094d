"""Findings about uncertainty and workload that need the study, its scene and its grippers together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes import GripperFile, Scene
from rgss.scenes.uncertainty import Constant, unknown_objects
from rgss.studies.study import StudyDefinition

_MASS = "workpiece.mass"
_FRICTION = "workpiece.friction"


def uncertainty_findings(
    scene: Scene, study: StudyDefinition, document: Document, grippers: Mapping[str, GripperFile]
) -> Iterator[Finding]:
    """Contradictions between the uncertainty of a scene and the uncertainty and workload of a study.

    Args:
        scene: The scene.
        study: The study.
        document: The study's file.
        grippers: The gripper files of the designs, by name.
    """
    both = scene.uncertainty.overridden_by(study.uncertainty)
    declared = set(both.names)
    own = set(study.uncertainty.names)
    constants = {one.quantity for one in both.values if isinstance(one.distribution, Constant)} - own
    further = [one.workpiece.id for one in scene.others]
    yield from unknown_objects(study.uncertainty.names, document, first=scene.workpiece.id, further=further)
    for index, group in enumerate(study.uncertainty.correlations):
        for name in group.quantities:
            if name not in declared:
                message, hint = f"{name} has no distribution", "give it one under 'uncertainty', here or in the scene"
                yield document.finding("uncertainty.group", message, ("correlations", index, "quantities"), hint=hint)
            elif name in constants:
                message, hint = f"{name} is constant in the scene and cannot be correlated", "take it out of the group"
                yield document.finding("uncertainty.group", message, ("correlations", index, "quantities"), hint=hint)
    narrowest_m = min((file.geometry.largest_opening_m for file in grippers.values()), default=None)
    for index, case in enumerate(study.workload.cases):
        for name, key, value in ((_MASS, "mass", case.mass_kg), (_FRICTION, "friction", case.friction)):
            if value is not None and name in declared:
                message = f"case {case.id!r} gives the {key} that {name} draws"
                hint = "take it out of the case, or out of 'uncertainty'; workpiece.mass_factor varies a case's mass"
                yield document.finding("workload.drawn", message, ("workload", index, key), hint=hint)
        if case.radius_m is not None and narrowest_m is not None and case.radius_m >= narrowest_m:
            sizes = f"of radius {case.radius_m * 1e3:g} mm does not fit into a hand that opens {narrowest_m * 1e3:g} mm"
            message = f"an object {sizes}"
            yield document.finding("workload.radius", message, ("workload", index, "radius"), hint="take a thinner one")
