"""Design spaces that choose the arm, and where it stands."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rgss.errors import DocumentError
from rgss.evidence import Fidelity
from rgss.findings import Severity
from rgss.guard.schema import record_schema
from rgss.studies import check_scene, draw_findings, named_inputs, object_limit_findings
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.robot_project import robot_findings
from rgss.studies.scaffolding import write_scaffold
from rgss.trials.pieces import run_trial, to_plain
from tests.fixtures.edited_files import edit

REPOSITORY = Path(__file__).parents[3]
SPACE, CATALOGUE, STUDY = "designs/design_space.yaml", "designs/catalogue.yaml", "studies/pick_place.yaml"
SCENE, MEASURES, OWN, OTHER = "scenes/kitchen.yaml", "requirements/measures.yaml", "ur10", "yumi_right_arm"
TWIN = "scenes/robots/twin.yaml"
ROBOT = f"scenes/robots/{OTHER}.yaml"
YUMI = f"""
  - id: yumi
    role: manipulator
    name: YuMi
    manufacturer: ABB
    geometry: {ROBOT}
    cost: {{value: 25000 USD, assumption: true, rationale: An arm of another size.}}
"""
PARAMETER = "  - {id: arm, name: arm, symbol: A, kind: name, sets: catalogue.manipulator, description: The arm.}\n"
FACTOR = "  - {id: arm, name: Arm, levels: [{id: own, sets: {arm: ur10}}, {id: other, sets: {arm: yumi}}]}\n"


@pytest.fixture
def single(tmp_path):
    """A new project, with the files of a second arm that nothing names."""
    folder = tmp_path / "single"
    write_scaffold(folder)
    for suffix in (".yaml", ".urdf"):
        shutil.copy(REPOSITORY / f"scenes/robots/{OTHER}{suffix}", folder / "scenes/robots")
    return folder


def choose(folder, component):
    """Let the designs choose between the project's own arm and a component."""
    edit(folder, CATALOGUE, "\n  - id: kg-2\n", f"{component}\n  - id: kg-2\n")
    edit(folder, SPACE, "\nconstants:\n", f"{PARAMETER}\nconstants:\n")
    edit(folder, SPACE, "factors:\n", f"factors:\n{FACTOR}")


@pytest.fixture
def both(single):
    """The project with the choice between its own arm and the second one."""
    choose(single, YUMI)
    return single


@pytest.fixture
def twin(single):
    """The project with the choice between its own arm and a copy of it, by which edits of the copy are compared."""
    shutil.copy(single / "scenes/robots/ur10.yaml", single / TWIN)
    edit(single, TWIN, "robot: ur10", "robot: twin")
    choose(single, YUMI.replace(ROBOT, TWIN))
    return single


@pytest.fixture
def slow_twin(twin):
    for line in (twin / TWIN).read_text(encoding="utf-8").splitlines():
        if "speed: " in line and "name:" in line:
            edit(twin, TWIN, line, re.sub(r"speed: [\d.]+ deg/s", "speed: 20 deg/s", line))
    return twin


@pytest.fixture
def narrow_twin(twin):
    """The copy does not turn its first joint to the place of the cup."""
    first = next(
        line for line in (twin / TWIN).read_text(encoding="utf-8").splitlines() if "shoulder_pan_joint" in line
    )
    edit(twin, TWIN, first, re.sub(r"range: \[[^]]*\]", "range: [-5 deg, 5 deg]", first))
    return twin


def placed(folder, *coordinates):
    """Add design parameters for coordinates of the base, by name and value."""
    for name, unit, value in coordinates:
        line = (
            f"  - {{id: b_{name}, name: b_{name}, symbol: b, unit: {unit}, sets: robot.base.{name}, description: X.}}\n"
        )
        edit(folder, SPACE, "\nconstants:\n", f"{line}\nconstants:\n")
        edit(folder, SPACE, "constants:\n", f"constants:\n  b_{name}: {value}\n")


def specs_of(folder):
    return trial_specs(load_project(folder), seeds=[1])


def inputs_of(spec):
    return named_inputs(spec).digest


