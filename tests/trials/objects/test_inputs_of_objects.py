"""Which numbers of the objects of a scene are inputs of which piece, whichever object they belong to."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from rgss.evidence import Fidelity
from rgss.scenes import Cylinder, MeshShape, NamedPlace, corners_of
from rgss.scenes.uncertainty import Constant, Uncertainty, UncertainValue
from rgss.trials.code.piece_versions import ENTRIES
from rgss.trials.pieces import execution_from_json
from rgss.trials.pieces.pieces import make_execution, make_plan, make_timing
from tests.fixtures.perturbation import digests_anew, paths_of, perturbed
from tests.trials.hands.gripper_files import gripper_of
from tests.trials.objects.two_objects import CARTON, on_top

VERSIONS = {"pybullet": "3.2.7", "ompl": "1.7.0", "toppra": "0.6.10", **{f"rgss-{name}": "a" for name in ENTRIES}}
PLANNED, LAST = {"plan", "timing", "execution"}, {"execution"}


def digests(spec):
    found = digests_anew(spec, VERSIONS)
    return {"plan": found.plan, "timing": found.timing, "execution": found.execution}


def changed(spec, other):
    before, after = digests(spec), digests(other)
    return {name for name in before if before[name] != after[name]}


def with_object(spec, name, **changes):
    """A trial with one object changed: its workpiece, or its place region."""
    objects = {one.workpiece.id: one for one in spec.scene.objects}
    one = objects[name]
    if "place" in changes:
        one = replace(one, place=replace(one.place, **changes["place"]))
    else:
        one = replace(one, workpiece=replace(one.workpiece, **changes))
    if name == spec.scene.workpiece.id:
        return replace(spec, scene=replace(spec.scene, workpiece=one.workpiece, place=one.place))
    return replace(spec, scene=replace(spec.scene, others=(one,)))


def stated(spec):
    return replace(spec, scene=replace(spec.scene, task=replace(spec.scene.task, candidates=None)))


# A tin as tall as the carton, which the fingers reach at the stated height of the grasp.
TALL = Cylinder(radius_m=0.03, height_m=0.09)


def with_cup(spec, folder):
    return replace(spec, gripper=gripper_of(folder, "vacuum", CARTON))


def perceived(spec):
    """Both objects drawn: where they are and are seen, and what they are."""
    drawn = {"perception{}.x": 2.1e-3, "perception{}.yaw": 0.02, "workpiece{}.y": -1e-3}
    drawn |= {"workpiece{}.mass": 0.21, "workpiece{}.friction": 0.63}
    names = {name.format(of).replace("workpiece.tin", "workpieces.tin"): name for name in drawn for of in ("", ".tin")}
    values = (UncertainValue(quantity=name, distribution=Constant(value=drawn[of])) for name, of in names.items())
    return replace(spec, uncertainty=Uncertainty(values=tuple(values)))


CHANGES = {
    "mass": (LAST, LAST, {"mass_kg": 0.31}),
    "friction": (LAST, PLANNED, {"friction": 0.71}),
    "force limit": (LAST, LAST, {"force_limit_n": 39.0}),
    "window of the force": (LAST, LAST, {"force_window_s": 0.02}),
    "landing": (LAST, LAST, {"landing_limit_m_s": 0.9}),
    "height of the centre of mass": (LAST, PLANNED, {"centre_of_mass_m": 0.002}),
    "centre of mass aside": (LAST, PLANNED, {"centre_of_mass_across_m": (0.002, 0.0)}),
    "rolling resistance": (LAST, LAST, {"rolling_resistance_m": 0.001}),
    "radius of the place": (LAST, LAST, {"place": {"radius_m": 0.021}}),
    "tilt at the place": (LAST, LAST, {"place": {"largest_tilt_rad": 0.11}}),
    "drop at the place": (LAST, LAST, {"place": {"largest_drop_m": 0.011}}),
    "drag at the place": (LAST, LAST, {"place": {"largest_drag_m": 0.002}}),
    "colour": (set(), set(), {"colour": (0.0, 0.0, 0.0, 1.0)}),
    "position of the place": (PLANNED, PLANNED, {"place": {"centre_m": (0.3, 0.6, 0.9)}}),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_number_of_any_object_is_an_input_of_the_same_pieces(with_two, name):
    of_stated, of_chosen, changes = CHANGES[name]
    spec = with_two()
    for one in spec.scene.objects:
        of = one.workpiece.id
        assert changed(spec, with_object(spec, of, **changes)) == of_chosen, of
        assert changed(stated(spec), with_object(stated(spec), of, **changes)) == of_stated, of


def test_of_a_mesh_the_corners_are_planned_and_the_rest_of_its_file_is_not(with_two):
    """As of the meshes of the robot: a comment in the file plans nothing anew."""
    mesh = MeshShape(parts_m=corners_of(CARTON), sha256="one")
    for make in (with_two(), stated(with_two())):
        spec = with_object(make, make.scene.workpiece.id, shape=mesh)
        of = spec.scene.workpiece.id
        assert changed(spec, with_object(spec, of, shape=replace(mesh, sha256="other"))) == LAST
        moved = tuple((x, y, z + 0.001) for x, y, z in mesh.parts_m[0])
        assert changed(spec, with_object(spec, of, shape=replace(mesh, parts_m=(moved,)))) == PLANNED


def test_the_friction_of_an_object_is_not_an_input_of_the_choice_of_a_cup(with_two, tmp_path):
    spec = with_cup(with_two(), tmp_path)
    for one in spec.scene.objects:
        assert changed(spec, with_object(spec, one.workpiece.id, friction=0.71)) == LAST
        assert changed(spec, with_object(spec, one.workpiece.id, centre_of_mass_m=0.002)) == PLANNED


@pytest.mark.parametrize("name", ["mass_kg", "friction", "centre_of_mass_m"])
def test_what_the_robot_assumes_of_an_object_is_an_input_even_if_the_true_value_is_drawn(with_two, name):
    spec = stated(with_two())
    quantity = {"mass_kg": "mass", "friction": "friction", "centre_of_mass_m": "centre_of_mass"}[name]
    for one, draw in zip(spec.scene.objects, (f"workpiece.{quantity}", f"workpieces.tin.{quantity}"), strict=True):
        values = (UncertainValue(quantity=draw, distribution=Constant(value=0.011)),)
        drawn = replace(spec, uncertainty=Uncertainty(values=values))
        value = getattr(one.workpiece, name) + 0.01
        assert changed(drawn, with_object(drawn, one.workpiece.id, **{name: value})) == LAST


CELLS = {
    "stated": lambda spec, folder: stated(spec),
    "chosen": lambda spec, folder: spec,
    "stated for a cup": lambda spec, folder: with_cup(stated(spec), folder),
    "chosen for a cup": with_cup,
    "stacked": lambda spec, folder: replace(spec, scene=on_top(spec.scene, of=spec.scene.workpiece.id)),
    "perceived": lambda spec, folder: perceived(stated(spec)),
    "chosen as perceived": lambda spec, folder: perceived(spec),
}


# The task names the objects.
IDS_OF_OBJECTS = re.compile(r"scene\.(workpiece|others\[0\]\.workpiece)\.id")


def cell_spec(with_two, name, folder):
    """Trial of a cell with a named place."""
    spec = with_two(tin=TALL) if name in ("stated", "perceived") else with_two()
    (tin,) = spec.scene.others
    place = NamedPlace(id="buffer", region=tin.place, support=tin.place_support)
    return CELLS[name](replace(spec, scene=replace(spec.scene, places=(place,))), folder)


def without_effect(spec, *pieces):
    """For each of some pieces, the trial with every number and text changed in scene and gripper that is no input."""
    before = digests(spec)
    others = dict.fromkeys(pieces, spec)
    for part in ("scene", "gripper"):
        value = getattr(spec, part)
        paths = [path for path in paths_of(value, part) if not IDS_OF_OBJECTS.fullmatch(path)]
        after = {path: digests(replace(spec, **{part: perturbed(value, {path}, part)})) for path in paths}
        for piece in pieces:
            neutral = {path for path in paths if after[path][piece] == before[piece]}
            others[piece] = replace(others[piece], **{part: perturbed(value, neutral, part)})
    return others


@pytest.mark.engine
@pytest.mark.parametrize("name", CELLS)
def test_what_is_not_an_input_of_plan_and_timing_has_no_effect_on_them(with_two, name, tmp_path):
    """Friction, masses, limits and tolerances of everything are changed at once where the digest does not."""
    spec = cell_spec(with_two, name, tmp_path)
    others = without_effect(spec, "plan", "timing")
    other = others["plan"]
    for one, another in zip(spec.scene.objects, other.scene.objects, strict=True):
        assert one.workpiece.mass_kg != another.workpiece.mass_kg
        assert one.place.radius_m != another.place.radius_m
        is_chosen = spec.scene.task.candidates is not None and spec.gripper.suction is None
        assert (one.workpiece.friction != another.workpiece.friction) == (not is_chosen)

    plan = make_plan(spec)
    assert make_plan(other) == plan
    assert '"invalid_' not in plan
    assert make_timing(others["timing"], plan) == make_timing(spec, plan)


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", Fidelity)
def test_what_is_not_an_input_of_an_execution_has_no_effect_on_it(with_two, fidelity):
    spec = replace(perceived(stated(with_two(tin=TALL))), fidelity=fidelity)
    timing = make_timing(spec, make_plan(spec))
    execution = make_execution(spec, timing)
    assert make_execution(without_effect(spec, "execution")["execution"], timing) == execution
    assert [phase.failure for phase in execution_from_json(execution)] == [None] * len(spec.task.phases)
