"""The line of `rgss run` on the grasp that was chosen."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.cli.verbs.run import _print_chosen_grasp

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
    phases = [SimpleNamespace(metrics={}), SimpleNamespace(metrics={**COMMON, **quality})]
    _print_chosen_grasp(SimpleNamespace(phases=phases))
    assert capsys.readouterr().out == line


def test_a_stated_grasp_is_not_shown(capsys):
    _print_chosen_grasp(SimpleNamespace(phases=[SimpleNamespace(metrics={"slip_m": 0.0})]))
    assert capsys.readouterr().out == ""
