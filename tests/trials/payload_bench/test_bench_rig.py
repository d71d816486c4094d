"""The rig of the payload bench: what it does with the hand, and what it sees."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import SimulationError
from rgss.physics import PhysicsSettings
from rgss.scenes import Cylinder, Gripper, load_gripper, load_scene
from rgss.trials.payload_bench.rig import PayloadLimit, PayloadRig, probe
from rgss.trials.payload_bench.spec import BenchSpec, bench_spec

pytestmark = pytest.mark.engine

SCENES = Path(__file__).parents[3] / "scenes"


@pytest.fixture(params=[2, 3], ids=["two fingers", "three fingers"])
def spec(request) -> BenchSpec:
    gripper = Gripper(
        geometry=load_gripper(SCENES / f"grippers/kg-{request.param}.yaml"),
        base_mass_kg=0.4,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    return bench_spec(load_scene(SCENES / "restaurant.yaml"), gripper, acceleration_m_s2=1.2, rated_kg=10.0)


def test_the_spec_takes_object_and_gravity_from_the_scene(spec):
    scene = load_scene(SCENES / "restaurant.yaml")
    assert spec.shape == scene.workpiece.shape
    assert spec.object_friction == scene.workpiece.friction
    assert spec.force_limit_n == scene.workpiece.force_limit_n
    assert spec.gravity_m_s2 == scene.gravity_m_s2


@pytest.mark.parametrize("mass_kg", [0.1, 1.0])
@pytest.mark.parametrize("acceleration_m_s2", [0.5, 4.0])
def test_the_hand_rises_as_a_constant_acceleration_lets_it(spec, mass_kg, acceleration_m_s2):
    spec = replace(spec, force_limit_n=1e6, settings=replace(spec.settings, largest_slip_m=10.0))
    with PayloadRig(spec, mass_kg) as rig:
        rig.grasp()
        before = rig.hand_pose()
        rig.accelerate(acceleration_m_s2, 0.4)
        after = rig.hand_pose()
    risen = [b - a for a, b in zip(before.position_m, after.position_m, strict=True)]
    assert risen == pytest.approx([0.0, 0.0, acceleration_m_s2 * 0.4**2 / 2], abs=1e-6)
    assert rig.height_m == pytest.approx(risen[2], abs=1e-6)
    assert rig.speed_m_s == pytest.approx(0.4 * acceleration_m_s2)


def test_the_object_is_gripped_at_its_centre_and_leaves_the_post(spec):
    with PayloadRig(spec, 0.5) as rig:
        assert rig.hand_pose().position_m == pytest.approx((0.0, 0.0, spec.shape.half_height_m), abs=1e-7)
        rig.grasp()
        assert rig.contacts().workpiece_bodies == ("post",)
        rig.accelerate(1.2, 0.2)
        contacts = rig.contacts()
    assert contacts.workpiece_bodies == contacts.robot_bodies == ()
    assert contacts.other_force_n == 0.0
    assert rig.stopped_by is None


def test_each_finger_presses_with_its_force_however_heavy_the_object(spec):
    with PayloadRig(spec, 5.0) as rig:
        rig.grasp()
        forces = rig.contacts().finger_forces_n
    assert forces == pytest.approx([10.0] * len(forces), rel=0.01)


def test_friction_carries_mass_times_gravity_and_acceleration(spec):
    with PayloadRig(spec, 0.8) as rig:
        rig.grasp()
        rig.accelerate(2.0, 0.4)
        friction = rig.contacts().friction_n
    load = 0.8 * (9.81 + 2.0)
    assert friction[2] == pytest.approx(load, rel=0.01)
    assert friction[:2] == pytest.approx((0.0, 0.0), abs=0.01 * load)


@pytest.mark.parametrize("share", [0.3, 0.9])
def test_the_grip_margin_is_that_of_theory(spec, share):
    assert probe(spec, share * spec.theory_kg).grip_margin_min == pytest.approx(1 / share, rel=0.01)


def test_a_held_object_does_not_creep_while_it_is_lifted(spec):
    found = probe(spec, 0.9 * spec.theory_kg)
    assert found.held
    assert abs(found.creep_m_s) < 1e-5


def test_a_held_object_does_not_creep_while_the_hand_stands(spec):
    mass_kg = 0.9 * spec.friction * spec.total_force_n / spec.gravity_m_s2
    with PayloadRig(spec, mass_kg) as rig:
        rig.grasp()
        rig.accelerate(0.2, 0.1)
        rig.accelerate(-0.2, 0.1)
        rig.accelerate(0.0, 0.2)
        assert rig.contacts().workpiece_bodies == ()
        before = rig.slip_m
        rig.accelerate(0.0, 1.0)
    assert rig.stopped_by is None
    assert abs(rig.slip_m - before) < 1e-5  # in one second


def test_what_slips_is_left_behind_by_newtons_law(spec):
    """Above the limit by a share s with the acceleration s (g + a) / (1 + s).

    Sliding friction is up to 1 % less than Coulomb's: contact points of a sliding object are found anew, and a pad
    takes a moment to press again. The limit is not touched by that, as it is before the first slip.
    """
    spec = replace(spec, physics=PhysicsSettings(rate_hz=1000.0), settings=replace(spec.settings, largest_slip_m=1.0))
    with PayloadRig(spec, 1.02 * spec.theory_kg) as rig:
        rig.grasp()
        rig.accelerate(spec.acceleration_m_s2, 0.4)
    least, greatest = ((1 - share / 1.02) * (9.81 + 1.2) * 0.4**2 / 2 for share in (1.0, 0.99))
    assert 0.95 * least < rig.slip_m < greatest


@pytest.mark.parametrize(("share", "firm"), [(1.1, True), (0.3, False)])
def test_the_solver_presses_no_more_than_its_iterations_pass_on(spec, share, firm, monkeypatch):
    """Iterations times M v / dt: a finger of that mass comes to its force, a much lighter one never does.

    A rigid pad needs that mass; one that yields lets the motor pass on up to 1.7 times as much.
    """
    monkeypatch.setattr(PhysicsSettings, "passing", lambda self, **_: self)
    found = probe(light_fingered(spec, share), 0.5)
    assert found.held == firm
    assert found.peak_force_n < 11.0 * min(1.0, 1.7 * share)


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_light_fingers_take_as_many_iterations_as_they_need(spec, share):
    assert probe(light_fingered(spec, share), 0.5).held


def light_fingered(spec, share):
    """With fingers of a share of the mass that passes their force in 50 iterations."""
    needed_kg = spec.gripper.finger_force_n / (50 * 0.04 * 240.0)
    light = replace(spec, gripper=replace(spec.gripper, finger_mass_kg=share * needed_kg))
    return replace(light, settings=replace(light.settings, firm_share=0.95))


def test_the_rig_stops_at_the_first_slip(spec):
    found = probe(spec, 2.0 * spec.theory_kg)
    assert found.stopped_by is PayloadLimit.SLIP
    assert not found.held
    assert 1e-3 < found.slip_m < 3e-3
    assert found.creep_m_s is None
    assert found.grip_margin_min == pytest.approx(0.5, rel=0.1)


def test_a_finger_that_presses_too_hard_damages_the_object(spec):
    found = probe(replace(spec, force_limit_n=9.5), 0.25)
    assert found.stopped_by is PayloadLimit.DAMAGE
    assert found.peak_force_n > 9.5
    assert found.grip_margin_min is None


@pytest.mark.parametrize("rate_hz", [240.0, 500.0, 1000.0, 4000.0])
def test_closing_strikes_with_the_momentum_of_a_finger_whatever_the_step(spec, rate_hz):
    """The finger's force, and over the window its momentum: F + M_f v_f / w."""
    struck_n = 10.0 + 0.3 * 0.04 / spec.force_window_s
    spec = replace(spec, physics=PhysicsSettings(rate_hz=rate_hz))
    assert probe(spec, 1.0).peak_force_n == pytest.approx(struck_n, rel=0.1 if rate_hz < 500.0 else 0.02)
    assert probe(replace(spec, force_limit_n=0.9 * struck_n), 1.0).stopped_by is PayloadLimit.DAMAGE
    assert probe(replace(spec, force_limit_n=1.1 * struck_n), 1.0).held


