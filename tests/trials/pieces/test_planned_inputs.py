"""A plan is made anew by everything that planning reads, and by nothing else that a scene or a task has."""

from __future__ import annotations

import re
from dataclasses import fields, replace

import pytest

from rgss.evidence import Fidelity
from rgss.motion import Objective
from rgss.scenes import JointKind, NamedFrame, Pose
from rgss.scenes.robot import RobotFile
from rgss.tasks import (
    CheckStep,
    GripStep,
    MoveKind,
    MoveStep,
    Nearness,
    NeutralStep,
    ReleaseStep,
    StepControl,
    Target,
    WaitStep,
)
from rgss.trials.code.piece_versions import ENTRIES
from rgss.trials.pieces.input_digests import digests_of
from rgss.trials.pieces.pieces import make_plan
from tests.trials.hands.gripper_files import gripper_of

VERSIONS = {"pybullet": "3.2.7", "ompl": "1.7.0", "toppra": "0.6.10", **{f"rgss-{name}": "a" for name in ENTRIES}}
PLANNED = {"plan", "timing", "execution", "trial"}
LATER = PLANNED - {"plan"}
LAST = {"execution", "trial"}
TRAY = NamedFrame(id="tray", pose=Pose(position_m=(0.5, 0.1, 1.0), quaternion_xyzw=(1.0, 0.0, 0.0, 0.0)))


def changed(spec, other):
    before, after = (digests_of(each, VERSIONS).as_mapping() for each in (spec, other))
    return {name for name in before if before[name] != after[name]}


def with_gripper(spec, **changes):
    return replace(spec, gripper=replace(spec.gripper, **changes))


def with_robot(spec, **changes):
    return replace(spec, scene=replace(spec.scene, robot=replace(spec.scene.robot, **changes)))


def with_description(spec, pattern, text):
    urdf, count = re.subn(pattern, text, spec.scene.robot.urdf, count=1)
    assert count == 1
    return with_robot(spec, urdf=urdf)


def with_step(spec, step):
    """The step after those of the task."""
    return replace(spec, task=replace(spec.task, steps=(*spec.task.steps, step)))


def with_move(spec, **changes):
    """The first move of the task with other settings."""
    first, *others = spec.task.steps
    return replace(spec, task=replace(spec.task, steps=(replace(first, **changes), *others)))


def heavier(spec):
    return with_description(spec, r'(<mass value=")[\d.]+(" */>)', r"\g<1>9.5\g<2>")


def to_tray(spec, pose=TRAY.pose):
    """A task that moves to a named frame at last."""
    scene = replace(spec.scene, frames=(replace(TRAY, pose=pose), replace(TRAY, id="other")))
    return with_step(replace(spec, scene=scene), MoveStep(name="away", target=Target(name="tray", frame="tray")))


DESCRIPTIONS = {
    "mass of a link": (LAST, heavier),
    "inertia of a link": (LAST, lambda spec: with_description(spec, r'(ixx=")[^"]+(")', r"\g<1>0.123\g<2>")),
    "centre of mass of a link": (
        LAST,
        lambda spec: with_description(spec, r"(<inertial>\s*<origin [^>]*xyz=\")[^\"]+", r"\g<1>0.01 0.02 0.03"),
    ),
    "comment": (LAST, lambda spec: with_description(spec, "</robot>", "<!-- of 2026 --></robot>")),
    "content of a mesh, of which the description has the shapes": (
        LAST,
        lambda spec: with_robot(spec, files=(RobotFile(name="meshes/part.stl", sha256="a" * 64),)),
    ),
    "place of a joint": (
        PLANNED,
        lambda spec: with_description(spec, r'(<joint (?s:.)*?<origin xyz=")[^"]+', r"\g<1>0.001 0 0.1"),
    ),
    "axis of a joint": (PLANNED, lambda spec: with_description(spec, r'(<axis xyz=")[^"]+', r"\g<1>0 0.6 0.8")),
    "collision shape": (
        PLANNED,
        lambda spec: with_description(spec, r'(<collision>(?s:.)*?radius=")[^"]+', r"\g<1>0.0123"),
    ),
    "flange": (PLANNED, lambda spec: with_robot(spec, flange="forearm_link")),
    "base": (PLANNED, lambda spec: with_robot(spec, base=spec.scene.robot.base.raised(0.01))),
    "home, which decides between configurations": (
        PLANNED,
        lambda spec: with_robot(spec, home_rad=(0.1, *spec.scene.robot.home_rad[1:])),
    ),
    "frame to which no step moves": (set(), lambda spec: replace(spec, scene=replace(spec.scene, frames=(TRAY,)))),
}


@pytest.mark.parametrize("name", DESCRIPTIONS)
def test_a_change_reaches_exactly_the_pieces_that_read_it(spec_of, name):
    expected, change = DESCRIPTIONS[name]

    assert changed(spec_of(), change(spec_of())) == expected


def test_a_planner_by_mechanical_work_reads_the_masses_of_the_links(spec_of):
    by_work = replace(spec_of(), planner_settings=replace(spec_of().planned_by, objective=Objective.MECHANICAL_WORK))

    assert changed(by_work, heavier(by_work)) == PLANNED


def test_a_frame_is_an_input_of_the_plans_that_move_to_it(spec_of):
    spec = to_tray(spec_of())
    others = (spec.scene.frames[0], replace(spec.scene.frames[1], pose=Pose()))

    assert changed(spec, to_tray(spec_of(), TRAY.pose.raised(0.01))) == PLANNED
    assert changed(spec, replace(spec, scene=replace(spec.scene, frames=others))) == set()


