"""Places that are marked in films and replays."""

from __future__ import annotations

from rgss.scenes import PlaceRegion, Scene
from rgss.tasks import HandAction, TaskProgram, stages_of

_PLACE = "place"


def marked_places(scene: Scene, task: TaskProgram) -> dict[str, PlaceRegion]:
    """Regions on fixed bodies at which a task releases its objects, by name, in the order of the task."""
    named = {one.id: one.region for one in scene.places}
    own = {one.workpiece.id: one.place for one in scene.objects}
    found: dict[str, PlaceRegion] = {}
    for stage in stages_of(task, scene.workpiece.id):
        if stage.step.hand is not HandAction.OPENS:
            continue
        name = stage.place or (_PLACE if stage.object == scene.workpiece.id else f"{_PLACE} of {stage.object}")
        region = named[stage.place] if stage.place else own[stage.object]
        if region.offset_m is None and region not in found.values():
            found[name] = region
    return found
