"""Every kind of gripper carries an object that it can hold, and says why it cannot hold another."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes import Cylinder
from rgss.trials.hands import hand_of
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import FILES, HELD, UNFIT, gripper_of


@pytest.mark.parametrize("fidelity", Fidelity)
@pytest.mark.parametrize("name", FILES)
def test_an_object_that_fits_is_carried_to_its_place(trial, name, fidelity):
    spec = trial(name, fidelity)

    record = record_without_bench(spec)

    assert record.failure_detail == ""
    assert record.success
    phases = {phase.phase: phase for phase in record.phases}
    hand = hand_of(spec.gripper)
    firm_s, step_s = spec.settings.control.firm_grasp_s, spec.settings.physics.step_s
    # In contact a drive passes the force over a few steps, and opens over its whole stroke.
    slack_s = 0.02 if fidelity is Fidelity.CONTACT else 1.1 * step_s
    assert phases["grasp"].duration_s == pytest.approx(hand.closing_s(spec.scene, firm_s), abs=slack_s)
    assert phases["place"].metrics["opening_s"] == pytest.approx(hand.opening_s(spec.scene), abs=slack_s)


@pytest.mark.parametrize("fidelity", Fidelity)
@pytest.mark.parametrize("name", FILES)
def test_an_object_that_does_not_fit_fails_at_the_grasp_with_the_reason(trial, name, fidelity):
    spec = trial(name, fidelity, radius_m=UNFIT[name])

    record = record_without_bench(spec)

    assert (record.failed_phase, record.failure) == ("grasp", Failure.NO_FIRM_GRASP)
    assert record.failure_detail == hand_of(spec.gripper).misfit(spec.scene)
    assert f"{2e3 * UNFIT[name]:g} mm" in record.failure_detail


@pytest.mark.parametrize("fidelity", Fidelity)
def test_what_is_too_wide_for_a_mounting_is_not_entered(trial, fidelity):
    record = record_without_bench(trial("parallel", fidelity, radius_m=0.019))

    assert record.failed_phase == "move_to_grasp"
    assert record.failure_detail == (
        "no valid configuration for grasp: cup, 38 mm across, is too wide to enter gripper lite6 in its mounting "
        "reverse, which opens to 38 mm"
    )


@pytest.mark.parametrize("name", FILES)
def test_a_hand_needs_more_force_for_more_weight_or_as_much_as_is_stated(tmp_path, name):
    gripper = gripper_of(tmp_path, name)
    hand = hand_of(gripper)
    fingers = max(1, gripper.geometry.fingers)
    light_n, heavy_n = hand.needed_force_n(1.0, 0.5), hand.needed_force_n(2.0, 0.5)

    if gripper.drive.firm_force_n is not None:
        assert light_n == heavy_n == 5.0
    else:
        assert heavy_n == pytest.approx(2 * light_n)
    whole_n = (gripper.finger_force_n,) * fingers
    assert hand.is_firm(whole_n, light_n)
    assert not hand.is_firm((0.0,) * fingers, light_n)
    assert "N" in hand.shortfall(whole_n, light_n)


def test_a_command_takes_as_long_as_the_text_says(trial):
    record = record_without_bench(trial("open-loop", Fidelity.CONTACT))

    assert record.metrics["grasp_cycle_time_s"] == pytest.approx(2 * 0.275, abs=0.01)


def test_a_cup_is_torn_off_by_an_object_that_is_too_heavy(trial):
    lifted = record_without_bench(trial("vacuum", Fidelity.CONTACT, mass_kg=1.3))
    weighed = record_without_bench(trial("vacuum", Fidelity.CONTACT, mass_kg=1.5))

    # 1.3 kg weigh less than the 13.5 N that the cup holds, and more while they are accelerated upwards.
    assert (lifted.failed_phase, lifted.failure) == ("lift", Failure.OBJECT_DROPPED)
    assert lifted.failure_detail.startswith("the cup holds 13.50 N along its axis, the object pulls with 1")
    assert (weighed.failed_phase, weighed.failure) == ("grasp", Failure.NO_FIRM_GRASP)
    assert weighed.failure_detail == "the cup holds 13.50 N, a firm grasp needs more than 14.71 N"


def at_rate(spec, rate_hz):
    return replace(spec, settings=replace(spec.settings, physics=replace(spec.settings.physics, rate_hz=rate_hz)))


def test_the_margin_of_a_cup_is_the_factor_by_which_its_load_could_grow(trial):
    phases = {}
    for mass_kg in (0.25, 0.5):
        record = record_without_bench(at_rate(trial("vacuum", Fidelity.CONTACT, mass_kg=mass_kg), 960.0))
        phases[mass_kg] = {phase.phase: phase.metrics for phase in record.phases}
        lift = phases[mass_kg]["lift"]
        # Over the centre of mass the load is the weight and the force of the acceleration, along the cup's axis.
        pull_n = mass_kg * (9.81 + lift["commanded_tool_acceleration_m_s2"])
        assert lift["grip_margin_min"] == pytest.approx(13.5 / pull_n, rel=0.02)
    # Where the tool moves sideways, inertia and the lever of the centre of mass bend the lip.
    across = [one["move_to_place_approach"]["grip_margin_min"] for one in phases.values()]
    assert across[0] == pytest.approx(2 * across[1], rel=0.02)
    assert across[1] < phases[0.5]["lift"]["grip_margin_min"]

    # In coarse steps the pull jumps as the object leaves its support.
    coarse = record_without_bench(trial("vacuum", Fidelity.CONTACT, mass_kg=0.5))
    (lift,) = (phase.metrics for phase in coarse.phases if phase.phase == "lift")
    assert 0.9 < lift["grip_margin_min"] / phases[0.5]["lift"]["grip_margin_min"] < 1.0

    torn = record_without_bench(trial("vacuum", Fidelity.CONTACT, mass_kg=1.3))
    assert 0.8 < torn.metrics["grip_margin_min"] < 1.0


@pytest.mark.parametrize(
    ("changes", "phase", "start"),
    [
        ({"largest_gap_m": 1e-3}, "grasp", "the cup is 1.5 mm above the object, it seals within 1 mm"),
        (
            {"tangential_force_n": 0.3},
            "move_to_place_approach",
            "the cup holds 0.27 N across its axis, the object pulls with 0.2",
        ),
    ],
)
def test_a_seal_has_its_limits(trial, changes, phase, start):
    spec = trial("vacuum", Fidelity.CONTACT, mass_kg=0.5)
    suction = replace(spec.gripper.suction, **changes)

    record = record_without_bench(replace(spec, gripper=replace(spec.gripper, suction=suction)))

    assert record.failed_phase == phase
    assert record.failure_detail.startswith(start)


def test_a_cup_that_is_off_the_top_does_not_seal(trial):
    spec = trial("vacuum", Fidelity.CONTACT)
    own = spec.gripper.geometry
    wide = replace(own, cup=Cylinder(radius_m=HELD.radius_m, height_m=own.cup.height_m))

    record = record_without_bench(replace(spec, gripper=replace(spec.gripper, geometry=wide)))

    assert record.failed_phase == "grasp"
    assert record.failure_detail.endswith(" mm off its place, and the face leaves it 0.00 mm")