def test_a_frame_at_which_a_task_starts_is_an_input_of_its_plan(spec_of):
    def starting(pose):
        scene = replace(spec_of().scene, frames=(replace(TRAY, pose=pose),))
        task = replace(spec_of().task, start=Target(name="tray", frame="tray"))
        return replace(spec_of(), scene=scene, task=task)

    assert changed(starting(TRAY.pose), starting(TRAY.pose.raised(0.01))) == PLANNED


CONTROL = StepControl(damping_ratio=0.9)
NEAR = Nearness(within_m=0.1, object="cup")
MOVE = MoveStep(name="last", target=Target(name="lift", waypoint="lift"))
# Each field of each kind of step with another value, and the pieces that it reaches.
STEPS = [
    (MOVE, {"name": "away"}, PLANNED),
    (MOVE, {"target": Target(name="grasp", waypoint="grasp")}, PLANNED),
    (MOVE, {"mode": MoveKind.STRAIGHT}, PLANNED),
    (MOVE, {"resolution_rad": 0.02}, PLANNED),
    (MOVE, {"speed_share": 0.5}, LATER),
    (MOVE, {"reached_rad": 0.01}, LAST),
    (MOVE, {"control": CONTROL}, LAST),
    (MOVE, {"limit_s": 1.5}, {"trial"}),
    (WaitStep(name="last", duration_s=1.0), {"duration_s": 2.0}, LAST),
    (WaitStep(name="last", duration_s=1.0), {"control": CONTROL}, LAST),
    (WaitStep(name="last", duration_s=1.0), {"name": "rest"}, PLANNED),
    (CheckStep(name="last"), {"name": "look"}, PLANNED),
    (CheckStep(name="last"), {"object": "cup"}, PLANNED),
    (CheckStep(name="last"), {"at": "buffer"}, LAST),
    (CheckStep(name="last"), {"is_upright": True}, LAST),
    (CheckStep(name="last"), {"is_at_rest": True}, LAST),
    (CheckStep(name="last"), {"held": False}, LAST),
    (CheckStep(name="last", held=True), {"held": False}, LAST),
    (CheckStep(name="last"), {"near": NEAR}, LAST),
    (GripStep(name="last"), {"name": "take"}, PLANNED),
    (GripStep(name="last"), {"object": "cup"}, PLANNED),
    (GripStep(name="last"), {"firm_above_n": 3.0}, LAST),
    (GripStep(name="last"), {"firm_s": 0.1}, LAST),
    (GripStep(name="last"), {"control": CONTROL}, LAST),
    (ReleaseStep(name="last"), {"name": "leave"}, PLANNED),
    (ReleaseStep(name="last"), {"place": "buffer"}, PLANNED),
    (ReleaseStep(name="last"), {"opened_m": 0.001}, LAST),
    (ReleaseStep(name="last"), {"control": CONTROL}, LAST),
    (NeutralStep(name="last"), {"name": "off"}, PLANNED),
    (NeutralStep(name="last"), {"control": CONTROL}, LAST),
]


@pytest.mark.parametrize(("step", "changes", "expected"), STEPS)
def test_a_field_of_a_step_reaches_exactly_the_pieces_that_read_it(spec_of, step, changes, expected):
    assert changed(with_step(spec_of(), step), with_step(spec_of(), replace(step, **changes))) == expected


def test_every_field_of_a_step_is_tried():
    tried = {(type(step), name) for step, changes, _ in STEPS for name in changes}
    kinds = (MoveStep, WaitStep, CheckStep, GripStep, ReleaseStep, NeutralStep)
    assert tried == {(kind, field.name) for kind in kinds for field in fields(kind)}


def test_of_a_linkage_the_inertias_are_no_inputs_of_the_plan_and_all_else_is(spec_of, tmp_path):
    spec = replace(spec_of(), gripper=gripper_of(tmp_path, "linkage"), fidelity=Fidelity.KINEMATIC)
    linkage = spec.gripper.geometry.linkage
    *others, last = linkage.links

    def reached(**changes):
        other = replace(linkage, links=(*others, replace(last, **changes)))
        return changed(spec, with_gripper(spec, geometry=replace(spec.gripper.geometry, linkage=other)))

    inertias = {"mass_kg": 0.4, "inertial": Pose(position_m=(0.0, 0.0, 0.1)), "inertia_kg_m2": (0.1,) * 6}
    shapes = {
        "name": "tip",
        "parent": 0,
        "origin": last.origin.raised(0.001),
        "kind": JointKind.PRISMATIC,
        "axis": (1.0, 0.0, 0.0),
        "multiplier": 0.5,
        "offset": 0.1,
        "hulls_m": (),
    }
    assert {*inertias, *shapes} == {field.name for field in fields(last)}
    assert {name: reached(**{name: value}) for name, value in inertias.items()} == dict.fromkeys(inertias, LAST)
    assert {name: reached(**{name: value}) for name, value in shapes.items()} == dict.fromkeys(shapes, PLANNED)


@pytest.mark.engine
def test_a_plan_is_the_same_where_its_digest_is(spec_of):
    """With heavier links, another wait, and another speed and limit of a move: to the last bit."""
    spec = replace(spec_of(), planner_settings=replace(spec_of().planned_by, algorithm="RRTConnect"))
    other = with_move(heavier(spec), speed_share=0.5, limit_s=1.5)
    waiting, longer = (with_step(one, WaitStep(name="last", duration_s=s)) for one, s in ((spec, 1.0), (other, 2.0)))

    assert digests_of(waiting, VERSIONS).plan == digests_of(longer, VERSIONS).plan
    assert make_plan(waiting) == make_plan(longer)
