"""The simulated payload against Coulomb's law and equation 4.8."""

import math
import os
import subprocess
import sys
from dataclasses import replace
from itertools import product
from pathlib import Path

import pybullet
import pytest

from rgss.errors import DefinitionError
from rgss.physics import PhysicsSettings
from rgss.scenes import Box, Cylinder, Gripper, load_gripper, load_scene
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.range import BOUND, VALIDATED, outside
from rgss.trials.payload_bench.rig import PayloadLimit, probe
from rgss.trials.payload_bench.spec import BenchSettings, BenchSpec, bench_spec

pytestmark = pytest.mark.engine

SCENES = Path(__file__).parents[3] / "scenes"
SCENE = load_scene(SCENES / "restaurant.yaml")
GEOMETRIES = {fingers: load_gripper(SCENES / f"grippers/kg-{fingers}.yaml") for fingers in (2, 3)}
UNBREAKABLE_N = 1.0e6


def spec_of(
    fingers: int,
    *,
    friction: float = 0.7,
    force_n: float = 10.0,
    acceleration_m_s2: float = 1.2,
    finger_mass_kg: float = 0.3,
    force_limit_n: float = UNBREAKABLE_N,
    rated_kg: float = 10.0,
) -> BenchSpec:
    gripper = Gripper(
        geometry=GEOMETRIES[fingers],
        base_mass_kg=0.4,
        finger_mass_kg=finger_mass_kg,
        finger_velocity_m_s=0.04,
        finger_force_n=force_n,
        friction=friction,
    )
    spec = bench_spec(SCENE, gripper, acceleration_m_s2=acceleration_m_s2, rated_kg=rated_kg)
    return replace(spec, force_limit_n=force_limit_n)


@pytest.mark.verifies("SYS-019")
@pytest.mark.slow
@pytest.mark.parametrize(
    ("fingers", "acceleration", "friction", "force"),
    list(product((2, 3), (0.5, 1.0, 2.0, 4.0), (0.4, 0.7, 0.9), (5.0, 10.0, 20.0))),
)
def test_the_limit_is_within_two_percent_of_coulombs_law(fingers, acceleration, friction, force):
    spec = spec_of(fingers, friction=friction, force_n=force, acceleration_m_s2=acceleration)
    limit_kg = friction * force * fingers / (9.81 + acceleration)
    held, slipped = probe(spec, 0.98 * limit_kg), probe(spec, 1.02 * limit_kg)
    assert held.stopped_by is None
    assert slipped.stopped_by is PayloadLimit.SLIP


@pytest.mark.verifies("SYS-019")
@pytest.mark.parametrize(("rate_hz", "iterations"), [(240.0, 20), (240.0, 400), (1000.0, 100)])
def test_a_box_that_three_fingers_hold_beside_its_middle_has_the_payload_of_coulombs_law(rate_hz, iterations):
    """Each finger presses on an edge or a face along its own direction, so that the law is that of a cylinder."""
    spec = spec_of(3)
    box = Box(size_m=(0.05, 0.04, 0.09))
    scene = replace(SCENE, workpiece=replace(SCENE.workpiece, shape=box, friction=0.8))
    physics = PhysicsSettings(rate_hz=rate_hz).with_iterations(iterations)
    spec = bench_spec(scene, spec.gripper, acceleration_m_s2=1.2, rated_kg=10.0, physics=physics)
    assert math.hypot(*spec.grasp.position_m[:2]) > 0.005
    result = run_bench(replace(spec, force_limit_n=UNBREAKABLE_N))
    assert result.payload_kg == pytest.approx(0.8 * 0.7 * 10.0 * 3 / (9.81 + 1.2), rel=0.02)


@pytest.mark.verifies("SYS-019")
@pytest.mark.parametrize(
    ("fingers", "acceleration", "friction", "force"),
    [(2, 0.5, 0.4, 5.0), (2, 2.0, 0.7, 10.0), (2, 4.0, 0.4, 20.0), (3, 1.0, 0.7, 10.0), (3, 4.0, 0.9, 20.0)],
)
def test_bisection_finds_the_limit(fingers, acceleration, friction, force):
    spec = spec_of(fingers, friction=friction, force_n=force, acceleration_m_s2=acceleration)
    result = run_bench(spec)
    assert result.payload_kg == pytest.approx(friction * force * fingers / (9.81 + acceleration), rel=0.02)
    assert result.limited_by is PayloadLimit.SLIP
    low, high = result.bracket_kg
    assert high - low <= 0.005 * high


def test_a_finer_step_finds_the_same_limit():
    """Within what the first slip resolves and the brackets are wide."""
    coarse, fine = (
        run_bench(replace(spec_of(2, acceleration_m_s2=2.0), physics=PhysicsSettings(rate_hz=rate)))
        for rate in (240.0, 1000.0)
    )
    assert fine.payload_kg == pytest.approx(coarse.payload_kg, rel=0.01)


