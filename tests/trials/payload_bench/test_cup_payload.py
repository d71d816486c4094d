"""The payload of a suction cup on the bench, against the statics of its lip."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import DefinitionError
from rgss.physics import PhysicsSettings
from rgss.scenes import Box, Cylinder, Gripper, at_top, load_gripper_file, load_scene
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.range import BOUND, VALIDATED_CUP, outside
from rgss.trials.payload_bench.rig import PayloadLimit, PayloadRig, probe
from rgss.trials.payload_bench.spec import BenchSpec, bench_spec

pytestmark = pytest.mark.engine

SCENES = Path(__file__).parents[3] / "scenes"
SCENE = load_scene(SCENES / "restaurant.yaml")
FILE = load_gripper_file(SCENES / "grippers/lite6_vacuum.yaml")
LIP_M = 0.012


def cup_spec(
    *,
    force_n: float = 12.0,
    leak: float = 0.1,
    acceleration_m_s2: float = 1.25,
    beside_m: tuple[float, float] = (0.0, 0.0),
    shape: Box | Cylinder = Box(size_m=(0.03, 0.04, 0.03)),  # noqa: B008 - a frozen value
    rated_kg: float = 20.0,
    rate_hz: float = 240.0,
) -> BenchSpec:
    gripper = Gripper(
        geometry=at_top(replace(FILE.geometry, cup=Cylinder(radius_m=LIP_M, height_m=0.02)), shape),
        base_mass_kg=0.3,
        finger_mass_kg=0.0,
        finger_velocity_m_s=1.0,
        finger_force_n=force_n,
        friction=1.0,
        suction=replace(FILE.suction, leak=leak),
    )
    workpiece = replace(SCENE.workpiece, shape=shape, centre_of_mass_across_m=beside_m, force_limit_n=1e6)
    return bench_spec(
        replace(SCENE, workpiece=workpiece),
        gripper,
        acceleration_m_s2=acceleration_m_s2,
        rated_kg=rated_kg,
        physics=PhysicsSettings(rate_hz=rate_hz),
    )


@pytest.mark.parametrize("rate_hz", [240.0, 960.0])
@pytest.mark.parametrize("acceleration", [0.01, 1.25, 8.0])
@pytest.mark.parametrize(
    ("force", "leak", "beside"), [(12.0, 0.1, (0.0, 0.0)), (2.0, 0.0, (0.004, -0.003)), (50.0, 0.3, (0.006, 0.0))]
)
def test_a_cup_lifts_the_force_of_its_vacuum(rate_hz, acceleration, force, leak, beside):
    spec = cup_spec(force_n=force, leak=leak, acceleration_m_s2=acceleration, beside_m=beside, rate_hz=rate_hz)
    # The lip lifts off on one side where the moment of the load exceeds what is left of the vacuum times its radius.
    lever = math.hypot(*beside) / LIP_M
    limit_kg = force * (1.0 - leak) / ((9.81 + acceleration) * (1.0 + lever))

    result = run_bench(spec)

    assert result.payload_kg == pytest.approx(limit_kg, rel=BOUND)
    assert result.theory_kg == pytest.approx(limit_kg, rel=1e-9)
    assert result.limited_by is PayloadLimit.SEAL


def test_the_object_stays_where_the_lip_took_it():
    with PayloadRig(cup_spec(), 0.9) as rig:
        rig.grasp()
        rig.begin_to_accelerate(1.25)
        rig.accelerate(1.25, 0.3)

        assert rig.stopped_by is None
        # One joint moves this robot: the engine let what hung from its hand sag by g step² / 0.2.
        assert rig.slip_m < 0.1 * 9.81 / 240.0**2 / 0.2


def test_the_margin_of_a_lift_is_that_of_statics():
    spec = cup_spec(beside_m=(0.003, 0.0))
    held = probe(spec, 0.5 * spec.theory_kg)

    assert held.held
    assert held.grip_margin_min == pytest.approx(2.0, rel=0.03)


def test_an_object_heavier_than_the_vacuum_is_not_gripped_firmly():
    assert probe(cup_spec(), 12.0 * 0.9 / 9.81 * 1.01).stopped_by is PayloadLimit.NO_FIRM_GRASP


def test_a_cup_that_holds_the_rated_mass_is_limited_by_nothing():
    result = run_bench(cup_spec(rated_kg=0.5))

    assert (result.payload_kg, result.limited_by) == (0.5, PayloadLimit.RATED)


def test_a_cup_needs_a_flat_place_of_its_size():
    spec = cup_spec(shape=Cylinder(radius_m=0.01, height_m=0.03))

    assert outside(spec) == ("the object has no flat place on its top for the cup of gripper 'lite6_vacuum'",)
    with pytest.raises(DefinitionError, match="no flat place on its top for the cup of gripper 'lite6_vacuum'"):
        run_bench(spec)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"force_n": 100.0}, "force of the vacuum, without the leak of 90 N, validated from 0.5 to 60 N"),
        ({"acceleration_m_s2": 12.0}, "acceleration of 12 m/s², validated from 0.001 to 10 m/s²"),
        ({"beside_m": (0.009, 0.0)}, "distance of the centre of mass from the cup's axis over the radius of the lip"),
        ({"shape": Box(size_m=(0.03, 0.03, 0.2))}, "height of the centre of mass over its distance from the side of"),
    ],
)
def test_there_is_no_bench_of_a_cup_outside_the_validated_range(changes, sentence):
    found = outside(cup_spec(**changes))

    assert [one for one in found if one.startswith(sentence)]


def test_the_validated_ranges_of_a_cup_are_those_of_no_finger():
    assert not [one.name for one in VALIDATED_CUP if "finger" in one.name]
