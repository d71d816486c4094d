"""Fingers that are light, strong and slow: they keep to their speed in MuJoCo, and press with their force."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.physics.mujoco.finger_drive import is_servo_stable
from rgss.studies import load_project, trial_specs
from rgss.trials.second_engine import mujoco_settings
from tests.fixtures.shared_trials import record_without_bench
from tests.fixtures.shipped_project import REPOSITORY

pytestmark = pytest.mark.engine

SETTINGS = mujoco_settings()
STEP_S = 1.0 / SETTINGS.rate_hz
SPEED_M_S = 0.025


@pytest.mark.parametrize("fingers", [2, 3])
@pytest.mark.parametrize(("force_n", "finger_mass_kg"), [(10.0, 0.3), (20.0, 0.02), (8.0, 0.02), (200.0, 0.01)])
def test_a_free_finger_moves_at_its_speed_both_ways(scene, gripper_with, fingers, force_n, finger_mass_kg):
    gripper = replace(
        gripper_with(fingers, force_n=force_n, finger_mass_kg=finger_mass_kg), finger_velocity_m_s=SPEED_M_S
    )
    assert is_servo_stable(gripper, STEP_S) == (finger_mass_kg == 0.3)
    with SETTINGS.open(scene, gripper) as world:
        for sign, steps in ((1.0, 1200), (-1.0, 600)):
            world.drive_fingers(sign * SPEED_M_S, force_n)
            travels = []
            for _ in range(steps):
                world.step()
                travels.append(world.finger_travel_m())
            speeds = np.diff(np.array(travels), axis=0) / STEP_S
            assert np.abs(speeds).max() <= 1.25 * SPEED_M_S
            assert speeds[400:] == pytest.approx(sign * SPEED_M_S, rel=0.2)


@pytest.mark.slow
def test_a_widget_is_gripped_and_released_in_the_time_that_the_first_engine_takes():
    """The YuMi's fingers of 20 g press with 20 N and move at 25 mm/s: a servo would move them twenty times as fast."""
    project = load_project(REPOSITORY, "studies/yumi_widget.yaml")
    (spec,) = trial_specs(project, variants=[project.designs.variant(20)], seeds=[1])
    settings = replace(spec.settings, physics=SETTINGS)
    first, second = (record_without_bench(one) for one in (spec, replace(spec, settings=settings)))
    assert first.success
    assert second.success
    assert second.metrics["grasp_cycle_time_s"] == pytest.approx(first.metrics["grasp_cycle_time_s"], rel=0.05)
    for own, other in zip(first.phases, second.phases, strict=True):
        if (forces := own.metrics.get("finger_force_n")) is not None:
            assert other.metrics["finger_force_n"] == pytest.approx(forces, rel=0.05)