@pytest.mark.parametrize("radius_m", [0.015, 0.0215])
def test_fingers_that_do_not_reach_the_object_have_no_grasp(spec, radius_m):
    slim = replace(spec, shape=Cylinder(radius_m=radius_m, height_m=0.1))
    found = probe(slim, 0.1)
    assert found.stopped_by is PayloadLimit.NO_FIRM_GRASP
    assert found.peak_force_n == 0.0


def test_fingers_that_do_not_oppose_one_another_have_no_grasp(spec):
    if spec.gripper.geometry.fingers == 3:
        azimuths = (0.0, math.radians(60), math.radians(120))
    else:
        azimuths = (0.0, math.radians(90))
    geometry = replace(spec.gripper.geometry, azimuths_rad=azimuths)
    found = probe(replace(spec, gripper=replace(spec.gripper, geometry=geometry)), 0.25)
    assert found.stopped_by is PayloadLimit.NO_FIRM_GRASP


@pytest.mark.parametrize("shape", [Cylinder(radius_m=0.025, height_m=0.1), Cylinder(radius_m=0.05, height_m=0.05)])
def test_the_limit_does_not_depend_on_the_size_of_the_object(spec, shape):
    spec = replace(spec, shape=shape)
    assert probe(spec, 0.98 * spec.theory_kg).held
    assert probe(spec, 1.02 * spec.theory_kg).stopped_by is PayloadLimit.SLIP


def test_the_rig_closes_its_world(spec):
    with PayloadRig(spec, 0.25) as rig:
        pass
    assert rig._world._client < 0


def test_a_mass_that_no_body_has_is_refused(spec):
    with pytest.raises(SimulationError, match="the mass of the workpiece must be positive, got 0 kg"):
        probe(spec, 0)
