"""Uncertainty in a scene file: what it means, and every mistake at its place."""

from __future__ import annotations

import math

import pytest

from rgss.documents import read_document
from rgss.scenes.uncertainty import (
    QUANTITIES,
    Constant,
    Correlation,
    Discrete,
    LogNormal,
    Normal,
    TruncatedNormal,
    Uncertainty,
    UncertainValue,
    Uniform,
    draw_column,
    object_quantity_of_column,
    quantity_of,
    unknown_objects,
)

TEXT = """
uncertainty:
  perception.x: {normal: {mean: 0 mm, sd: 5 mm}, rationale: camera}
  perception.yaw: {uniform: {low: -5 deg, high: 5 deg}, rationale: camera}
  workpiece.mass: {lognormal: {median: 250 g, geometric_sd: 1.3}, rationale: filling}
  workpiece.friction: {truncated_normal: {mean: 1, sd: 25 %, low: 0.5, high: 1.3}, rationale: water}
  gripper.force_sensor.delay: {discrete: {values: [20 ms, 10 ms], weights: [1, 3]}, rationale: bus}
  gripper.force_sensor.noise: {constant: 0.2 N, rationale: data sheet}
correlations:
  - {quantities: [perception.x, workpiece.mass], matrix: [[1, 0.5], [0.5, 1]], rationale: heavy is hidden}
task:
"""


def uncertain(kitchen, text=TEXT):
    return kitchen.change("kitchen.yaml", "task:\n", text.lstrip("\n"))


def distribution_of(scene, name):
    return next(one.distribution for one in scene.uncertainty.values if one.quantity == name)


def test_without_the_key_nothing_is_uncertain(kitchen):
    assert kitchen.scene().uncertainty == Uncertainty()


def test_uncertainty_is_read_in_si_units(kitchen):
    scene = uncertain(kitchen).scene()

    assert distribution_of(scene, "perception.x") == Normal(mean=0.0, sd=0.005)
    assert distribution_of(scene, "perception.yaw") == Uniform(
        low=pytest.approx(-math.radians(5)), high=pytest.approx(math.radians(5))
    )
    assert distribution_of(scene, "workpiece.mass") == LogNormal(median=0.25, geometric_sd=1.3)
    assert distribution_of(scene, "workpiece.friction") == TruncatedNormal(mean=1.0, sd=0.25, low=0.5, high=1.3)
    assert distribution_of(scene, "gripper.force_sensor.delay") == Discrete(values=(0.01, 0.02), weights=(3.0, 1.0))
    assert distribution_of(scene, "gripper.force_sensor.noise") == Constant(value=0.2)
    assert scene.uncertainty.correlations == (
        Correlation(quantities=("perception.x", "workpiece.mass"), matrix=((1.0, 0.5), (0.5, 1.0))),
    )


