"""``rgss planners``: planners compared on the moves of the study's task."""

from __future__ import annotations

import pytest

STUDY = "studies/pick_place.yaml"
CLEARANCE = "  clearance: 8 mm\n"


@pytest.fixture
def quick(folder):
    """A project whose searches are coarse, with planners of its own."""
    text = (folder / STUDY).read_text(encoding="utf-8")
    text = text.replace("  resolution: 0.01 rad\n", "  resolution: 0.1 rad\n  verification_resolution: 0.05 rad\n")
    section = "  references: [RRTConnect]\n  planners:\n    RRT: {range: 1 rad, goal_bias: 0.2}\n"
    text = text.replace(CLEARANCE, f"{CLEARANCE}  on_unverified: repair\n{section}")
    (folder / STUDY).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.engine
def test_planners_are_compared_on_the_same_searches(rgss, quick):
    told = rgss("planners", "--only", "RRT,RRTConnect,TRRT", "--seeds", 1, "--json", "--project", quick)
    document = told.document

    assert (told.status, told.errors) == (0, "")
    assert (document["seeds"], document["limits_s"]) == ([1], [4.0, 6.0, 8.0])
    names = [(one["name"], one["reference"], one["label"]) for one in document["planners"]]
    assert names == [("RRT", False, "RRT"), ("RRTConnect", True, "RRTConnect"), ("TRRT", False, "TRRT (no cost)")]
    first = document["planners"][0]
    assert first["parameters"] == {"range": 1.0, "goal_bias": 0.2}
    # Five moves with each of the two grippers' shapes.
    assert {one["searches"] for one in document["planners"]} == {10}
    for one in document["planners"]:
        assert one["solved"] == sorted(one["solved"])
        assert 0 < one["checks_median"] <= (one["checks_90"] or 10**9)
        assert 0.0 < one["mean_time_s"] <= 10.0
        assert one["not_verified"] == 0
    again = rgss("planners", "--only", "RRT,RRTConnect,TRRT", "--seeds", 1, "--json", "--project", quick)
    assert again.document == document


@pytest.mark.engine
def test_the_table_has_the_references(rgss, quick):
    told = rgss("planners", "--only", "RRTConnect", "--seeds", 1, "--project", quick)
    assert told.status == 0
    assert "RRTConnect, reference" in told.output
    assert "OMPL's defaults" in told.output


@pytest.mark.engine
@pytest.mark.parametrize(
    ("more", "expected"),
    [
        (["--only", "RTT"], "unknown planner 'RTT' (did you mean 'RRT'?"),
        (["--only", "SST"], "planner SST cannot be run: it always runs to its limit"),
        (["--seeds", "0"], "--seeds must be from 1 to 10000 (omit it for the study's number)"),
    ],
)
def test_planners_that_cannot_be_compared(rgss, untouched, more, expected):
    told = rgss("planners", *more, "--project", untouched)
    assert told.status == 2
    assert expected in told.errors


@pytest.mark.engine
def test_a_task_without_a_planned_move_has_no_searches(rgss, folder):
    path = folder / STUDY
    text = path.read_text(encoding="utf-8")
    moves = "move_to_grasp, move_to_grasp_departure, move_to_place_approach, move_to_place, move_to_grasp_approach"
    section = "".join(f"  {name}: straight\n" for name in moves.split(", "))
    path.write_text(f"{text}\nmoves:\n{section}", encoding="utf-8")
    told = rgss("planners", "--seeds", 1, "--project", folder)
    assert (told.status, told.output) == (2, "")
    assert "studies/pick_place.yaml: no move of task 'pick_and_place' is planned" in told.errors
    assert "planners search for moves of mode 'planned'" in told.errors
