"""Which input belongs to which piece of a trial."""

from __future__ import annotations

import dataclasses
import json
import re
import subprocess
import sys
from dataclasses import replace

import pytest

from rgss.evidence import Fidelity, PieceKind
from rgss.motion import ClockKind, Objective, PlanningClock
from rgss.scenes import Calibration, Pose, ServoControl
from rgss.studies.expansion import trial_specs
from rgss.trials import JointController, JointGains, TimingProfile, TimingSettings
from rgss.trials.code.piece_versions import ENGINES, ENTRIES, versions
from rgss.trials.pieces import input_digests
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.plants import ControlMode
from rgss.trials.plants.control import ControlSettings
from tests.fixtures.perturbation import digests_anew, paths_of, perturbed

PLANNED = {"plan", "timing", "execution", "trial"}
LATER = PLANNED - {"plan"}
LAST = {"execution", "trial"}
GRIPPED = {"execution", "bench", "trial"}
ALL = PLANNED | {"bench"}
VERSIONS = {"pybullet": "3.2.7", "ompl": "1.7.0", "toppra": "0.6.10", **{f"rgss-{name}": "a" for name in ENTRIES}}


def changed(spec, other):
    before, after = (digests_of(each, VERSIONS).as_mapping() for each in (spec, other))
    return {name for name in before if before[name] != after[name]}


def with_scene(spec, **changes):
    return replace(spec, scene=replace(spec.scene, **changes))


def with_workpiece(spec, **changes):
    return with_scene(spec, workpiece=replace(spec.scene.workpiece, **changes))


def with_body(spec, **changes):
    first, *others = spec.scene.bodies
    return with_scene(spec, bodies=(replace(first, **changes), *others))


def with_joint(spec, **changes):
    first, *others = spec.scene.robot.joints
    return with_scene(spec, robot=replace(spec.scene.robot, joints=(replace(first, **changes), *others)))


def with_gripper(spec, **changes):
    return replace(spec, gripper=replace(spec.gripper, **changes))


def with_planner(spec, **changes):
    return replace(spec, planner_settings=replace(spec.planned_by, **changes))


def with_settings(spec, part, **changes):
    return replace(spec, settings=replace(spec.settings, **{part: replace(getattr(spec.settings, part), **changes)}))