def test_what_comes_first_replaces_quantities_and_the_groups_that_share_one():
    def one(name, sd):
        return UncertainValue(quantity=name, distribution=Normal(mean=0.0, sd=sd))

    pair = Correlation(quantities=("perception.x", "perception.y"), matrix=((1.0, 0.1), (0.1, 1.0)))
    other = Correlation(quantities=("perception.y", "perception.z"), matrix=((1.0, 0.2), (0.2, 1.0)))
    scene = Uncertainty(values=(one("perception.x", 1.0), one("perception.y", 1.0)), correlations=(pair,))
    study = Uncertainty(values=(one("perception.y", 2.0), one("perception.z", 2.0)), correlations=(other,))

    both = scene.overridden_by(study)

    assert both.values == (one("perception.x", 1.0), *study.values)
    assert both.correlations == (other,)
    assert scene.overridden_by(Uncertainty()) == scene


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "  perception.x: {normal: {mean: 0 mm, sd: 5 mm}",
            "  perception.x: {normal: {mean: 0 mm, sd: ¦5 kg}",
            (
                "uncertainty.unit perception.x: unit 'kg' does not measure what 'm' measures "
                "(give it in m or a multiple of it)"
            ),
        ),
        ("sd: 5 mm", "sd: ¦0 mm", "uncertainty.spread sd must be greater than zero (use a constant for a known value)"),
        ("low: -5 deg", "low: ¦5 deg", "uncertainty.ends low must be less than high"),
        (
            "{constant: 0.2 N, rationale: data sheet}",
            "¦{constant: 0.2 N, uniform: {low: 0 N, high: 1 N}, rationale: data sheet}",
            "uncertainty.kind gripper.force_sensor.noise needs exactly one distribution and has uniform and constant",
        ),
        (
            "{constant: 0.2 N, rationale: data sheet}",
            "¦{rationale: data sheet}",
            "uncertainty.kind gripper.force_sensor.noise needs exactly one distribution and has none",
        ),
        (
            "constant: 0.2 N",
            "constant: ¦-0.2 N",
            (
                "uncertainty.range gripper.force_sensor.noise cannot be below 0 N, and this distribution can "
                "(use truncated_normal, uniform or lognormal)"
            ),
        ),
        (
            "{lognormal: {median: 250 g, geometric_sd: 1.3}",
            "{uniform: ¦{low: 0 kg, high: 1 kg}",
            (
                "uncertainty.range workpiece.mass cannot be at or below 0 kg, and this distribution can "
                "(use truncated_normal, uniform or lognormal)"
            ),
        ),
        ("median: 250 g", "median: ¦0 g", "uncertainty.median the median of a lognormal must be greater than zero"),
        (
            "geometric_sd: 1.3",
            "geometric_sd: ¦1",
            "uncertainty.spread geometric_sd is a factor and must be greater than 1",
        ),
        ("weights: [1, 3]", "weights: ¦[1]", "uncertainty.weights there are 2 values and 1 weights"),
        ("weights: [1, 3]", "weights: ¦[1, 0]", "uncertainty.weights weights must be greater than zero"),
        (
            "values: [20 ms, 10 ms]",
            "values: ¦[10 ms, 10 ms]",
            "uncertainty.values a value is listed twice (add both weights)",
        ),
        (
            "values: [20 ms, 10 ms]",
            "values: [20 ms, ¦10 mm]",
            (
                "uncertainty.unit gripper.force_sensor.delay: unit 'mm' does not measure what 's' measures "
                "(give it in s or a multiple of it)"
            ),
        ),
        (
            "quantities: [perception.x, workpiece.mass]",
            "quantities: ¦[perception.x, perception.x]",
            "uncertainty.group a quantity is in a group twice (put all correlated quantities in one group)",
        ),
        (
            "quantities: [perception.x, workpiece.mass]",
            "quantities: ¦[perception.x, perception.z]",
            "uncertainty.group perception.z has no distribution (give it one under 'uncertainty')",
        ),
        (
            "quantities: [perception.x, workpiece.mass]",
            "quantities: ¦[perception.x, gripper.force_sensor.noise]",
            (
                "uncertainty.group gripper.force_sensor.noise is constant and cannot be correlated "
                "(take it out of the group)"
            ),
        ),
        (
            "matrix: [[1, 0.5], [0.5, 1]]",
            "matrix: ¦[[1, 0.5], [0.5]]",
            "uncertainty.group the matrix must have 2 rows of 2 correlations",
        ),
        (
            "matrix: [[1, 0.5], [0.5, 1]]",
            "matrix: ¦[[1, 0.5], [0.4, 1]]",
            "uncertainty.group a correlation matrix must be symmetric, with ones on its diagonal",
        ),
        (
            "matrix: [[1, 0.5], [0.5, 1]]",
            "matrix: ¦[[1, 1], [1, 1]]",
            "uncertainty.group the correlation matrix must be positive definite (lower the correlations)",
        ),
    ],
)
def test_a_mistake_is_told_at_its_place(kitchen, old, new, expected):
    uncertain(kitchen).change("kitchen.yaml", old, new)

    assert kitchen.findings("scene") == [f"{kitchen.marks()[0]} {expected}"]


def test_an_unknown_quantity_is_told_with_the_nearest(kitchen):
    uncertain(kitchen).change("kitchen.yaml", "  perception.x: {normal", "  perception.u: ¦{normal")
    kitchen.change("kitchen.yaml", "quantities: [perception.x,", "quantities: [perception.yaw,")

    (finding,) = kitchen.findings("scene")
    assert finding.startswith(kitchen.marks()[0])
    assert "unknown uncertain quantity 'perception.u'" in finding
    assert "did you mean 'perception." in finding


