"""Details of failures name the object of the phase, if the scene has several."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.scenes import initial_placements
from rgss.tasks import stages_of
from rgss.trials.planning import with_object_named
from rgss.trials.task_objects import TaskObjects


class ObjectsAtRest:
    """World whose objects are where the scene has them."""

    def __init__(self, scene):
        self.scene, self._at = scene, {name: one.pose for name, one in initial_placements(scene).items()}

    def object_pose(self, name):
        return self._at[name]

    def set_workpiece(self, scene):
        self.scene = scene


@pytest.mark.parametrize(
    ("detail", "named"),
    [
        ("the object slipped 20.1 mm in the gripper", "tin slipped 20.1 mm in the gripper"),
        ("finger_0 moved the placed object by 2.0 mm", "finger_0 moved tin by 2.0 mm"),
        ("the cup is 3.1 mm above the object, it seals", "the cup is 3.1 mm above tin, it seals"),
        ("wrist touched table", "wrist touched table"),
    ],
)
def test_of_two_objects_the_present_one_is_named(with_two, detail, named):
    spec = with_two()
    objects = TaskObjects(ObjectsAtRest(spec.scene), spec.task)
    stage = next(one for one in stages_of(spec.task, spec.scene.workpiece.id) if one.object == "tin")
    objects.enter(stage)
    assert objects.named(detail) == named


def test_details_of_plans_name_it_too(with_two):
    spec = with_two()
    detail = "no valid configuration for lift: the object would be tilted by 60°, in the only one"
    assert with_object_named(detail, spec.scene) == detail.replace("the object", spec.scene.workpiece.id)


def test_a_single_object_is_the_object(spec_of):
    spec = spec_of(65)
    objects = TaskObjects(SimpleNamespace(scene=spec.scene), spec.task)
    assert objects.named("the object slipped 20.1 mm") == "the object slipped 20.1 mm"
