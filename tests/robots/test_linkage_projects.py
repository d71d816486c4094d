"""From a URDF with a hand to a decision: the hand's own mechanism, and one of cranks, compared on one arm."""

from __future__ import annotations

import json
import re
import shutil

import pytest

from rgss.cli.main import main
from tests.trials.hands.gripper_files import TWO_FINGER

HAND = """\
gripper: panda-hand
kind: linkage
description: ../robots/panda.urdf
palm: panda_hand
pads: [panda_leftfinger, panda_rightfinger]
mount: {yaw: -45 deg}
speed: 50 mm/s
"""
CRANKS = """\
gripper: two-finger
kind: linkage
description: two_finger.urdf
pads: [left_tip, right_tip]
grasp_from_tip: 15 mm
speed: 50 mm/s
"""
PARAMETER = "  - {id: hand, name: hand, symbol: h, kind: name, sets: catalogue.gripper, description: Hand.}\n"
COMPONENTS = """\
  - id: panda-hand
    role: gripper
    name: Hand of the arm
    manufacturer: not stated
    geometry: scenes/grippers/panda_hand.yaml
    cost: {value: 3900 USD, assumption: true, rationale: Order of magnitude.}

  - id: two-finger
    role: gripper
    name: Two cranks
    manufacturer: not stated
    geometry: scenes/grippers/two_finger.yaml
    cost: {value: 4900 USD, assumption: true, rationale: Order of magnitude.}

"""

# As many grasps as there are ways to turn a hand over a box; each of them is tried where none can be carried out.
FEW = "{candidates: {approaches: [above], heights: 1}}"


@pytest.fixture(scope="module")
def project(projects, tmp_path_factory):
    """The project of an arm whose grippers are two linkages, and whose object is a box."""
    folder = tmp_path_factory.mktemp("linkages") / "project"
    shutil.copytree(projects["seven with a hand"], folder)
    grippers = folder / "scenes" / "grippers"
    (grippers / "panda_hand.yaml").write_text(HAND, encoding="utf-8")
    (grippers / "two_finger.yaml").write_text(CRANKS, encoding="utf-8")
    shutil.copy(TWO_FINGER, grippers)
    edit(folder / "designs" / "catalogue.yaml", (r"  - id: kg-2\n(?s:.*?)(?=  - id: ka-58)", COMPONENTS))
    edit(
        folder / "designs" / "design_space.yaml",
        (r"  - id: (finger_mass|base_mass|finger_speed)\n(?:    .*\n)+", ""),
        (r"  (finger_mass|base_mass|finger_speed): .*\n", ""),
        (r"planner: RRTConnect\n", "planner: RRTConnect\n  fingers: 2\n  friction: 0.8\n"),
        (r"sets: \{fingers: 2, friction: 0.7\}", "sets: {hand: panda-hand}"),
        (r"sets: \{fingers: 3, friction: 0.7\}", "sets: {hand: two-finger}"),
        (
            "parameters:\n",
            f"parameters:\n{PARAMETER}",
        ),
    )
    edit(
        folder / "scenes" / "kitchen.yaml",
        (r"  id: cup\n  radius: 35 mm\n  height: 100 mm\n", "  id: block\n  box: [40 mm, 50 mm, 40 mm]\n"),
        (r"  grasp_yaw:", f"  grasp: {FEW}\n  grasp_yaw:"),
    )
    # The hand is turned by 45 deg on the flange, which the last joint makes up for.
    edit(
        folder / "scenes" / "robots" / "panda.yaml",
        (r"name: panda_joint7, range: \[[^]]*\]", "name: panda_joint7, range: [-2.8 rad, 2.8 rad]"),
    )
    edit(
        folder / "studies" / "pick_place.yaml",
        (r"clearance: 8 mm", "clearance: 4 mm"),
        (r"replicates: \d+", "replicates: 1"),
    )
    return folder


def edit(path, *changes):
    text = path.read_text(encoding="utf-8")
    for pattern, new in changes:
        text, count = re.subn(pattern, lambda _, new=new: new, text)
        assert count, pattern
    path.write_text(text, encoding="utf-8")


