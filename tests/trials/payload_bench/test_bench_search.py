"""The search for the payload, with a probe that needs no physics, and the bench's inputs."""

from dataclasses import replace

import pytest

from rgss.errors import DefinitionError
from rgss.physics import MOST_ITERATIONS, PhysicsSettings
from rgss.scenes import Box, Cylinder, Gripper, GripperGeometry
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.payload_bench.range import outside
from rgss.trials.payload_bench.rig import PayloadLimit, Probe
from rgss.trials.payload_bench.spec import BenchSettings, BenchSpec
from rgss.trials.pieces.input_digests import bench_digest

VERSIONS = {"pybullet": "3.2.7", "rgss-bench": "abc", "ompl": "1.7.0", "rgss-plan": "def"}

GRIPPER = Gripper(
    geometry=GripperGeometry(
        id="hand",
        azimuths_rad=(0.0, 2.0, 4.0),
        base=Cylinder(radius_m=0.05, height_m=0.085),
        finger=Box(size_m=(0.012, 0.02, 0.09)),
        largest_opening_m=0.07,
        stroke_m=0.048,
        grasp_depth_m=0.145,
    ),
    base_mass_kg=0.4,
    finger_mass_kg=0.3,
    finger_velocity_m_s=0.04,
    finger_force_n=10.0,
    friction=0.7,
)
SPEC = BenchSpec(
    gripper=GRIPPER,
    shape=Cylinder(radius_m=0.035, height_m=0.1),
    object_friction=0.5,
    force_limit_n=40.0,
    gravity_m_s2=9.8,
    acceleration_m_s2=1.2,
    rated_kg=10.0,
)


def failing_above(limit_kg: float, why: PayloadLimit):
    """A probe that tries masses against a known limit."""

    def probe_mass(spec: BenchSpec, mass_kg: float) -> Probe:
        return Probe(
            mass_kg=mass_kg,
            stopped_by=why if mass_kg > limit_kg else None,
            slip_m=0.0,
            creep_m_s=None,
            peak_force_n=10.0,
            grip_margin_min=None,
        )

    return probe_mass


@pytest.mark.parametrize("limit_kg", [0.042, 0.3, 0.9375, 1.2345, 9.99])
@pytest.mark.parametrize("why", [PayloadLimit.SLIP, PayloadLimit.DAMAGE])
@pytest.mark.parametrize("resolution", [0.05, 0.005, 1e-6])
def test_the_bracket_holds_the_limit_as_narrowly_as_asked(limit_kg, why, resolution):
    spec = replace(SPEC, settings=BenchSettings(resolution=resolution))
    result = run_bench(spec, probe_mass=failing_above(limit_kg, why))
    low, high = result.bracket_kg
    assert low <= limit_kg < high
    assert high - low <= resolution * high
    assert result.payload_kg == low
    assert result.limited_by is why


def test_thirteen_masses_settle_it_to_half_a_percent():
    result = run_bench(SPEC, probe_mass=failing_above(0.9, PayloadLimit.SLIP))
    assert result.trials == len(result.probes) == 13
    tried = [probe.mass_kg for probe in result.probes]
    assert tried[:2] == [SPEC.first_kg, SPEC.rated_kg]
    assert set(result.bracket_kg) <= set(tried)


def test_the_search_does_not_know_the_theory():
    other = replace(SPEC, gripper=replace(GRIPPER, friction=0.1), acceleration_m_s2=3.0)
    masses = [
        [probe.mass_kg for probe in run_bench(spec, probe_mass=failing_above(0.9, PayloadLimit.SLIP)).probes]
        for spec in (SPEC, other)
    ]
    assert masses[0] == masses[1]


def test_a_hand_that_holds_the_rated_mass_is_limited_by_that():
    result = run_bench(SPEC, probe_mass=failing_above(11.0, PayloadLimit.SLIP))
    assert (result.payload_kg, result.limited_by) == (10.0, PayloadLimit.RATED)
    assert result.bracket_kg == (10.0, 10.0)
    assert result.trials == 2


@pytest.mark.parametrize("why", [PayloadLimit.DAMAGE, PayloadLimit.NO_FIRM_GRASP, PayloadLimit.SLIP])
def test_a_hand_that_does_not_even_hold_the_smallest_mass_has_no_payload(why):
    result = run_bench(SPEC, probe_mass=failing_above(0.0, why))
    assert (result.payload_kg, result.limited_by) == (0.0, why)
    # Only of slipping a lighter object does less.
    assert result.bracket_kg == (0.0, SPEC.smallest_kg if why is PayloadLimit.SLIP else SPEC.first_kg)


