"""Impact of a closing finger: its force by theory bounds what is sensed, and where the step must be finer."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.physics import PhysicsSettings
from rgss.trials.impact import LEAST_STEPS, closing_impact
from rgss.trials.payload_bench.of_trial import payload_bench
from rgss.trials.payload_bench.rig import PayloadRig

from .spec_changes import with_gripper, with_workpiece


def test_the_design_s_fingers_cannot_damage_the_cup_at_any_rate(spec_of):
    impact = closing_impact(spec_of())
    assert impact.greatest_n < impact.limit_n
    assert impact.is_resolved


@pytest.fixture
def heavy(spec_of):
    """1 kg at 0.2 m/s and 10 N: 2 M v / T is 40 N, and 1 kg on 100 kN/m has a half period of 9.9 ms."""
    return with_gripper(spec_of(), finger_mass_kg=1.0, finger_velocity_m_s=0.2, finger_force_n=10.0)


def test_momentum_bounds_a_short_impact_and_energy_a_long_one(heavy):
    impact = closing_impact(heavy)
    assert impact.duration_s == pytest.approx(9.93e-3, rel=1e-3)
    assert impact.greatest_n == pytest.approx(50.0)
    assert impact.least_rate_hz == pytest.approx(LEAST_STEPS / 0.01)
    longer = closing_impact(with_workpiece(heavy, force_window_s=0.001))
    assert longer.greatest_n == pytest.approx(10.0 + math.hypot(10.0, 0.2 * math.sqrt(1.0e5)))
    assert longer.least_rate_hz == pytest.approx(LEAST_STEPS / impact.duration_s)


@pytest.mark.parametrize(
    ("limit_n", "rate_hz", "is_resolved"),
    [
        (40.0, 240.0, False),
        (40.0, 500.0, False),
        (40.0, 1000.0, True),
        (50.1, 240.0, True),  # no impact of these fingers damages the object
        (6.9, 240.0, True),  # the grip alone damages it
    ],
)
def test_the_step_must_resolve_an_impact_on_which_damage_depends(heavy, limit_n, rate_hz, is_resolved):
    spec = with_workpiece(heavy, force_limit_n=limit_n)
    physics = replace(spec.settings.physics, rate_hz=rate_hz)
    spec = replace(spec, settings=replace(spec.settings, physics=physics))
    assert closing_impact(spec).is_resolved == is_resolved


def sensed_n(spec, rate_hz, share_of_step=0.0):
    """The force of closing on the payload bench, the impact beginning at a share of a step."""
    bench = payload_bench(spec)
    travel_m = share_of_step * spec.gripper.finger_velocity_m_s / rate_hz
    shape = replace(bench.shape, radius_m=bench.shape.radius_m - travel_m)
    physics = PhysicsSettings(rate_hz=rate_hz)
    with PayloadRig(replace(bench, shape=shape, physics=physics, force_limit_n=1.0e6), 0.25) as rig:
        rig.grasp()
        return rig.peak_force_n


@pytest.mark.engine
@pytest.mark.parametrize(("mass_kg", "speed_m_s"), [(0.4, 0.04), (0.4, 0.2), (1.0, 0.2), (1.0, 0.4), (4.0, 0.2)])
def test_from_the_rate_that_resolves_it_the_sensed_force_is_that_of_the_finest_step(heavy, mass_kg, speed_m_s):
    """Wherever in a step the impact begins; the pad's damping does not grow with the step."""
    spec = with_gripper(heavy, finger_mass_kg=mass_kg, finger_velocity_m_s=speed_m_s)
    impact = closing_impact(spec)
    finest_n = sensed_n(spec, 8000.0)
    assert spec.gripper.finger_force_n < finest_n < impact.greatest_n
    for rate_hz in (impact.least_rate_hz, 2.0 * impact.least_rate_hz):
        read_n = [sensed_n(spec, rate_hz, share) for share in (0.0, 0.25, 0.5, 0.75)]
        assert read_n == pytest.approx([finest_n] * len(read_n), rel=0.1)