def messages(findings):
    return [f"{one.severity.value}: {one.message} ({one.hint})" for one in findings]


def test_each_design_has_the_arm_of_its_component(both):
    specs = specs_of(both)
    assert [spec.scene.robot.id for spec in specs] == [OWN] * 4 + [OTHER] * 4
    assert {len(spec.scene.robot.joints) for spec in specs[4:]} == {7}
    assert len({spec.scene.robot.base for spec in specs}) == 1
    project = load_project(both)
    assert list(project.by_arm()) == ["", ROBOT]
    assert record_schema(project)["peak_joint_torque_n_m"].startswith("6 or 7 ×")


def test_a_trial_is_that_of_a_scene_which_names_the_arm(both, single, tmp_path):
    """The oracle: a project without a choice, whose scene has the other arm."""
    alone = tmp_path / "alone"
    write_scaffold(alone)
    for suffix in (".yaml", ".urdf"):
        shutil.copy(both / f"scenes/robots/{OTHER}{suffix}", alone / "scenes/robots")
    edit(alone, SCENE, "robots/ur10.yaml", f"robots/{OTHER}.yaml")
    assert [inputs_of(one) for one in specs_of(both)[4:]] == [inputs_of(one) for one in specs_of(alone)]


def test_a_trial_with_a_chosen_arm_is_carried_out(slow_twin):
    own, twin = (replace(spec, variant=0, fidelity=Fidelity.KINEMATIC) for spec in specs_of(slow_twin)[::4])
    edit(slow_twin, SCENE, "robots/ur10.yaml", "robots/twin.yaml")
    stated = replace(specs_of(slow_twin)[0], variant=0, fidelity=Fidelity.KINEMATIC)
    records = [run_trial(one) for one in (own, twin, stated)]
    assert all(record.success for record in records)
    assert to_plain(records[1]) == to_plain(records[2])
    assert records[1].metrics["task_time_s"] > records[0].metrics["task_time_s"]


def test_a_change_of_one_arm_concerns_its_designs_alone(both):
    before = specs_of(both)
    edit(both, ROBOT, "tool_acceleration: 2 m/s^2", "tool_acceleration: 1 m/s^2")
    changed = [inputs_of(one) != inputs_of(two) for one, two in zip(before, specs_of(both), strict=True)]
    assert changed == [False] * 4 + [True] * 4


def test_the_base_is_that_of_a_scene_which_states_it(both):
    stated = both.parent / "stated"
    shutil.copytree(both, stated)
    edit(stated, SCENE, "  base: [0 m, 0 m, ", "  base: [0.1 m, -0.05 m, ")
    edit(stated, SCENE, "  yaw: 180 deg", "  yaw: 30 deg")
    placed(both, ("x", "m", "0.1 m"), ("y", "m", "-50 mm"), ("yaw", "rad", "30 deg"))
    for one, two in zip(specs_of(both), specs_of(stated), strict=True):
        assert inputs_of(one) == inputs_of(two)


def test_a_base_as_in_the_scene_changes_nothing(both):
    before = specs_of(both)
    placed(both, ("x", "m", "0 m"), ("yaw", "rad", "180 deg"))
    assert [inputs_of(one) for one in specs_of(both)] == [inputs_of(one) for one in before]


def test_frames_of_the_robot_and_its_pedestal_move_with_the_base(both):
    edit(both, SCENE, "{id: pedestal,", "{id: pedestal, moves_with_robot: true,")
    frames = "frames: {camera: {parent: robot, position: [0.2 m, 0 m, 0.3 m]}, rack: {position: [1 m, 0 m, 0.5 m]}}\n"
    (both / SCENE).write_text((both / SCENE).read_text(encoding="utf-8") + frames, encoding="utf-8")
    still = specs_of(both)[0].scene
    placed(both, ("x", "m", "0.3 m"), ("z", "m", "0.7 m"), ("yaw", "rad", "90 deg"))
    moved = specs_of(both)[0].scene
    turn = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    base = np.array([0.3, 0.0, 0.7])
    camera, rack = ({one.id: one.pose for one in moved.frames}[name] for name in ("camera", "rack"))
    assert np.allclose(camera.position_m, base + turn @ [0.2, 0.0, 0.3])
    assert np.allclose(Rotation.from_quat(camera.quaternion_xyzw).as_matrix(), turn)
    assert rack == next(one.pose for one in still.frames if one.id == "rack")
    for before, after in zip(still.bodies, moved.bodies, strict=True):
        expected = np.array(before.pose.position_m)
        if before.id == "pedestal":
            expected = base + turn @ (expected - np.array(still.robot.base.position_m))
        assert np.allclose(after.pose.position_m, expected)
        assert (after.pose == before.pose) is (before.id != "pedestal")


