"""Arms that cannot turn their tool to every pose or by a whole turn, and gantries: from a URDF to a decision."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
import yaml

from rgss.cli.main import main
from rgss.scenes import Waypoint
from rgss.studies import load_project, trial_specs
from rgss.trials import cell_of, waypoint_configurations
from tests.fixtures.palletizer import palletizer_urdf
from tests.fixtures.serial_arms import FIVE, GANTRY, SCARA, Link, Y, serial_urdf


@pytest.fixture
def project_of(tmp_path):
    """Makes the project round an arm, its study kinematic with one replicate."""

    def make(links):
        urdf, project = tmp_path / "arm.urdf", tmp_path / "project"
        urdf.write_text(links if isinstance(links, str) else serial_urdf(links), encoding="utf-8")
        assert main(["init", "--robot", str(urdf), str(project)]) == 0
        study = project / "studies" / "pick_place.yaml"
        text = study.read_text(encoding="utf-8").replace("fidelity: contact", "fidelity: kinematic")
        study.write_text(text.replace("replicates: 2", "replicates: 1"), encoding="utf-8")
        return project

    return make


@pytest.mark.engine
@pytest.mark.parametrize("links", [FIVE, FIVE[:4], SCARA, GANTRY], ids=["five", "four", "scara", "gantry"])
def test_an_arm_of_few_joints_ends_in_a_choice(project_of, links, capsys):
    project = project_of(links)

    assert main(["check", "--project", str(project)]) == 0
    assert main(["sweep", "--jobs", "1", "--project", str(project)]) == 0
    capsys.readouterr()
    assert main(["trade", "--json", "--project", str(project)]) in (0, 1)
    assert json.loads(capsys.readouterr().out)["chosen"] is not None


@pytest.mark.engine
@pytest.mark.parametrize("links", [FIVE, GANTRY, palletizer_urdf()], ids=["five", "gantry", "palletizer"])
def test_the_cup_is_carried_in_contact(project_of, links, capsys):
    project = project_of(links)
    capsys.readouterr()

    assert main(["run", "2", "--fidelity", "contact", "--project", str(project), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["success"] is True


@pytest.mark.engine
def test_a_gantry_hangs_above_its_tables(project_of):
    scene = yaml.safe_load((project_of(GANTRY) / "scenes" / "kitchen.yaml").read_text(encoding="utf-8"))
    x, y, _ = (float(text.removesuffix(" m")) for text in scene["robot"]["base"])
    turn = math.radians(float(scene["robot"]["yaw"].removesuffix(" deg")))

    assert scene["task"]["free_yaw"] is True
    assert "pedestal" not in [body["id"] for body in scene["bodies"]]
    assert "robot.base" in [one["about"] for one in scene["assumptions"]]
    # The middle of its ranges, (0.5, 0.45) from the base, is over the middle between the tables.
    middle = (
        x + 0.5 * math.cos(turn) - 0.45 * math.sin(turn),
        y + 0.5 * math.sin(turn) + 0.45 * math.cos(turn),
    )
    assert middle == pytest.approx((0.0, 0.0), abs=0.02)


SHORT_OF_A_TURN = (-2.8, 2.8)


@pytest.mark.engine
@pytest.mark.parametrize(("last", "is_free"), [(SHORT_OF_A_TURN, True), ((-6.2, 6.2), False)])
def test_an_arm_that_would_turn_over_between_the_tables_turns_its_gripper_instead(tmp_path, last, is_free):
    """A last joint that cannot make the stated yaw at both tables in one configuration of the other joints."""
    links = (
        Link("revolute", (0.0, 0.0, 0.11), range=SHORT_OF_A_TURN),
        Link("revolute", (0.0, 0.0, 0.1), axis=Y, range=SHORT_OF_A_TURN),
        Link("revolute", (0.0, 0.0, 0.3), axis=Y, range=SHORT_OF_A_TURN),
        Link("revolute", (0.0, 0.0, 0.25), range=SHORT_OF_A_TURN),
        Link("revolute", (0.0, 0.0, 0.1), axis=Y, range=SHORT_OF_A_TURN),
        Link("revolute", (0.0, 0.0, 0.15), range=last),
    )
    urdf = tmp_path / "six.urdf"
    urdf.write_text(serial_urdf(links), encoding="utf-8")

    assert main(["init", "--robot", str(urdf), str(tmp_path / "new")]) == 0

    text = (tmp_path / "new" / "scenes" / "kitchen.yaml").read_text(encoding="utf-8")
    assert ("free_yaw: true" in text) is is_free
    project = load_project(tmp_path / "new")
    (spec,) = trial_specs(project.nominal(), variants=[project.designs.variant(2)], seeds=[1])
    stops = waypoint_configurations(cell_of(spec))
    carry = np.abs(stops[Waypoint.PLACE_APPROACH] - stops[Waypoint.GRASP_DEPARTURE])
    assert carry.max() < 2.5
