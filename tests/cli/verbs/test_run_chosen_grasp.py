"""The lines of `rgss run` on the grasps that were chosen, and on the places of objects."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.cli.verbs.run import _distance_from_place, _print_chosen_grasps

COMMON = {
    "chosen_grasp_rank": 2,
    "chosen_grasp_candidates": 40,
    "chosen_grasp_com_distance_m": 0.0,
    "chosen_grasp_position_m": (0.001, 0.0, -0.02),
}


@pytest.mark.parametrize(
    ("quality", "line"),
    [
        (
            {"chosen_grasp_weight_1": 0.4, "chosen_grasp_room_m": 0.015},
            (
                "Grasp: candidate 2 of 40, cup 15 mm from the edge of its face, grasp centre at (1, 0, -20) mm in the "
                "object, bears 0.4 N of weight per N of vacuum\n"
            ),
        ),
        (
            {"chosen_grasp_opening_m": 0.025, "chosen_grasp_smw_1": 0.2},
            (
                "Grasp: candidate 2 of 40, centre at (1, 0, -20) mm in the object, pads 50 mm apart, "
                "smallest maximum wrench 0.2 N per N\n"
            ),
        ),
    ],
    ids=["cup", "fingers"],
)
def test_the_chosen_grasp_is_shown_with_its_quality(capsys, quality, line):
    gripped = {**COMMON, **quality}
    phases = [SimpleNamespace(phase="move", metrics={})]
    phases += [SimpleNamespace(phase=f"cycle_{turn}.grip", metrics=gripped) for turn in (1, 2)]
    _print_chosen_grasps(SimpleNamespace(phases=phases))
    assert capsys.readouterr().out == line


def test_a_stated_grasp_is_not_shown(capsys):
    _print_chosen_grasps(SimpleNamespace(phases=[SimpleNamespace(phase="grip", metrics={"slip_m": 0.0})]))
    assert capsys.readouterr().out == ""


def test_objects_with_different_grasps_have_a_line_each(capsys):
    quality = {"chosen_grasp_opening_m": 0.025, "chosen_grasp_smw_1": 0.2}
    metrics = {**COMMON, **quality, "chosen_grasp_position_m": (3e-18, -1e-6, 0.0123)}
    phases = [
        SimpleNamespace(phase="tin.grip", metrics={**COMMON, **quality}),
        SimpleNamespace(phase="box.grip", metrics=metrics),
    ]
    _print_chosen_grasps(SimpleNamespace(phases=phases))
    tin, box = capsys.readouterr().out.splitlines()
    assert tin.startswith("Grasp in tin.grip: candidate 2 of 40, centre at (1, 0, -20) mm in the object")
    assert box.startswith("Grasp in box.grip: candidate 2 of 40, centre at (0, 0, 12.3) mm in the object")


@pytest.mark.parametrize(
    ("releases", "text"),
    [
        (0, ": the object is 2 mm from the place"),
        (1, ": the object is 2 mm from the place"),
        (2, ": of 2 releases the farthest object is 2 mm from the place"),
    ],
)
def test_an_object_that_is_released_twice_is_not_two_objects(releases, text):
    phases = [SimpleNamespace(metrics={"release_height_m": 0.003}) for _ in range(releases)]
    record = SimpleNamespace(phases=[SimpleNamespace(metrics={}), *phases], metrics={"place_error_m": 0.002})
    assert _distance_from_place(record) == text
    record.metrics["place_error_m"] = 7e-11
    assert _distance_from_place(record) == text.replace("2 mm", "less than 0.001 mm")
    record.metrics["place_error_m"] = None
    assert _distance_from_place(record) == ""
