"""Grippers of every kind in MuJoCo: the laws that hold in PyBullet, and what both engines find."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure, Fidelity
from rgss.trials.hands import hand_of
from rgss.trials.payload_bench.bench import run_bench
from rgss.trials.second_engine import mujoco_settings
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import FILES, UNFIT

GRAVITY = 9.81
HELD_N = 13.5
"""Normal force of the cup less its leak."""


@pytest.fixture
def trial_in_mujoco(trial):
    """Makes the contact trial of a kind of gripper in MuJoCo."""

    def make(name, **changes):
        spec = trial(name, Fidelity.CONTACT, **changes)
        return replace(spec, settings=replace(spec.settings, physics=mujoco_settings()))

    return make


def phases_of(record):
    return {phase.phase: phase.metrics for phase in record.phases}


@pytest.mark.parametrize("name", FILES)
def test_an_object_that_fits_is_carried_to_its_place(trial, trial_in_mujoco, name):
    spec = trial_in_mujoco(name)
    record = record_without_bench(spec)
    first = record_without_bench(trial(name, Fidelity.CONTACT))

    assert record.failure_detail == ""
    assert record.success
    hand = hand_of(spec.gripper)
    durations_s = {phase.phase: phase.duration_s for phase in record.phases}
    closing_s = hand.closing_s(spec.scene, spec.settings.control.firm_grasp_s)
    assert durations_s["grasp"] == pytest.approx(closing_s, abs=0.02)
    assert phases_of(record)["place"]["opening_s"] == pytest.approx(hand.opening_s(spec.scene), abs=0.02)
    for phase in first.phases:
        # A phase ends on a whole step of 4.2 ms in PyBullet, where what a cup held comes to rest some steps later.
        assert durations_s[phase.phase] == pytest.approx(phase.duration_s, abs=10 / 240)
    assert record.metrics["slip_m"] < 5e-5
    assert record.metrics["place_error_m"] < 1e-4


@pytest.mark.parametrize("name", FILES)
def test_an_object_that_does_not_fit_fails_at_the_grasp_with_the_reason(trial_in_mujoco, name):
    spec = trial_in_mujoco(name, radius_m=UNFIT[name])
    record = record_without_bench(spec)

    assert (record.failed_phase, record.failure) == ("grasp", Failure.NO_FIRM_GRASP)
    assert record.failure_detail == hand_of(spec.gripper).misfit(spec.scene)


@pytest.mark.parametrize("mass_kg", [0.25, 0.5])
def test_the_margin_of_a_cup_is_the_factor_by_which_its_load_could_grow(trial, trial_in_mujoco, mass_kg):
    spec = trial("vacuum", Fidelity.CONTACT, mass_kg=mass_kg)
    fine = replace(spec.settings.physics, rate_hz=960.0)
    first = phases_of(record_without_bench(replace(spec, settings=replace(spec.settings, physics=fine))))
    second = phases_of(record_without_bench(trial_in_mujoco("vacuum", mass_kg=mass_kg)))

    lift = second["lift"]
    # Over the centre of mass the load is the weight and the force of the acceleration, along the cup's axis.
    pull_n = mass_kg * (GRAVITY + lift["commanded_tool_acceleration_m_s2"])
    assert lift["grip_margin_min"] == pytest.approx(HELD_N / pull_n, rel=0.04)
    # Tangential force and moment govern where the tool moves sideways.
    across = "move_to_place_approach"
    assert second[across]["grip_margin_min"] == pytest.approx(first[across]["grip_margin_min"], rel=0.01)
    assert second[across]["grip_margin_min"] < 0.7 * lift["grip_margin_min"]


@pytest.mark.parametrize(
    ("mass_kg", "changes", "phase", "start"),
    [
        (1.3, {}, "lift", "the cup holds 13.50 N along its axis, the object pulls with 1"),
        (1.5, {}, "grasp", "the cup holds 13.50 N, a firm grasp needs more than 14.71 N"),
        (0.5, {"largest_gap_m": 1e-3}, "grasp", "the cup is 1.5 mm above the object, it seals within 1 mm"),
        (
            0.5,
            {"tangential_force_n": 0.3},
            "move_to_place_approach",
            "the cup holds 0.27 N across its axis, the object pulls with 0.2",
        ),
    ],
)
def test_a_seal_has_its_limits(trial_in_mujoco, mass_kg, changes, phase, start):
    spec = trial_in_mujoco("vacuum", mass_kg=mass_kg)
    suction = replace(spec.gripper.suction, **changes)

    record = record_without_bench(replace(spec, gripper=replace(spec.gripper, suction=suction)))

    assert record.failed_phase == phase
    assert record.failure_detail.startswith(start)


@pytest.mark.parametrize("mass_kg", [0.1, 1.3])
def test_a_linkage_has_the_same_grip_margin_on_both_engines(trial, trial_in_mujoco, mass_kg):
    margins = [
        phases_of(record_without_bench(spec))["lift"]["grip_margin_min"]
        for spec in (trial("linkage", Fidelity.CONTACT, mass_kg=mass_kg), trial_in_mujoco("linkage", mass_kg=mass_kg))
    ]
    assert margins[1] == pytest.approx(margins[0], rel=0.01)


def test_both_engines_find_the_same_payload_of_a_linkage(bench):
    first = bench(240.0, 12.0)
    payloads_kg = [run_bench(spec).payload_kg for spec in (first, replace(first, physics=mujoco_settings()))]
    assert payloads_kg[1] == pytest.approx(payloads_kg[0], rel=0.02)