CHANGES = {
    "variant": (set(), lambda spec: replace(spec, variant=1)),
    "name of the scene": (set(), lambda spec: with_scene(spec, id="lab")),
    # Details of failures contain it.
    "name of the gripper": (
        PLANNED,
        lambda spec: with_gripper(spec, geometry=replace(spec.gripper.geometry, id="another")),
    ),
    "colour of a body": (set(), lambda spec: with_body(spec, colour=(0.0, 0.0, 0.0, 1.0))),
    "colour of the workpiece": (set(), lambda spec: with_workpiece(spec, colour=(0.0, 0.0, 0.0, 1.0))),
    "planning limit": ({"trial"}, lambda spec: replace(spec, planning_limit_s=3.0)),
    "mass of the workpiece": (LAST, lambda spec: with_workpiece(spec, mass_kg=0.3)),
    "friction of a body": (LAST, lambda spec: with_body(spec, friction=0.3)),
    "friction of the workpiece": (GRIPPED, lambda spec: with_workpiece(spec, friction=0.9)),
    "force that the workpiece bears": (GRIPPED, lambda spec: with_workpiece(spec, force_limit_n=39.0)),
    "window of that force": (GRIPPED, lambda spec: with_workpiece(spec, force_window_s=0.02)),
    "landing that the workpiece bears": (LAST, lambda spec: with_workpiece(spec, landing_limit_m_s=0.9)),
    "gravity": (GRIPPED, lambda spec: with_scene(spec, gravity_m_s2=1.62)),
    "finger mass": (GRIPPED, lambda spec: with_gripper(spec, finger_mass_kg=0.25)),
    "base mass": (GRIPPED, lambda spec: with_gripper(spec, base_mass_kg=0.25)),
    "finger velocity": (GRIPPED, lambda spec: with_gripper(spec, finger_velocity_m_s=0.03)),
    "finger force": (GRIPPED, lambda spec: with_gripper(spec, finger_force_n=9.0)),
    "pad friction": (GRIPPED, lambda spec: with_gripper(spec, friction=0.6)),
    "physics rate": (GRIPPED, lambda spec: with_settings(spec, "physics", rate_hz=480.0)),
    "solver iterations": (GRIPPED, lambda spec: with_settings(spec, "physics", solver_iterations=51)),
    "tool speed": (LATER, lambda spec: replace(spec, tool_speed_m_s=0.7)),
    "name of the planner": (set(), lambda spec: replace(spec, planner="quick")),
    "planner": (PLANNED, lambda spec: with_planner(spec, algorithm="STRIDE")),
    "parameter of the planner": (PLANNED, lambda spec: with_planner(spec, parameters=(("range", 0.3),))),
    "objective of the planner": (PLANNED, lambda spec: with_planner(spec, objective=Objective.CLEARANCE)),
    "seed": (PLANNED, lambda spec: replace(spec, seed=2)),
    "gripper's shape": (
        ALL,
        lambda spec: with_gripper(spec, geometry=replace(spec.gripper.geometry, grasp_depth_m=0.14)),
    ),
    "pose of a body": (PLANNED, lambda spec: with_body(spec, pose=Pose(position_m=(0.0, 0.0, -0.02)))),
    "pose of the workpiece": (PLANNED, lambda spec: with_workpiece(spec, pose=spec.scene.workpiece.pose.raised(0.001))),
    "place": (PLANNED, lambda spec: with_scene(spec, place=replace(spec.scene.place, centre_m=(-0.25, 0.71, 0.9)))),
    "task": (PLANNED, lambda spec: with_scene(spec, task=replace(spec.scene.task, lift_height_m=0.07))),
    "rated payload": (
        {"bench", "trial"},
        lambda spec: with_scene(spec, robot=replace(spec.scene.robot, payload_kg=9.0)),
    ),
    "acceleration of the tool": (
        LATER | {"bench"},
        lambda spec: with_scene(spec, robot=replace(spec.scene.robot, tool_acceleration_m_s2=1.3)),
    ),
    "range of a joint": (PLANNED, lambda spec: with_joint(spec, lower_rad=-2.0)),
    "speed of a joint": (LATER, lambda spec: with_joint(spec, speed_rad_s=2.0)),
    "acceleration of a joint": (LATER, lambda spec: with_joint(spec, acceleration_rad_s2=2.0)),
    "torque of a joint": (LAST, lambda spec: with_joint(spec, torque_n_m=300.0)),
    "clearance": (PLANNED, lambda spec: with_settings(spec, "planning", clearance_m=0.009)),
    "search limit": (PLANNED, lambda spec: with_settings(spec, "planning", search_limit_s=9.0)),
    "planning clock": (
        PLANNED,
        lambda spec: with_settings(spec, "planning", clock=PlanningClock(kind=ClockKind.WALL)),
    ),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_reaches_exactly_the_pieces_that_it_matters_to(spec_of, name):
    expected, change = CHANGES[name]

    assert changed(spec_of(), change(spec_of())) == expected


@pytest.mark.parametrize("name", [field.name for field in dataclasses.fields(ControlSettings)])
def test_every_threshold_is_an_input_of_the_execution(spec_of, name):
    spec = spec_of()

    assert changed(spec, with_settings(spec, "control", **{name: getattr(spec.settings.control, name) * 1.5})) == LAST


MOTION = [
    ("timing", {"profile": TimingProfile.TRAPEZOID}, LATER),
    ("timing", {"peak_speed": 0.5}, LATER),
    ("timing", {"peak_acceleration": 0.5}, LATER),
    ("timing", {"joint_speeds_rad_s": (("elbow_joint", 1.0),)}, LATER),
    ("timing", {"joint_accelerations_rad_s2": (("elbow_joint", 1.0),)}, LATER),
    ("controller", {"mode": ControlMode.VELOCITY}, LAST),
    ("controller", {"natural_frequency_rad_s": 30.0}, LAST),
    ("controller", {"damping_ratio": 0.7}, LAST),
    ("controller", {"position_gain_1_s": 1.0}, LAST),
    ("controller", {"velocity_gain_1_s": 1.0}, LAST),
    ("controller", {"joints": (JointGains(joint="elbow_joint", damping_ratio=0.7),)}, LAST),
    ("controller", {"reached_rad": 0.01}, LAST),
    ("controller", {"settling_limit_s": 1.0}, LAST),
    ("controller", {"in_contact": True}, LAST),
    ("controller", {"calibration": Calibration(robot="r", control=ServoControl.VELOCITY, servos=())}, LAST),
]


@pytest.mark.parametrize(("part", "changes", "expected"), MOTION)
def test_timing_and_controller_are_inputs_where_they_are_used(spec_of, part, changes, expected):
    for fidelity in Fidelity:
        spec = replace(spec_of(), fidelity=fidelity)
        acts_in_contact = "in_contact" in changes and fidelity is Fidelity.CONTACT
        is_used = part == "timing" or fidelity is Fidelity.DYNAMIC or acts_in_contact
        assert changed(spec, with_settings(spec, part, **changes)) == (expected if is_used else set())


def test_every_setting_of_timing_and_controller_is_tried():
    tried = {(part, name) for part, changes, _ in MOTION for name in changes}
    kinds = {"timing": TimingSettings, "controller": JointController}
    assert tried == {(part, field.name) for part, kind in kinds.items() for field in dataclasses.fields(kind)}


def test_default_timing_and_controller_add_no_input(spec_of, monkeypatch):
    """The digests of trials without these settings are those of before there were any."""
    joined = []
    versions = {**VERSIONS, "rgss": "of this test"}  # digests are kept
    monkeypatch.setattr(input_digests, "_joined", lambda *inputs: joined.append(inputs) or str(len(joined)))
    spec = replace(spec_of(), fidelity=Fidelity.DYNAMIC)
    digests_of(spec, versions)
    assert [len(inputs) for inputs in joined] == [8, 4, 8]
    joined.clear()
    digests_of(with_settings(with_settings(spec, "timing", peak_speed=0.5), "controller", damping_ratio=0.5), versions)
    assert [len(inputs) for inputs in joined] == [8, 5, 9]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("ompl", PLANNED),
        ("toppra", LATER),
        ("pybullet", GRIPPED),
        ("rgss-plan", PLANNED),
        ("rgss-timing", LATER),
        ("rgss-execution", LAST),
        ("rgss-bench", {"bench", "trial"}),
        ("rgss-record", {"trial"}),
    ],
)
def test_a_version_is_an_input_of_the_pieces_that_it_makes_and_of_those_after_them(spec_of, name, expected):
    before = digests_of(spec_of(), VERSIONS).as_mapping()
    after = digests_of(spec_of(), {**VERSIONS, name: "another"}).as_mapping()

    assert {name for name in before if before[name] != after[name]} == expected