@pytest.mark.parametrize("limit_kg", [0.006, 0.02, 0.0416])
def test_a_payload_below_the_first_mass_is_found_below_it(limit_kg):
    """With more iterations of the solver, for the engine passes a finger's force through heavier bodies sooner."""
    result = run_bench(SPEC, probe_mass=failing_above(limit_kg, PayloadLimit.SLIP))
    low, high = result.bracket_kg
    assert low <= limit_kg < high <= SPEC.first_kg
    assert result.payload_kg == low
    assert high - low <= SPEC.settings.resolution * high


def test_a_lighter_object_takes_more_iterations_and_a_heavier_one_those_of_the_study():
    assert SPEC.physics_for(1.0) is SPEC.physics
    assert SPEC.physics_for(SPEC.lightest_body_kg) is SPEC.physics
    assert SPEC.physics_for(SPEC.lightest_body_kg / 4).solver_iterations == 200
    assert SPEC.physics_for(1e-6).solver_iterations == MOST_ITERATIONS


def test_the_hand_rises_by_more_than_an_object_may_slip_however_small_the_acceleration():
    """What cannot be carried stays on the post, and slips by as much as the hand rises."""
    for acceleration in (10.0, 0.5, 0.0125, 0.001):
        spec = replace(SPEC, acceleration_m_s2=acceleration)
        assert acceleration * spec.lift_s**2 / 2 >= 4 * spec.settings.largest_slip_m
        assert spec.lift_s >= spec.settings.lift_s
    assert replace(SPEC, acceleration_m_s2=0.5).lift_s == SPEC.settings.lift_s


def test_the_search_begins_where_the_solver_can_press_with_the_whole_force():
    # 2 * 10 N / (50 iterations * 0.04 m/s * 240 Hz), by hand.
    assert SPEC.lightest_body_kg == pytest.approx(0.0416667, abs=1e-6)
    assert SPEC.first_kg == SPEC.lightest_body_kg
    finer = replace(SPEC, physics=PhysicsSettings(rate_hz=1000.0))
    assert finer.first_kg == pytest.approx(0.01, abs=1e-9)
    assert SPEC.smallest_kg == finer.smallest_kg == SPEC.settings.smallest_kg == 0.005


def test_the_reason_is_that_of_the_mass_next_above():
    """Heavier masses may fail in another way."""
    slips, breaks = (failing_above(1.0, why) for why in (PayloadLimit.SLIP, PayloadLimit.DAMAGE))
    result = run_bench(SPEC, probe_mass=lambda spec, mass: (breaks if mass > 2.0 else slips)(spec, mass))
    assert result.limited_by is PayloadLimit.SLIP


def test_theory_stands_beside_the_result():
    result = run_bench(SPEC, probe_mass=failing_above(0.9, PayloadLimit.SLIP))
    # 0.7 * 0.5 * 3 * 10 N / (9.8 + 1.2) m/s², by hand.
    assert result.theory_kg == pytest.approx(0.954545, abs=1e-6)
    assert result.eq_4_8_kg == pytest.approx(0.636364, abs=1e-6)


def changed_gripper(**changes):
    return {"gripper": replace(GRIPPER, **changes)}