def test_what_one_arm_reaches_and_another_does_not_is_a_note(narrow_twin):
    project = load_project(narrow_twin)
    found = [one for one in check_scene(project).findings if one.rule == "scene.unserved"]
    assert found
    assert {one.severity for one in found} == {Severity.INFO}
    assert all(f" on {TWIN}" in one.message and "on the robot" not in one.message for one in found)
    assert {one.hint for one in found} == {"designs with this arm fail there, and those with another do not"}


def test_what_no_arm_reaches_is_an_error(narrow_twin):
    edit(narrow_twin, SCENE, "at: [-0.25 m, 0.70 m]", "at: [-0.85 m, 1.0 m]")
    edit(narrow_twin, SCENE, "  base: [0 m, 0 m, ", "  base: [0.5 m, -0.5 m, ")
    found = [one for one in check_scene(load_project(narrow_twin)).findings if one.rule == "scene.unserved"]
    assert Severity.ERROR in {one.severity for one in found}


def test_arms_at_several_bases_are_named_by_them(single):
    line = "  - {id: b_x, name: b_x, symbol: b, unit: m, sets: robot.base.x, description: X.}\n"
    edit(single, SPACE, "\nconstants:\n", f"{line}\nconstants:\n")
    levels = ", ".join(f"{{id: l{index}, sets: {{b_x: {x} m}}}}" for index, x in enumerate((0, -3)))
    edit(single, SPACE, "factors:\n", f"factors:\n  - {{id: base, name: Base, levels: [{levels}]}}\n")
    found = [one for one in check_scene(load_project(single)).findings if one.rule == "scene.unserved"]
    assert found
    assert all("on the robot of kitchen.yaml at (-3, 0, " in one.message for one in found)


@pytest.mark.parametrize("moves", [True, False])
def test_a_body_is_checked_where_designs_place_it(single, moves):
    edit(single, SCENE, "{id: machine,", f"{{id: machine, moves_with_robot: {str(moves).lower()},")
    placed(single, ("y", "m", "-0.96 m"))
    found = [one.message for one in check_scene(load_project(single)).findings if one.rule == "scene.object-overlap"]
    assert any("cup overlaps machine" in one for one in found) is moves


def test_of_many_bases_an_even_selection_is_checked(single):
    line = "  - {id: b_x, name: b_x, symbol: b, unit: m, sets: robot.base.x, description: X.}\n"
    edit(single, SPACE, "\nconstants:\n", f"{line}\nconstants:\n")
    factor = "  - {id: base, name: Base, parameter: b_x, range: [-0.02 m, 0.02 m], resolution: 1 mm}\n"
    edit(single, SPACE, "factors:\n", f"factors:\n{factor}")
    sample = "\nsample: {method: sobol, size: 32, seed: 1}\n"
    (single / SPACE).write_text((single / SPACE).read_text(encoding="utf-8") + sample, encoding="utf-8")
    checked = check_scene(load_project(single))
    assert checked.skipped.startswith("the scene is checked with 24 of the ")
    assert checked.skipped.endswith(" grippers on arms at their bases")


def test_a_payload_that_one_arm_lacks_is_a_note(both):
    edit(both, SCENE, "mass: 0.25 kg", "mass: 0.6 kg")
    limits = [one for one in object_limit_findings(load_project(both)) if one.rule == "scene.payload"]
    assert messages(limits) == [
        f"info: cup of 0.6 kg exceeds the payload of {OTHER}, 0.5 kg (designs with another arm take it)"
    ]


