"""Grasps are searched only in a scene whose objects can be where it has them."""

from __future__ import annotations

import pytest

import rgss.trials
from rgss.findings import Severity
from rgss.studies import scene_findings
from rgss.studies.project import load_project
from rgss.studies.scene_findings import check_scene
from rgss.trials import SceneProblem, SceneProblemKind

SCENE, HAND = "scenes/restaurant.yaml", "scenes/grippers/kg-2.yaml"


@pytest.fixture
def searched(monkeypatch):
    """Names of the searches that a check makes."""
    called = []
    for name in ("hand_step_problems", "reach_problems"):
        monkeypatch.setattr(rgss.trials, name, lambda *_, name=name, **__: called.append(name) or ())
    return called


@pytest.fixture
def unloaded(monkeypatch):
    """Loads of what is held, which are those of grasps that are searched anew, are no part of a check."""
    monkeypatch.setattr(scene_findings, "held_load_findings", lambda *_: ())


@pytest.fixture
def at(folder, edit):
    """The scene with its cup at another place, and with chosen grasps where asked for."""

    def place(x, *, automatic):
        if automatic:
            edit(SCENE, "\ntask:\n", "\ntask:\n  grasp: automatic\n")
        edit(SCENE, "  at: [", f"  at: [{x} m, 0 m] # [")
        return check_scene(load_project(folder))

    return place


def test_objects_that_overlap_or_hang_are_found_without_a_search(at, searched):
    found = at(50, automatic=True)
    assert "scene.object-unsupported" in {one.rule for one in found.findings}
    assert searched == []
    assert found.skipped == "grasps are not searched before the objects of the scene neither overlap nor lack support"


def test_a_stated_grasp_is_checked_all_the_same(at, searched):
    found = at(50, automatic=False)
    assert "scene.object-unsupported" in {one.rule for one in found.findings}
    assert set(searched) == {"hand_step_problems", "reach_problems"}
    assert found.skipped == ""


@pytest.mark.usefixtures("unloaded")
def test_grasps_are_searched_in_a_sound_scene(folder, edit, searched):
    edit(SCENE, "\ntask:\n", "\ntask:\n  grasp: automatic\n")
    assert check_scene(load_project(folder)).skipped == ""
    assert set(searched) == {"hand_step_problems", "reach_problems"}


@pytest.mark.usefixtures("unloaded")
@pytest.mark.parametrize(("fingers", "severity"), [({2}, Severity.INFO), ({2, 3}, Severity.ERROR)])
def test_a_hand_of_some_designs_that_no_candidate_fits_is_a_result(folder, edit, monkeypatch, fingers, severity):
    def problems(scene, geometry, **_):
        none = SceneProblem(kind=SceneProblemKind.NO_GRASP, first=scene.workpiece.id, detail="too narrow: 38")
        return (none,) if geometry.fingers in fingers else ()

    monkeypatch.setattr(rgss.trials, "hand_step_problems", lambda *_, **__: ())
    monkeypatch.setattr(rgss.trials, "reach_problems", problems)
    monkeypatch.setattr(scene_findings, "lack_of_room", lambda *_: "")
    edit(SCENE, "\ntask:\n", "\ntask:\n  grasp: automatic\n")
    found = [one for one in check_scene(load_project(folder)).findings if one.rule == "scene.no-grasp"]
    assert {one.severity for one in found} == {severity}
    assert ("designs with this gripper fail there" in found[0].hint) is (severity is Severity.INFO)


@pytest.mark.usefixtures("unloaded")
def test_the_checked_mounting_is_the_one_that_has_grasp_candidates(folder, edit, monkeypatch):
    seen = {}
    monkeypatch.setattr(rgss.trials, "hand_step_problems", lambda *_, **__: ())
    monkeypatch.setattr(
        rgss.trials, "reach_problems", lambda _, hand, **__: seen.update({hand.id: hand.mounting}) or ()
    )
    edit(SCENE, "\ntask:\n", "\ntask:\n  grasp: automatic\n")
    # As it stands, the box is 50 mm wide between the pads: too wide for one mounting and too narrow for the other.
    edit(SCENE, "  radius: 35 mm\n  height: 100 mm\n", "  box: [50 mm, 80 mm, 100 mm]\n")
    mountings = "{normal: {closed: 0 mm, open: 16 mm}, reverse: {closed: 60 mm, open: 100 mm}}"
    edit(HAND, "azimuths: [0 deg, 180 deg]", f"kind: parallel\nmountings: {mountings}\nmounting: normal")
    edit(HAND, "largest_opening: 70 mm\nstroke: 48 mm\n", "")
    check_scene(load_project(folder))
    assert seen["kg-2"] == "reverse"


@pytest.mark.usefixtures("unloaded")
def test_candidates_without_room_for_the_clearance_are_explained(folder, edit, monkeypatch):
    none = SceneProblem(kind=SceneProblemKind.NO_GRASP, first="cup", detail="collision or clearance: 8")
    monkeypatch.setattr(rgss.trials, "hand_step_problems", lambda *_, **__: ())
    monkeypatch.setattr(rgss.trials, "reach_problems", lambda *_, **__: (none,))
    edit(SCENE, "\ntask:\n", "\ntask:\n  grasp: automatic\n")
    edit("studies/pick_place.yaml", "  clearance: 8 mm\n", "  clearance: 36 mm\n")
    (found,) = (one for one in check_scene(load_project(folder)).findings if one.rule == "scene.no-grasp")
    assert found.message.endswith(
        "collision or clearance: 8; the fingers hold it 70 mm wide at best and open to 140 mm, which leaves room for "
        "68 mm with the clearance of planned paths, 36 mm on each side ('planning.clearance' of the study)"
    )
    assert found.hint == "lower that clearance, or take a narrower object or a wider gripper"