@pytest.mark.parametrize("fidelity", [Fidelity.KINEMATIC, Fidelity.DYNAMIC])
def test_only_contact_knows_a_bench(spec_of, fidelity):
    spec = spec_of()
    other = digests_of(replace(spec, fidelity=fidelity), VERSIONS)

    assert other.bench == ""
    assert other.as_mapping().keys() == PLANNED
    assert digests_of(spec, VERSIONS).as_mapping().keys() == ALL
    assert (other.plan, other.timing) == (digests_of(spec, VERSIONS).plan, digests_of(spec, VERSIONS).timing)
    assert other.execution != digests_of(spec, VERSIONS).execution


def test_everything_in_a_scene_but_its_name_and_its_colours_is_an_input(spec_of):
    spec = spec_of()
    before = digests_anew(spec, VERSIONS).trial
    missed = [
        path
        for path in paths_of(spec.scene)
        if digests_anew(replace(spec, scene=perturbed(spec.scene, {path})), VERSIONS).trial == before
    ]

    # Of a body that moves with the robot, its pose where a design has placed it is the input.
    names = {re.sub(r"\[\d+\]$", "", path).rsplit(".", 1)[-1] for path in missed}
    assert names == {"colour", "id", "moves_with_robot"}
    assert len(missed) == 5 * len(spec.scene.bodies) + 4 + len(["scene.id"])


def test_72_variants_and_a_seed_need_6_plans_12_timings_24_executions_and_4_benches(project):
    digests = [digests_of(spec, VERSIONS) for spec in trial_specs(project, seeds=[1])]
    counts = {name: len({each.as_mapping()[name] for each in digests}) for name in digests[0].as_mapping()}

    assert counts == {"plan": 6, "timing": 12, "execution": 24, "bench": 4, "trial": 72}


def test_seeds_share_benches_and_nothing_else(project):
    one, two = (
        [digests_of(spec, VERSIONS).as_mapping() for spec in trial_specs(project, seeds=[seed])] for seed in (1, 2)
    )

    for name in ALL:
        shared = {each[name] for each in one} & {each[name] for each in two}
        assert len(shared) == (4 if name == "bench" else 0)


def test_versions_name_the_engines_and_the_source_of_each_piece():
    found = versions()
    engines = {name for names in ENGINES.values() for name in names}

    assert set(found) == {*engines, "rgss-record", *(f"rgss-{kind.value}" for kind in PieceKind)}
    assert all(re.fullmatch("[0-9a-f]{64}", found[name]) for name in found if name.startswith("rgss-"))
    assert all(re.match(r"\d+\.", found[engine]) for engine in engines)


def test_another_process_finds_the_same_versions():
    script = "import json; from rgss.trials.code.piece_versions import versions; print(json.dumps(versions()))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)

    assert run.stdout.strip() == json.dumps(versions())