@pytest.mark.parametrize(
    ("name", "near"),
    [("workpieces.mug.mas", "workpieces.mug.mass"), ("workpiece.mug.mass", "workpieces.mug.mass")],
)
def test_an_unknown_quantity_of_an_object_is_told_with_the_nearest(kitchen, name, near):
    uncertain(kitchen).change("kitchen.yaml", "  workpiece.friction: {", f"  {name}: ¦{{")

    (finding,) = kitchen.findings("scene")
    assert finding.startswith(kitchen.marks()[0])
    assert f"unknown uncertain quantity '{name}' (did you mean '{near}'?)" in finding


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("perception.mug.x", "objects under 'workpieces': lid, tray"),
        ("perception.lit.x", "did you mean 'perception.lid.x'?"),
        ("perception.cup.x", "'cup' is the first object, under 'workpiece': its quantity is 'perception.x'"),
    ],
)
def test_a_quantity_of_an_object_that_is_not_there_is_one_line(tmp_path, name, hint):
    path = tmp_path / "scene.yaml"
    path.write_text(f"uncertainty:\n  {name}: 1 mm\n", encoding="utf-8")
    (finding,) = unknown_objects([name], read_document(path), first="cup", further=["lid", "tray"])

    known = name.split(".")[1]
    assert finding.message == f"{name}: no object {known!r} under the scene's 'workpieces'"
    assert (finding.rule, finding.hint, finding.line) == ("uncertainty.object", hint, 2)


@pytest.mark.parametrize(
    ("known", "hint"),
    [
        ("plate", "the scene has one object: its quantity is 'perception.yaw'"),
        ("mug", "'mug' is the first object, under 'workpiece': its quantity is 'perception.yaw'"),
    ],
)
def test_a_quantity_of_a_further_object_needs_one(kitchen, known, hint):
    uncertain(kitchen).change("kitchen.yaml", "  perception.yaw: {uni", f"  perception.{known}.yaw: ¦{{uni")

    message = f"perception.{known}.yaw: no object {known!r} under the scene's 'workpieces'"
    assert kitchen.findings("scene") == [f"{kitchen.marks()[0]} uncertainty.object {message} ({hint})"]


def test_the_column_of_a_further_object_s_draws_is_known():
    for name in ("workpieces.mug.mass", "perception.green_cube.yaw", "workpieces.x.y"):
        assert object_quantity_of_column(draw_column(name)) == quantity_of(name)
    for name in QUANTITIES:
        assert object_quantity_of_column(draw_column(name)) is None


@pytest.mark.parametrize("other", ["perception.x", "robot.slide_offset"])
def test_a_quantity_of_each_joint_goes_together_with_no_other(kitchen, other):
    uncertain(kitchen).change(
        "kitchen.yaml",
        "  gripper.force_sensor.noise: ",
        "  robot.joint_offset: {normal: {mean: 0 deg, sd: 1 deg}, rationale: wear}\n"
        "  robot.slide_offset: {normal: {mean: 0 mm, sd: 1 mm}, rationale: wear}\n  gripper.force_sensor.noise: ",
    )
    kitchen.change("kitchen.yaml", "[perception.x, workpiece.mass]", f"¦[{other}, robot.joint_offset]")

    assert kitchen.findings("scene") == [
        (
            f"{kitchen.marks()[0]} uncertainty.group a quantity of each joint "
            "can be correlated only with others of the same joints"
        )
    ]


def test_every_quantity_is_documented_in_the_registry():
    for name, quantity in QUANTITIES.items():
        assert quantity.name == name
        assert quantity.meaning.endswith(".")


def test_a_column_of_draws_has_its_unit_at_its_end_if_the_registry_knows_it():
    assert draw_column("perception.yaw") == "drawn_perception_yaw_rad"
    assert draw_column("robot.joint_offset.6") == "drawn_robot_joint_offset_6_rad"
    assert draw_column("gripper.finger.force") == "drawn_gripper_finger_force_1"
    assert draw_column("of.another.version") == "drawn_of_another_version"
    assert draw_column("workpieces.mug.mass_factor") == "drawn_workpieces_mug_mass_factor_1"
