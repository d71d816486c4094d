"""Which input belongs to which piece of a trial."""

from __future__ import annotations

import dataclasses
import json
import re
import subprocess
import sys
from dataclasses import replace

import pytest

from rgss.evidence import Fidelity
from rgss.motion import ClockKind, PlanningClock
from rgss.scenes import Pose
from rgss.studies.expansion import trial_specs
from rgss.trials.control import ControlSettings
from rgss.trials.spec import digests_of
from rgss.trials.versions import ENGINES, versions

ALL = {"plan", "timing", "execution", "trial"}
LATER = ALL - {"plan"}
LAST = {"execution", "trial"}
VERSIONS = {"pybullet": "3.2.7"}


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


def with_gripper(spec, **changes):
    return replace(spec, gripper=replace(spec.gripper, **changes))


def with_settings(spec, part, **changes):
    return replace(spec, settings=replace(spec.settings, **{part: replace(getattr(spec.settings, part), **changes)}))


CHANGES = {
    "variant": (set(), lambda spec: replace(spec, variant=1)),
    "colour of a body": (set(), lambda spec: with_body(spec, colour=(0.0, 0.0, 0.0, 1.0))),
    "colour of the workpiece": (set(), lambda spec: with_workpiece(spec, colour=(0.0, 0.0, 0.0, 1.0))),
    "planning limit": ({"trial"}, lambda spec: replace(spec, planning_limit_s=3.0)),
    "finger mass": (LAST, lambda spec: with_gripper(spec, finger_mass_kg=0.25)),
    "base mass": (LAST, lambda spec: with_gripper(spec, base_mass_kg=0.25)),
    "finger velocity": (LAST, lambda spec: with_gripper(spec, finger_velocity_m_s=0.03)),
    "finger force": (LAST, lambda spec: with_gripper(spec, finger_force_n=9.0)),
    "pad friction": (LAST, lambda spec: with_gripper(spec, friction=0.6)),
    "fidelity": (LAST, lambda spec: replace(spec, fidelity=Fidelity.KINEMATIC)),
    "physics rate": (LAST, lambda spec: with_settings(spec, "physics", rate_hz=480.0)),
    "solver iterations": (LAST, lambda spec: with_settings(spec, "physics", solver_iterations=51)),
    "tool speed": (LATER, lambda spec: replace(spec, tool_speed_m_s=0.7)),
    "planner": (ALL, lambda spec: replace(spec, planner="STRIDE")),
    "seed": (ALL, lambda spec: replace(spec, seed=2)),
    "gripper's shape": (
        ALL,
        lambda spec: with_gripper(spec, geometry=replace(spec.gripper.geometry, grasp_depth_m=0.14)),
    ),
    "pose of a body": (ALL, lambda spec: with_body(spec, pose=Pose(position_m=(0.0, 0.0, -0.02)))),
    "pose of the workpiece": (ALL, lambda spec: with_workpiece(spec, pose=spec.scene.workpiece.pose.raised(0.001))),
    "place": (ALL, lambda spec: with_scene(spec, place=replace(spec.scene.place, centre_m=(-0.25, 0.71, 0.9)))),
    "task": (ALL, lambda spec: with_scene(spec, task=replace(spec.scene.task, lift_height_m=0.07))),
    "clearance": (ALL, lambda spec: with_settings(spec, "planning", clearance_m=0.009)),
    "search limit": (ALL, lambda spec: with_settings(spec, "planning", search_limit_s=9.0)),
    "planning clock": (
        ALL,
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


def test_the_versions_are_inputs_of_every_piece(spec_of):
    before = digests_of(spec_of(), VERSIONS).as_mapping()
    after = digests_of(spec_of(), {"pybullet": "3.2.8"}).as_mapping()

    assert {name for name in before if before[name] != after[name]} == ALL


def test_everything_in_a_scene_but_its_colours_is_an_input(spec_of):
    spec = spec_of()
    missed = [
        path for path, scene in perturbed(spec.scene) if not changed(spec, replace(spec, scene=scene)) & {"trial"}
    ]

    assert {path.rsplit(".", 1)[-1] for path in missed} == {"colour"}
    assert len(missed) == 4 * (len(spec.scene.bodies) + 1)


def perturbed(value, path="scene"):
    """Every copy of a value in which one number or text somewhere in it is another."""
    if dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            for inner, other in perturbed(getattr(value, field.name), f"{path}.{field.name}"):
                yield inner, replace(value, **{field.name: other})
    elif isinstance(value, tuple):
        for index, item in enumerate(value):
            for inner, other in perturbed(item, path):
                yield inner, (*value[:index], other, *value[index + 1 :])
    elif isinstance(value, str):
        yield path, value + "x"
    else:
        yield path, value + 0.001


def test_72_variants_and_a_seed_need_6_plans_12_timings_and_24_executions(project):
    digests = [digests_of(spec, VERSIONS) for spec in trial_specs(project, seeds=[1])]

    assert [len({getattr(each, name) for each in digests}) for name in ("plan", "timing", "execution", "trial")] == [
        6,
        12,
        24,
        72,
    ]


def test_versions_name_the_engines_and_the_source():
    found = versions()

    assert set(found) == {*ENGINES, "rgss-source"}
    assert re.fullmatch("[0-9a-f]{64}", found["rgss-source"])
    assert all(re.match(r"\d+\.", found[engine]) for engine in ENGINES)


def test_another_process_finds_the_same_versions():
    script = "import json; from rgss.trials.versions import versions; print(json.dumps(versions()))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)

    assert run.stdout.strip() == json.dumps(versions())
