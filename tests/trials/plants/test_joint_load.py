"""Torques of joints, summed up by hand."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.scenes import Joint
from rgss.trials.plants.joint_load import JointLoad

LIMITS = (300.0, 50.0)


def joint(name, limit):
    return Joint(name=name, lower_rad=-1.0, upper_rad=1.0, speed_rad_s=1.0, acceleration_rad_s2=1.0, torque_n_m=limit)


def load_of(*steps):
    load = JointLoad([joint("shoulder", LIMITS[0]), joint("wrist", LIMITS[1])])
    for torques in steps:
        load.note(torques, 0.25)
    return load


def test_peaks_are_magnitudes_and_the_ratio_is_the_worst_joints():
    load = load_of((30.0, -10.0), (-60.0, 5.0), (0.0, 0.0))

    assert load.metrics() == {
        "peak_joint_torque_n_m": (60.0, 10.0),
        "peak_joint_torque_ratio": pytest.approx(0.2),
        "most_loaded_joint": 1,
        "joint_saturated_s": (0.0, 0.0),
    }
    assert (load.saturated, load.words()) == ([], "")


@pytest.mark.verifies("SYS-016")
def test_joints_at_their_limit_are_named_in_the_order_in_which_they_reached_it():
    load = load_of((30.0, -50.0), (300.0, 50.0), (-300.0, 20.0), (0.0, 0.0))

    assert load.saturated == [1, 0]
    assert load.words() == "; at its torque limit: wrist, then shoulder"
    assert load.metrics()["joint_saturated_s"] == (0.5, 0.5)
    assert load.metrics()["peak_joint_torque_ratio"] == 1.0
    assert load.metrics()["most_loaded_joint"] == 1


def test_what_a_controller_asks_for_beyond_the_limit_is_not_given():
    load = load_of((900.0, 0.0))

    assert load.metrics()["peak_joint_torque_n_m"] == (300.0, 0.0)
    assert load.saturated == [0]


def test_just_below_the_limit_is_not_at_it():
    assert load_of((0.99999 * LIMITS[0], 0.0)).saturated == []


def test_no_step_is_no_load():
    assert load_of().metrics()["peak_joint_torque_n_m"] == (0.0, 0.0)


def test_steps_may_be_added_one_by_one_or_all_at_once():
    rng = np.random.default_rng(5)
    steps = rng.normal(0.0, 0.6, (200, 2)) * LIMITS
    apart, together = load_of(), load_of()
    for torques in steps.tolist():
        apart.note(torques, 0.25)
    for part in np.split(steps, [3, 90]):
        together.note_all(part, 0.25)

    assert len(apart.saturated) == 2
    assert (apart.metrics(), apart.saturated) == (together.metrics(), together.saturated)
    assert apart.metrics()["joint_saturated_s"] == tuple(
        0.25 * count for count in (np.abs(steps) >= LIMITS).sum(axis=0).tolist()
    )
