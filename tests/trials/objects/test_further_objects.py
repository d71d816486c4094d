"""Uncertainty of the further objects of a scene: draws, conditions, keys and trials of their own."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import pytest

from rgss.scenes import PlaceRegion, SceneObject
from rgss.scenes.uncertainty import (
    QUANTITIES,
    Constant,
    EntersAt,
    Normal,
    Uncertainty,
    UncertainValue,
    draws_of,
    object_quantity_name,
)
from rgss.scenes.uncertainty.drawing import uniform_of
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.trials import cell_of, plan_of
from rgss.trials.code.piece_versions import versions
from rgss.trials.conditions import ObjectConditions, conditions_of, drawn_values
from rgss.trials.pieces.input_digests import digests_of
from tests.fixtures.shipped_project import REPOSITORY

OF_OBJECTS = [name for name in QUANTITIES if name.startswith(("workpiece.", "perception."))]
PIECES = ("plan", "timing", "execution")


def constants(**values):
    named = {name.replace("__", "."): value for name, value in values.items()}
    return Uncertainty(
        values=tuple(UncertainValue(quantity=name, distribution=Constant(value=value)) for name, value in named.items())
    )


@pytest.fixture
def two_objects(spec_of):
    """The nominal trial of a design with a mug beside the cup."""
    spec = spec_of(65)
    scene = spec.scene
    x, y, z = scene.workpiece.pose.position_m
    pose = replace(scene.workpiece.pose, position_m=(x - 0.2, y, z))
    place = PlaceRegion(
        centre_m=(*scene.place.centre_m[:2], scene.place.centre_m[2]), radius_m=0.02, largest_tilt_rad=0.1
    )
    mug = SceneObject(
        workpiece=replace(scene.workpiece, id="mug", mass_kg=0.4, pose=pose),
        support=scene.support,
        place=place,
        place_support=scene.place_support,
    )
    return replace(spec, scene=replace(scene, others=(mug,)))


def test_every_quantity_of_the_first_object_has_a_like_of_the_others():
    assert {QUANTITIES[name].field for name in OF_OBJECTS} == {one.name for one in fields(ObjectConditions)} - {"id"}


def test_draws_of_an_object_depend_on_seed_and_name_alone():
    """The oracle is the inverse distribution of the number that belongs to the name."""

    def sigma(*names):
        return Uncertainty(
            values=tuple(UncertainValue(quantity=name, distribution=Normal(mean=0.0, sd=0.003)) for name in names)
        )

    alone = draws_of(sigma("perception.x"), 4)
    both = draws_of(sigma("perception.mug.x", "perception.x", "perception.lid.x"), 4)

    assert list(both) == ["perception.x", "perception.lid.x", "perception.mug.x"]
    assert both["perception.x"] == alone["perception.x"]
    assert len({*both.values()}) == 3
    for name, value in both.items():
        share = 0.5 * (1.0 + math.erf(value / 0.003 / math.sqrt(2.0)))
        assert share == pytest.approx(uniform_of(4, name), abs=1e-7)


@pytest.mark.parametrize("first", OF_OBJECTS)
def test_a_draw_of_an_object_changes_it_alone_and_the_pieces_from_where_it_enters(two_objects, first):
    name = object_quantity_name(first, "mug")
    drawn = replace(two_objects, uncertainty=constants(**{name: 0.0123}))
    before, after = conditions_of(two_objects), conditions_of(drawn)
    for one, other in ((before.true_scene, after.true_scene), (before.perceived_scene, after.perceived_scene)):
        assert replace(one, others=()) == replace(other, others=())
    changed = [before.true_scene != after.true_scene, before.perceived_scene != after.perceived_scene]
    assert changed == ["perception" not in first, QUANTITIES[first].enters is EntersAt.PLAN]

    keys = [digests_of(spec, versions()).as_mapping() for spec in (two_objects, drawn)]
    start = PIECES.index(QUANTITIES[first].enters.value)
    assert [keys[0][piece] != keys[1][piece] for piece in PIECES] == [place >= start for place in range(3)]
    assert keys[0]["trial"] != keys[1]["trial"]


def test_an_object_has_what_the_first_would_have_of_the_same_draw(two_objects):
    values = {"workpiece.x": 0.004, "perception.x": 0.003, "perception.yaw": 0.2, "workpiece.mass_factor": 1.5}
    of_mug = {object_quantity_name(name, "mug"): value for name, value in values.items()}
    mug = two_objects.scene.others[0].workpiece
    as_first = replace(two_objects, scene=replace(two_objects.scene, workpiece=mug, others=()))

    own = conditions_of(replace(as_first, uncertainty=constants(**values)))
    further = conditions_of(replace(two_objects, uncertainty=constants(**of_mug)))
    assert further.true_scene.others[0].workpiece == own.true_scene.workpiece
    assert further.perceived_scene.others[0].workpiece == own.perceived_scene.workpiece
    assert further.is_grip_known(two_objects.scene.workpiece.id)
    assert not further.is_grip_known("mug")


def test_draws_are_shown_beside_the_nominal_values_of_their_object(two_objects):
    uncertainty = constants(workpiece__mass=0.3, workpieces__mug__mass=0.5, workpieces__mug__mass_factor=1.1)
    shown = {
        one.name: (one.unit, one.nominal, one.drawn)
        for one in drawn_values(replace(two_objects, uncertainty=uncertainty))
    }

    assert shown["workpiece.mass"] == ("kg", two_objects.scene.workpiece.mass_kg, 0.3)
    assert shown["workpieces.mug.mass"] == ("kg", 0.4, pytest.approx(0.55))
    assert shown["workpieces.mug.mass_factor"] == ("kg", 0.4, pytest.approx(0.55))


@pytest.mark.engine
def test_the_hand_goes_where_each_object_is_perceived():
    """The tool at the end of each way to a cube, by forward kinematics, is at the cube's place plus its error."""
    project = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    (spec,) = trial_specs(project, variants=[project.designs.variant(72)], seeds=[1])
    errors = {"green_cube": (0.004, -0.002), "blue_cube": (-0.003, 0.001)}
    values = {
        f"perception.{cube}.{axis}": value
        for cube, error in errors.items()
        for axis, value in zip("xy", error, strict=True)
    }
    spec = replace(spec, uncertainty=constants(**values))
    plan, arm = plan_of(spec), cell_of(spec).arm

    for one in spec.scene.objects:
        cube = one.workpiece
        reached = arm.tool_pose(plan.direct[f"{cube.id}.to_grasp"][-1]).position_m
        error = errors.get(cube.id, (0.0, 0.0))
        expected = [at + off for at, off in zip(cube.pose.position_m, error, strict=False)]
        assert reached[:2] == pytest.approx(expected, abs=1e-4)