@pytest.mark.parametrize("fidelity", ["kinematic", "dynamic", "contact"])
@pytest.mark.parametrize("variant", ["1", "3"])
def test_a_linkage_carries_a_box_in_each_fidelity(project, variant, fidelity, capsys):
    status = main(["run", variant, "--fidelity", fidelity, "--json", "--project", str(project)])
    record = json.loads(capsys.readouterr().out)

    assert (status, record["failure_detail"], record["success"]) == (0, "", True)


def test_a_study_of_two_linkages_ends_in_a_decision(project, tmp_path, capsys):
    """By kinematic trials; `test_own_grippers` has a decision by contact for each of these hands."""
    folder = tmp_path / "project"
    shutil.copytree(project, folder)
    assert main(["check", "--project", str(folder)]) == 0
    edit(folder / "studies" / "pick_place.yaml", (r"fidelity: contact", "fidelity: kinematic"))
    assert main(["sweep", "--jobs", "1", "--project", str(folder)]) == 0
    capsys.readouterr()
    main(["trade", "--json", "--project", str(folder)])
    decision = json.loads(capsys.readouterr().out)

    assert decision["chosen"] in (1, 2)  # the cheaper hand


def test_check_names_a_hand_without_a_driven_joint(project, tmp_path, capsys):
    folder = tmp_path / "project"
    shutil.copytree(project, folder)
    edit(
        folder / "scenes" / "grippers" / "two_finger.urdf",
        ('<joint name="finger_joint" type="revolute">', '<joint name="finger_joint" type="fixed">'),
    )
    assert main(["check", "--project", str(folder)]) == 2
    captured = capsys.readouterr()
    lines = [line for line in (captured.out + captured.err).splitlines() if "two_finger" in line]

    assert len([line for line in lines if "has 0 driven joints, a gripper has one" in line]) == 1
    assert lines[0].startswith("scenes/grippers/two_finger.yaml:3:14: error")


def test_check_names_a_link_that_meets_the_object_before_the_pads(project, tmp_path, capsys):
    folder = tmp_path / "project"
    shutil.copytree(project, folder)
    edit(
        folder / "scenes" / "kitchen.yaml",
        (r"box: \[40 mm, 50 mm, 40 mm\]", "box: [40 mm, 50 mm, 76 mm]"),
        (re.escape(f"  grasp: {FEW}\n"), ""),
    )
    main(["check", "--json", "--project", str(folder)])
    found = [one for one in json.loads(capsys.readouterr().out)["findings"] if one["rule"] == "scene.closing"]

    # The other hand, whose fingers slide, has no such link: what fails there is a result.
    assert [(one["severity"], one["hint"]) for one in found] == [
        ("info", "designs with this gripper fail there, and the others do not")
    ]
    pattern = (
        r"while the hand of scenes/grippers/two_finger.yaml closes on block, (left|right)_crank would be .* mm in it"
    )
    assert re.fullmatch(pattern, found[0]["message"])


def test_check_says_what_the_best_grasp_does_not_serve(project, tmp_path, capsys):
    folder = tmp_path / "project"
    shutil.copytree(project, folder)
    edit(
        folder / "scenes" / "robots" / "panda.yaml",
        (r"name: panda_joint4, range: \[[^]]*\]", "name: panda_joint4, range: [-0.4 rad, -0.3 rad]"),
        (r"home: \[(([^,]*,){3})[^,]*,", r"home: [0 deg, 0 deg, 0 deg, -20 deg,"),
    )
    assert main(["check", "--json", "--project", str(folder)]) == 1
    found = [one for one in json.loads(capsys.readouterr().out)["findings"] if one["rule"] == "scene.no-grasp"]

    assert found
    for one in found:
        assert "; the best one does not serve grasp_approach: " in one["message"]
        assert one["hint"].endswith(
            "; or let the task try more approaches, turn or move the object, or take another gripper"
        )
