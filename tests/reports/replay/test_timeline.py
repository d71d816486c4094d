"""The timeline of a replay: phases, plots whose peaks are kept, contacts, and what is unknown."""

from __future__ import annotations

import json

import numpy as np
import pytest

from rgss.reports.replay.timeline import timeline_of
from rgss.reports.replay.timeline_json import timeline_to_json
from tests.fixtures.made_replay import JOINTS, made_record, made_scene, made_trace


@pytest.fixture(scope="module")
def timeline():
    made = timeline_of(made_record(), made_trace(), made_scene(), joints=JOINTS, title="Variant 5")
    return timeline_to_json(made, made_scene())


def series(timeline, title):
    (plot,) = (plot for plot in timeline["plots"] if plot["title"] == title)
    return plot


def test_it_is_strict_json(timeline):
    assert json.loads(json.dumps(timeline, allow_nan=False)) == timeline


def test_phases_without_motion_have_no_times(timeline):
    assert [(one["name"], one["start_s"], one["outcome"]) for one in timeline["phases"]] == [
        ("reach out", 0.0, "completed"),
        ("grip", 1.0, "completed"),
        ("carry", 2.0, "failed"),
        ("set down", None, "not run"),
    ]
    assert timeline["outcome"] == "Failed at carry, object dropped: </script><b>it slipped</b> 21.0 mm."


def test_no_peak_of_a_force_and_no_least_margin_is_lost(timeline):
    trace = made_trace()
    fingers = [one for one in series(timeline, "Finger forces")["series"] if not one.get("dashed")]
    for one, column in zip(fingers, trace.finger_forces_n.T, strict=True):
        assert max(one["values"]) == pytest.approx(column.max(), rel=1e-4)
    margins = [value for value in series(timeline, "Grip margin")["series"][0]["values"] if value is not None]
    assert min(margins) == pytest.approx(np.nanmin(trace.grip_margin), rel=1e-4)


def test_a_sliding_joint_is_in_millimetres(timeline):
    plot = series(timeline, "Joint positions")
    assert [one["name"] for one in plot["series"]] == ["axis 1", "axis 2", "axis 3", "axis 4"]
    assert plot["unit"] == "° or mm"
    scene, trace = made_scene(), made_trace()
    at = [int(np.argmin(np.abs(trace.time_s - time))) for time in scene.time_s]
    assert plot["series"][0]["values"] == pytest.approx(np.degrees(trace.joint_positions_rad[at, 0]), rel=1e-4)
    assert plot["series"][3]["values"] == pytest.approx(1e3 * trace.joint_positions_rad[at, 3], rel=1e-4)


def test_there_is_no_arrow_without_contact(timeline):
    for one in timeline["contacts"]:
        known = [time for time, point in zip(timeline["time_s"], one["points_m"], strict=True) if point is not None]
        assert min(known) > 1.0
    assert timeline["greatest_force_n"] == pytest.approx(5.0)
    assert timeline["perceived"] == [
        {"object": "red cup", "distance_mm": 12.3, "angle_deg": 5.73},
        {"object": "other cup", "distance_mm": 10.0, "angle_deg": 0.0},
    ]


def test_what_else_the_robot_touches_is_told_in_words(timeline):
    assert timeline["touches"] == [
        {
            "link": "upper arm",
            "body": "the post",
            "start_s": 0.5,
            "end_s": 0.6,
            "point_m": [0.2, 0.1, 0.3],
            "force_n": [0.0, -80.0, 60.0],
        }
    ]


def test_a_trial_without_contact_has_no_force():
    scene = made_scene()
    for one in scene.contacts:
        one.points_m[:] = one.forces_n[:] = np.nan
    made = timeline_of(made_record(fails=False), made_trace(), scene, joints=JOINTS, title="")
    found = timeline_to_json(made, scene)
    assert found["greatest_force_n"] == 0.0
    assert found["outcome"] == "Done: every phase is complete."