@pytest.mark.parametrize("finger_mass_kg", [0.2, 0.3])
@pytest.mark.parametrize("fingers", [2, 3])
def test_the_simulated_payload_is_the_safety_factor_above_equation_4_8_with_the_force_of_all_fingers(
    fingers, finger_mass_kg
):
    """d5 is the force of one finger: F_max = N_f d5; with F_max = d5 the payload would be N_f times as much."""
    result = run_bench(spec_of(fingers, finger_mass_kg=finger_mass_kg, force_limit_n=40.0))
    by_all, by_one = (0.7 * force / (1.5 * (9.81 + 1.2)) for force in (fingers * 10.0, 10.0))
    assert result.eq_4_8_kg == pytest.approx(by_all)
    assert result.payload_kg / by_all == pytest.approx(1.5, rel=0.02)
    assert result.payload_kg / by_one == pytest.approx(1.5 * fingers, rel=0.02)
    assert result.limited_by is PayloadLimit.SLIP


def test_what_counts_is_the_sum_of_the_fingers_forces():
    two, three = run_bench(spec_of(2, force_n=15.0)), run_bench(spec_of(3, force_n=10.0))
    assert two.payload_kg == pytest.approx(three.payload_kg, rel=0.01)


@pytest.mark.parametrize("force_limit_n", [9.9, 10.6])
def test_an_object_that_the_fingers_or_their_closing_crush_has_no_payload(force_limit_n):
    """Closing reads 10.9 N over 10 ms, and like the force afterwards it does not depend on the object's mass."""
    result = run_bench(spec_of(3, force_limit_n=force_limit_n))
    assert (result.payload_kg, result.limited_by) == (0.0, PayloadLimit.DAMAGE)


def test_an_object_that_bears_the_blow_is_limited_by_slip():
    bears, unbreakable = run_bench(spec_of(2, force_limit_n=40.0)), run_bench(spec_of(2))
    assert bears == unbreakable


def test_the_search_ends_at_the_rated_mass():
    result = run_bench(spec_of(3, rated_kg=1.5))
    assert (result.payload_kg, result.limited_by, result.trials) == (1.5, PayloadLimit.RATED, 2)


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("iterations", [20, 50])
@pytest.mark.parametrize(
    "changes",
    [
        {"acceleration_m_s2": 0.001},
        {"acceleration_m_s2": 0.0125},
        {"acceleration_m_s2": 10.0},
        {"friction": 0.05},
        {"friction": 1.5},
        {"force_n": 0.5},
        {"force_n": 40.0},
        {"finger_mass_kg": 0.05},
        {"finger_mass_kg": 0.5},
    ],
    ids=str,
)
def test_the_bench_keeps_the_law_to_the_ends_of_its_range(fingers, iterations, changes):
    """A slow lift takes long, a light object many iterations: neither may look like a payload that is held or none."""
    spec = replace(spec_of(fingers, rated_kg=60.0, **changes), physics=PhysicsSettings(solver_iterations=iterations))
    assert not outside(spec)
    values = {"friction": 0.7, "force_n": 10.0, "acceleration_m_s2": 1.2, **changes}
    law_kg = values["friction"] * values["force_n"] * fingers / (9.81 + values["acceleration_m_s2"])
    result = run_bench(spec)
    assert result.limited_by is PayloadLimit.SLIP
    assert result.payload_kg == pytest.approx(law_kg, rel=BOUND)


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize("iterations", [20, 50])
@pytest.mark.parametrize("radius_m", [0.024, 0.035, 0.068])
def test_so_it_does_for_the_lowest_object(fingers, iterations, radius_m):
    (height,) = (quantity for quantity in VALIDATED if quantity.name == "height of the object")
    spec = replace(
        spec_of(fingers),
        physics=PhysicsSettings(solver_iterations=iterations),
        shape=Cylinder(radius_m=radius_m, height_m=height.lowest),
    )
    assert run_bench(spec).payload_kg == pytest.approx(0.7 * 10.0 * fingers / (9.81 + 1.2), rel=BOUND)


def test_pads_that_are_too_smooth_give_no_answer():
    with pytest.raises(DefinitionError, match=r"friction of finger and object of 0\.005, validated from 0\.05 to 1\.5"):
        run_bench(spec_of(3, friction=0.005))


def test_a_slack_threshold_finds_the_same_limit():
    tight, slack = (
        run_bench(replace(spec_of(2), settings=BenchSettings(largest_slip_m=slip))) for slip in (1e-3, 4e-3)
    )
    assert slack.payload_kg == pytest.approx(tight.payload_kg, rel=0.01)


def test_benches_agree_bit_for_bit_in_this_process_and_in_another():
    # Text hashing is seeded differently there, so that the order of a set would show.
    environment = {**os.environ, "PYTHONHASHSEED": "12345", "PYTHONPATH": str(Path(__file__).parents[3])}
    program = (
        "import runpy, sys\n"
        "from rgss.trials.payload_bench.bench import run_bench\n"
        "spec_of = runpy.run_path(sys.argv[1])['spec_of']\n"
        "print(*(run_bench(spec_of(fingers)) for fingers in (2, 3)), sep='\\n')\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, __file__], capture_output=True, text=True, check=True, env=environment
    )
    here = [repr(run_bench(spec_of(fingers))) for fingers in (2, 3)]
    assert here == [repr(run_bench(spec_of(fingers))) for fingers in (2, 3)]
    assert run.stdout.splitlines() == here


def test_a_bench_takes_few_steps(monkeypatch):
    """By the number of steps, which no other work of the machine changes."""
    step, steps = pybullet.stepSimulation, []
    monkeypatch.setattr(pybullet, "stepSimulation", lambda *given, **named: steps.append(1) or step(*given, **named))
    run_bench(spec_of(3))
    assert 100 < len(steps) < 20_000