def test_an_offset_of_a_joint_that_no_arm_has_is_warned_of(both):
    (both / STUDY).write_text(
        (both / STUDY).read_text(encoding="utf-8")
        + "uncertainty: {robot.slide_offset: {uniform: {low: 0 mm, high: 1 mm}, rationale: X.}}\n",
        encoding="utf-8",
    )
    found = [one for one in draw_findings(load_project(both)) if one.rule == "uncertainty.no-joint"]
    assert [one.message for one in found] == ["robot.slide_offset has no effect: no arm has a sliding joint"]


def test_the_descriptions_of_both_arms_are_looked_at(both):
    edit(both, f"scenes/robots/{OTHER}.urdf", '<mass value="2.2', '<mass value="9992.2')
    edit(both, "scenes/robots/ur10.urdf", '<mass value="', '<mass value="9999')
    found = {(one.file, one.rule) for one in robot_findings(load_project(both))}
    assert ("scenes/robots/ur10.urdf", "robot.units") in found
    assert (f"scenes/robots/{OTHER}.urdf", "robot.units") in found


ROW = "  - {id: dtau, source: trial.peak_joint_torques, unit: N*m, length: 6, definition: X., meaning: X.}\n"


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (CATALOGUE, f"geometry: {ROBOT}", "geometry: scenes/robots/none.yaml", "there is no file 'scenes/robots/none"),
        (ROBOT, "payload: 0.5 kg", "payload: -1 kg", f"{ROBOT}:14:10: error: payload must be greater than zero"),
        (CATALOGUE, f"geometry: {ROBOT}", "geometry: scenes/kitchen.yaml", "scenes/kitchen.yaml:4:1: error: unknown"),
        (
            STUDY,
            "planning:\n",
            "control: {joints: {elbow: {position_gain: 5 rad/s}}}\nplanning:\n",
            "no robot has a joint",
        ),
        (SPACE, "    sets: robot.tool_speed\n", "", f"nothing sets robot.tool_speed of {OTHER} (add 'sets: "),
        (
            SCENE,
            "{id: counter,",
            "{id: counter, moves_with_robot: true,",
            "counter moves with the robot, and",
        ),
    ],
)
def test_what_is_wrong_of_one_arm_is_reported(both, file, old, new, expected):
    edit(both, "scenes/robots/ur10.yaml", "payload: 10 kg", "payload: 10 kg\ntool_speed: 0.7 m/s")
    edit(both, file, old, new)
    with pytest.raises(DocumentError) as caught:
        load_project(both)
    assert [one for one in map(str, caught.value.findings) if expected in one], list(map(str, caught.value.findings))


def test_a_row_of_joints_is_refused_where_arms_have_different_numbers_of_them(both):
    text = (both / MEASURES).read_text(encoding="utf-8")
    row = "  - {id: taus, source: trial.peak_joint_torque_n_m, unit: N*m, length: 6, definition: X.}\n"
    (both / MEASURES).write_text(text.replace("inputs:\n", f"inputs:\n{row}", 1), encoding="utf-8")
    with pytest.raises(DocumentError) as caught:
        load_project(both)
    assert any(
        "'trial.peak_joint_torque_n_m' is a row of 6 or 7 (take a metric of the whole arm" in str(one)
        for one in caught.value.findings
    ), caught.value.findings


def test_a_configuration_of_another_number_of_joints_names_the_arm(both):
    task = {
        "scenes/tasks/own.yaml": "task: own\nconfigurations: {up: [0 deg, -90 deg, 0 deg, 0 deg, 0 deg, 0 deg]}\n"
        "steps: [{move: {configuration: up}}]\n"
    }
    for name, text in task.items():
        (both / name).parent.mkdir(exist_ok=True)
        (both / name).write_text(text, encoding="utf-8")
    edit(both, STUDY, "scene: scenes/kitchen.yaml\n", "scene: scenes/kitchen.yaml\ntask: scenes/tasks/own.yaml\n")
    with pytest.raises(DocumentError) as caught:
        load_project(both)
    assert any(f"'up' has 6 joints, the robot {OTHER} has 7" in str(one) for one in caught.value.findings)