def test_what_stands_on_an_object_has_its_true_offset_and_not_the_error_of_its_perception(two_objects):
    """A lid on the mug, which stands on the cup: the cup's offset moves both, the mug's the lid."""
    (mug,) = two_objects.scene.others
    lid = replace(mug, workpiece=replace(mug.workpiece, id="lid"), support="mug")
    stack = (replace(mug, support=two_objects.scene.workpiece.id), lid)
    values = {
        "workpiece__x": 0.003,
        "workpiece__y": -0.001,
        "perception__x": 0.05,
        "workpieces__mug__x": 0.01,
        "perception__lid__y": 0.002,
    }
    spec = replace(two_objects, scene=replace(two_objects.scene, others=stack), uncertainty=constants(**values))
    conditions = conditions_of(spec)

    def offsets_mm(scene):
        pairs = zip(scene.objects, spec.scene.objects, strict=True)
        return [
            [
                round(1e3 * (a - b), 6)
                for a, b in zip(after.workpiece.pose.position_m, before.workpiece.pose.position_m, strict=True)
            ]
            for after, before in pairs
        ]

    assert offsets_mm(conditions.true_scene) == [[3, -1, 0], [13, -1, 0], [13, -1, 0]]
    assert offsets_mm(conditions.perceived_scene) == [[53, -1, 0], [13, -1, 0], [13, 1, 0]]
