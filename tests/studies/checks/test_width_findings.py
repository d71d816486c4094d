"""Objects that do not go between the fingers, or that they do not touch, are named with both sizes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.documents import read_document
from rgss.findings import Severity
from rgss.scenes import Cylinder
from rgss.scenes.grasps import GraspCandidates
from rgss.studies.checks.gripped_objects import TOO_NARROW, TOO_WIDE
from rgss.studies.scene_findings import check_scene

SCENE = "scenes/restaurant.yaml"


def with_radius(project, radius_m):
    """The project with a cup of another radius."""
    workpiece = project.scene.workpiece
    shape = Cylinder(radius_m=radius_m, height_m=workpiece.shape.height_m)
    return replace(project, scene=replace(project.scene, workpiece=replace(workpiece, shape=shape)))


def geometry_of(project):
    return next(iter(project.grippers.values())).geometry


@pytest.mark.parametrize(("share", "found"), [(0.99, 0), (1.01, 1)])
def test_an_object_wider_than_the_open_fingers(shipped, share, found):
    geometry = geometry_of(shipped)
    project = with_radius(shipped, share * geometry.largest_opening_m)
    reasons = TOO_WIDE.objects(geometry, project)
    assert len(reasons) == found
    for name, reason in reasons:
        assert name == project.scene.workpiece.id
        assert f", {2e3 * share * geometry.largest_opening_m:.4g} mm across, is too wide to enter gripper" in reason


@pytest.mark.parametrize(("share", "found"), [(1.01, 0), (0.99, 1)])
def test_an_object_narrower_than_the_closed_fingers(shipped, share, found):
    geometry = geometry_of(shipped)
    project = with_radius(shipped, share * geometry.least_opening_m)
    reasons = TOO_NARROW.objects(geometry, project)
    assert len(reasons) == found
    for name, reason in reasons:
        assert name == project.scene.workpiece.id
        assert (
            f", {2e3 * share * geometry.least_opening_m:.4g} mm across, is too narrow to be touched by gripper"
            in reason
        )


def test_chosen_grasps_have_findings_of_their_own(shipped):
    project = with_radius(shipped, 1.01 * geometry_of(shipped).largest_opening_m)
    task = replace(project.scene.task, candidates=GraspCandidates())
    chosen = replace(project, scene=replace(project.scene, task=task))
    assert TOO_WIDE.objects(geometry_of(shipped), chosen) == ()
    assert TOO_NARROW.objects(geometry_of(shipped), with_radius(chosen, 1e-3)) == ()


def test_the_check_names_the_sizes_and_no_collision_of_a_finger(shipped):
    widest_m = max(file.geometry.largest_opening_m for file in shipped.grippers.values())
    found = check_scene(with_radius(shipped, 1.05 * widest_m)).findings

    assert {one.severity for one in found if one.rule == "scene.too-wide"} == {Severity.ERROR}
    assert not [one for one in found if one.rule == "scene.unserved" and "finger" in one.message]


def test_the_check_names_an_object_that_no_hand_touches(shipped):
    narrowest_m = min(file.geometry.least_opening_m for file in shipped.grippers.values())
    found = check_scene(with_radius(shipped, 0.9 * narrowest_m)).findings

    narrow = [one for one in found if one.rule == "scene.too-narrow"]
    assert {one.severity for one in narrow} == {Severity.ERROR}
    assert {one.hint for one in narrow} == {
        "take a wider object, or a gripper that closes further ('stroke' of its file)"
    }


@pytest.mark.parametrize("finding_of", [TOO_WIDE.finding, TOO_NARROW.finding])
def test_another_gripper_makes_it_a_result(shipped, finding_of):
    document = read_document(shipped.folder / SCENE, label=SCENE)
    found = [
        finding_of(document, ("workpiece", "id"), "it does not fit", ["a.yaml"], serves=serves)
        for serves in (False, True)
    ]
    assert [one.severity for one in found] == [Severity.ERROR, Severity.INFO]
    assert found[1].hint == "designs with this gripper fail at the grasp, and the others do not"
