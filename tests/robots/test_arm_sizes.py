"""Projects round small and large arms of few and of many joints: hands, object and tables have the arm's size."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
import yaml

from rgss.cli.main import main
from rgss.studies.robot_project import write_robot_project
from rgss.studies.robot_project.draft import drafted_robot
from rgss.studies.robot_project.hand_size import HandSize, hand_sizes, moving_mass_kg
from rgss.studies.robot_project.layout import Layout, layouts, raised_layout
from rgss.studies.scaffolding import scaffold_texts
from tests.fixtures.serial_arms import FIVE, SEVEN, serial_urdf

# Waist, shoulder, elbow and wrist, with the flange ahead of the wrist: the tool is pitched, not turned.
FOUR = (FIVE[0], FIVE[1], FIVE[2], replace(FIVE[3], axis="0 1 0"))
# An arm whose first joint turns to one side alone.
SIDEWAYS = (replace(FIVE[0], range=(0.3, 2.9)), *FIVE[1:])


def scaled(links, scale):
    """An arm with all lengths scaled."""
    return tuple(replace(link, xyz=tuple(scale * value for value in link.xyz)) for link in links)


def mass_scaled(urdf, scale):
    """A URDF with the masses of a similar arm, which its efforts hold."""
    return urdf.replace('mass value="1"', f'mass value="{min(1.0, scale**3):g}"')


@pytest.mark.parametrize(
    ("links", "scale"),
    [(FOUR, 0.2), (FOUR, 1.0), (FIVE, 0.25), (SIDEWAYS, 1.0), (SEVEN, 0.3), (SEVEN, 3.0)],
    ids=["four small", "four", "five small", "sideways", "seven small", "seven large"],
)
def test_arms_of_any_size_carry_an_object(tmp_path, capsys, links, scale):
    urdf, project = tmp_path / "arm.urdf", tmp_path / "project"
    urdf.write_text(mass_scaled(serial_urdf(scaled(links, scale)), scale), encoding="utf-8")
    assert main(["init", "--robot", str(urdf), str(project)]) == 0
    capsys.readouterr()
    main(["check", "--json", "--project", str(project)])
    findings = json.loads(capsys.readouterr().out)["findings"]
    assert [one for one in findings if one["severity"] == "error" or one["rule"].startswith("scene.")] == []
    assert main(["run", "1", "--fidelity", "kinematic", "--json", "--project", str(project)]) == 0
    assert json.loads(capsys.readouterr().out)["success"] is True


def test_the_hand_of_a_small_arm_is_small_with_its_object_masses_and_forces(tmp_path):
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(mass_scaled(serial_urdf(scaled(FIVE, 0.2)), 0.2), encoding="utf-8")
    write_robot_project(urdf, tmp_path / "project")
    scene = yaml.safe_load((tmp_path / "project/scenes/kitchen.yaml").read_text(encoding="utf-8"))
    hand = yaml.safe_load((tmp_path / "project/scenes/grippers/kg-2.yaml").read_text(encoding="utf-8"))
    scale = float(hand["grasp_depth"].split()[0]) / 145

    assert scale < 0.7
    assert float(scene["workpiece"]["radius"].split()[0]) == pytest.approx(35 * scale, rel=1e-3)
    assert float(scene["workpiece"]["mass"].split()[0]) == pytest.approx(0.25 * scale**3, rel=0.01)


def test_a_light_arm_carries_a_light_hand(tmp_path):
    """Five links of 100 g each, which bear 2 kg by their efforts."""
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(serial_urdf(FIVE).replace('mass value="1"', 'mass value="0.1"'), encoding="utf-8")
    robot = drafted_robot(urdf, tmp_path / "project").robot

    assert moving_mass_kg(robot) == pytest.approx(0.5)
    assert [size.scale for size in hand_sizes(robot)] == [0.5, 0.25]


def test_quantities_of_a_smaller_hand_are_those_of_similarity():
    texts, half = scaffold_texts(), HandSize(scale=0.5)
    changed = {name: half.fitted_text(name, text) for name, text in texts.items()}

    assert "grasp_depth: 72.5 mm" in changed["scenes/grippers/kg-2.yaml"]
    assert "at 0.02 m/s" in changed["scenes/grippers/kg-2.yaml"]
    for line in ("finger_mass: 0.025 kg", "finger_speed: 0.02 m/s", "finger_force: 2.5 N", "{tool_speed: 0.25 m/s}"):
        assert line in changed["designs/design_space.yaml"]
    assert "force: {value: 3.75 N" in changed["designs/catalogue.yaml"]
    assert "threshold: 0.125 kg" in changed["requirements/system.yaml"]
    assert "worst: 0.125 kg, best: 0.375 kg" in changed["studies/pick_place.yaml"]
    assert "clearance: 4 mm" in changed["studies/pick_place.yaml"]
    assert {name for name, text in texts.items() if HandSize().fitted_text(name, text) != text} == set()


@pytest.mark.parametrize("reach_m", [0.15, 0.25, 0.8, 3.0])
def test_tables_bear_the_object_and_leave_a_gap_between_them(reach_m):
    scale = min(1.0, reach_m / 0.6)
    found = list(layouts(reach_m, scale=scale))

    assert found
    for one in found:
        assert one.length_m < 2 * one.y_m
        assert min(one.length_m, one.depth_m) >= 0.07 * scale
        assert one.x_m - one.depth_m / 2 > 0.0


def test_a_table_below_the_floor_lifts_the_pedestal():
    low = Layout(reach_m=2.0, x_m=0.8, y_m=0.5, table_m=-0.25)

    lifted = raised_layout(low)
    assert (lifted.table_m, lifted.base_m) == (0.1, (0.0, 0.0, 0.95))
    assert raised_layout(lifted) == lifted
