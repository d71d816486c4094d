"""The designs of the reference project: the 72 variants of Table 4.3 and their components."""

import csv
import itertools
import pickle
from pathlib import Path

import pytest

from rgss.designs import load_catalogue, load_design_space, source_units, sources, variant_rows, variants_csv

PROJECT = Path(__file__).parents[2]
TABLE = (Path(__file__).parent / "table_4_3.csv").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def catalogue():
    return load_catalogue(PROJECT / "designs" / "catalogue.yaml", label="designs/catalogue.yaml")


@pytest.fixture(scope="module")
def space(catalogue):
    return load_design_space(PROJECT / "designs" / "grasping_system.yaml", catalogue)


@pytest.fixture(scope="module")
def variants(space):
    return space.expand()


def test_the_table_is_reproduced_byte_for_byte(variants):
    assert variants_csv(variants) == TABLE


def test_the_parameters_are_the_numbers_of_the_table(variants):
    rows = list(csv.DictReader(TABLE.splitlines()))
    assert len(rows) == len(variants) == 72
    for row, variant, given in zip(rows, variants, variant_rows(variants), strict=True):
        assert variant.id == int(row.pop("design_id")) == given["design_id"]
        assert list(variant.columns()) == list(row)
        for column, value in variant.columns().items():
            assert value == (row[column] if isinstance(value, str) else float(row[column]))
        assert list(variant.parameters) == [f"d{number}" for number in range(1, 10)]


def test_levels_nest_as_in_the_table(variants):
    nesting = itertools.product(
        ["standard", "light"],
        ["three", "two"],
        ["slow", "fast"],
        ["rrt", "trrt", "stride"],
        ["short", "medium", "long"],
    )
    assert [tuple(variant.levels.values()) for variant in variants] == list(nesting)


def test_every_variant_has_its_own_digest(variants, space):
    assert len({variant.digest for variant in variants}) == 72
    assert [variant.digest for variant in space.expand()] == [variant.digest for variant in variants]


@pytest.mark.parametrize(
    ("number", "components"),
    [
        (1, ("kg-3-standard", "rrt")),
        (19, ("kg-2-standard", "rrt")),
        (40, ("kg-3-light", "trrt")),
        (72, ("kg-2-light", "stride")),
    ],
)
def test_each_variant_has_one_component_for_each_role(space, number, components):
    variant = space.variant(number)
    assert list(variant.components) == ["manipulator", "gripper", "finger_actuator", "planner"]
    ids = {role: component.id for role, component in variant.components.items()}
    assert ids == {
        "manipulator": "ur10",
        "gripper": components[0],
        "finger_actuator": "ka-58",
        "planner": components[1],
    }


def test_the_planner_of_a_variant_is_the_one_that_its_parameter_names(variants):
    assert all(variant.components["planner"].id == str(variant.parameters["d8"]).lower() for variant in variants)


def test_the_geometry_of_a_gripper_has_the_fingers_of_the_design(variants):
    for variant in variants:
        assert variant.components["gripper"].geometry == f"scenes/grippers/kg-{variant.parameters['d1']}.yaml"
        assert (PROJECT / variant.components["gripper"].geometry).is_file()


def test_measures_find_every_value_with_its_unit(space, variants):
    values, units = sources(variants[64]), space.source_units()
    assert list(values) == list(units) == list(source_units(space.parameters, space.catalogue))
    assert values["design.d1"] == 2
    assert values["design.d8"] == "RRT"
    assert values["component.manipulator.payload"] == 10.0
    assert units["component.manipulator.payload"] == "kg"
    assert values["component.finger_actuator.mass"] == 0.05
    assert values["component.gripper.actuators"] == values["design.d1"]
    assert units["component.gripper.cost"] == "USD"
    assert units["design.d8"] == ""


def test_every_cost_is_an_assumption_with_a_rationale(catalogue):
    for component in catalogue.components:
        assert component.cost.assumption
        assert component.assumptions["cost"] == component.cost.rationale != ""
        assert component.cost.value >= 0


def test_light_and_three_fingered_grippers_cost_more(catalogue):
    cost = {component.id: component.cost.value for component in catalogue.components}
    assert cost["kg-2-standard"] < cost["kg-2-light"] < cost["kg-3-light"]
    assert cost["kg-2-standard"] < cost["kg-3-standard"] < cost["kg-3-light"]


def test_masses_are_those_of_the_catalogue(catalogue):
    masses = {component.id: component.mass_kg for component in catalogue.components}
    assert masses["ur10"] == 28.9
    assert masses["ka-58"] == 0.05
    assert masses["rrt"] is None


def test_no_combination_is_excluded(space):
    assert space.excluded() == ()


def test_variants_go_to_other_processes_and_back(variants):
    assert pickle.loads(pickle.dumps(variants)) == variants  # noqa: S301 - our own bytes
