"""Verbs on a study whose trials differ: run shows the draws, replay finds them again, nominal leaves them out."""

from __future__ import annotations

import csv

import pytest

pytestmark = pytest.mark.engine

UNCERTAIN = """
uncertainty:
  perception.x: {normal: {mean: 0 mm, sd: 3 mm}, rationale: camera}
  robot.joint_offset: {normal: {mean: 0 deg, sd: 0.02 deg}, rationale: wear}
  gripper.finger.force: {constant: 90 %, rationale: a worn hand}
workload:
  - {case: cup, rationale: as it is}
  - {case: full, mass: 0.6 kg, rationale: with water}
"""


@pytest.fixture
def uncertain(folder):
    """A kinematic study of uncertain trials; plans are what takes time."""
    path = folder / "studies" / "pick_place.yaml"
    text = path.read_text(encoding="utf-8").replace("fidelity: contact", "fidelity: kinematic")
    path.write_text(text + UNCERTAIN, encoding="utf-8")
    return folder


def test_run_shows_each_draw_beside_its_nominal_value(rgss, uncertain):
    told = rgss("run", 65, "--seed", 1, "--project", uncertain)
    document = rgss("run", 65, "--seed", 1, "--json", "--project", uncertain).document
    nominal = rgss("run", 65, "--seed", 1, "--json", "--nominal", "--project", uncertain).document

    assert "Case of the workload: full" in told.output
    rows = {words[0]: words[1:] for line in told.output.splitlines() if (words := line.split())}
    assert rows["gripper.finger.force"] == ["N", "10", "9"]
    assert rows["perception.x"][:2] == ["mm", "0"]
    assert len(document["draws"]) == 8
    assert {"quantity": "gripper.finger.force", "unit": "N", "nominal": 10.0, "drawn": 9.0} in document["draws"]
    assert (document["workload"], nominal["workload"], nominal["draws"]) == ("full", None, [])
    assert document["digest"] != nominal["digest"]


def test_a_drawn_trial_is_stored_exported_and_replayed(rgss, uncertain, tmp_path):
    chosen = ("--only", "65", "--replicates", "2", "--jobs", "1", "--project", uncertain)
    assert rgss("sweep", *chosen).status == 0
    again = rgss("replay", "65/1", "--project", uncertain)
    assert (again.status, "The same, bit for bit" in again.output) == (0, True)

    table = tmp_path / "trials.csv"
    rgss("evidence", "export", table, "--project", uncertain)
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["workload"] for row in rows} == {"cup", "full"}
    assert len({row["drawn_perception_x_m"] for row in rows}) == 2
    assert {row["drawn_gripper_finger_force_1"] for row in rows} == {"0.9"}
    assert "drawn_robot_joint_offset_6_rad" in rows[0]


def test_a_nominal_trial_is_replayed_as_the_files_say(rgss, uncertain):
    chosen = ("--only", "65", "--replicates", "1", "--jobs", "1", "--nominal", "--project", uncertain)
    assert rgss("sweep", *chosen).status == 0

    assert rgss("replay", "65/1", "--project", uncertain).status == 0


def test_replay_of_a_trial_that_was_drawn_otherwise_says_so(rgss, uncertain):
    chosen = ("--only", "65", "--replicates", "1", "--jobs", "1", "--project", uncertain)
    rgss("sweep", *chosen)
    path = uncertain / "studies" / "pick_place.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace("sd: 3 mm", "sd: 4 mm"), encoding="utf-8")

    told = rgss("replay", "65/1", "--project", uncertain)

    assert told.status == 1
    assert "changed inputs: plan" in told.output
    assert "0.003 then, 0.004 now" in told.output