def changed_settings(**changes):
    return {"settings": replace(SPEC.settings, **changes)}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"acceleration_m_s2": 0.0},
            "the acceleration of a payload bench must be positive, got 0 (give a number above zero)",
        ),
        ({"acceleration_m_s2": float("nan")}, "the acceleration of a payload bench must be positive, got nan"),
        ({"rated_kg": float("inf")}, "the rated mass of a payload bench must be positive, got inf"),
        (changed_settings(lift_s=-1.0), "the time of the lift of a payload bench must be positive, got -1"),
        (changed_settings(smallest_kg=0.0), "the smallest mass of a payload bench must be positive, got 0"),
        (changed_settings(largest_slip_m=0.0), "the largest slip of a payload bench must be positive, got 0"),
        (changed_gripper(finger_force_n=0.0), "the force of a finger of a payload bench must be positive, got 0"),
        (
            changed_gripper(finger_velocity_m_s=0.0),
            "the velocity of a finger of a payload bench must be positive, got 0",
        ),
        (
            changed_settings(resolution=1.0),
            "the resolution of a payload bench must be from 1e-06 to below 1, got 1",
        ),
        (changed_settings(resolution=0.0), "the resolution of a payload bench must be from 1e-06 to below 1, got 0"),
        (
            {"rated_kg": 0.04},
            (
                "the smallest mass of 0.0417 kg is not below the rated 0.04 kg "
                "(give the bench a rated mass above the smallest one)"
            ),
        ),
        (
            changed_gripper(finger_mass_kg=0.001),
            "fingers of 0.001 kg are too light for the solver to press with 10 N; it needs 0.00104 kg (state",
        ),
        (
            {"shape": Cylinder(radius_m=0.07, height_m=0.1)},
            "an object of radius 0.07 m does not fit into gripper 'hand', which opens to 0.07 m (use a thinner",
        ),
        (
            {"shape": Cylinder(radius_m=0.035, height_m=0.12)},
            (
                "an object of height 0.12 m gripped at its centre collides with the base of gripper 'hand', "
                "which is 0.06 m above"
            ),
        ),
    ],
)
def test_what_cannot_be_tried_is_refused(changes, message):
    with pytest.raises(DefinitionError) as error:
        run_bench(replace(SPEC, **changes), probe_mass=failing_above(1.0, PayloadLimit.SLIP))
    assert str(error.value).startswith(message)


@pytest.mark.parametrize(
    "changes",
    [
        changed_gripper(base_mass_kg=0.2),
        changed_gripper(finger_mass_kg=0.2),
        changed_gripper(finger_velocity_m_s=0.05),
        changed_gripper(finger_force_n=11.0),
        changed_gripper(friction=0.6),
        changed_gripper(geometry=replace(GRIPPER.geometry, stroke_m=0.04)),
        {"shape": Cylinder(radius_m=0.03, height_m=0.1)},
        {"object_friction": 0.6},
        {"force_limit_n": 30.0},
        {"gravity_m_s2": 1.62},
        {"acceleration_m_s2": 2.0},
        {"rated_kg": 5.0},
        {"physics": PhysicsSettings(rate_hz=480.0)},
        changed_settings(resolution=0.01),
    ],
)
def test_every_input_is_in_the_digest(changes):
    assert bench_digest(replace(SPEC, **changes), VERSIONS) != bench_digest(SPEC, VERSIONS)


def test_what_is_no_input_is_not_in_the_digest():
    renamed = replace(SPEC, **changed_gripper(geometry=replace(GRIPPER.geometry, id="other")))
    assert bench_digest(renamed, VERSIONS) == bench_digest(SPEC, VERSIONS)
    assert bench_digest(SPEC, {**VERSIONS, "ompl": "1.8.0", "rgss-plan": "other"}) == bench_digest(SPEC, VERSIONS)


@pytest.mark.parametrize("name", ["pybullet", "rgss-bench"])
def test_engine_and_code_are_in_the_digest(name):
    assert bench_digest(SPEC, {**VERSIONS, name: "another"}) != bench_digest(SPEC, VERSIONS)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"acceleration_m_s2": 5e-4}, "acceleration of 0.0005 m/s², validated from 0.001 to 10 m/s²"),
        ({"gravity_m_s2": 30.0}, "gravity of 30 m/s², validated from 1.6 to 12 m/s²"),
        (changed_gripper(friction=0.03), "friction of finger and object of 0.015, validated from 0.05 to 1.5"),
        (changed_gripper(finger_force_n=0.4), "force of a finger of 0.4 N, validated from 0.5 to 40 N"),
        (
            changed_gripper(finger_mass_kg=0.01),
            "mass of a finger with its drive of 0.01 kg, validated from 0.02 to 0.5 kg",
        ),
        (
            changed_gripper(finger_velocity_m_s=0.12),
            "velocity of a finger of 0.12 m/s, validated from 0.005 to 0.1",
        ),
        (
            {"shape": Cylinder(radius_m=0.035, height_m=0.002)},
            "height of the object of 0.002 m, validated from",
        ),
    ],
)
def test_outside_of_its_validated_range_the_bench_gives_no_answer(changes, sentence):
    spec = replace(SPEC, **changes)
    assert any(found.startswith(sentence) for found in outside(spec))
    with pytest.raises(DefinitionError, match="the payload bench is not validated for "):
        run_bench(spec, probe_mass=failing_above(0.9, PayloadLimit.SLIP))


def test_within_its_range_it_does():
    assert outside(SPEC) == ()
