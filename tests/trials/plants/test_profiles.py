"""A task under another velocity profile and other limits: it is timed, verified and run as any other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity
from rgss.trials import TimingProfile, TimingSettings
from rgss.trials.executing import execute
from rgss.trials.pieces.timing_json import timing_from_json, timing_to_json
from rgss.trials.planning import plan_task
from rgss.trials.timing import time_task, timing_of
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import Phase

pytestmark = pytest.mark.engine

TRAPEZOID = TimingSettings(profile=TimingProfile.TRAPEZOID)


@pytest.fixture(scope="module")
def spec(spec_of):
    spec = spec_of(65)
    return replace(spec, fidelity=Fidelity.DYNAMIC, settings=replace(spec.settings, timing=TRAPEZOID))


@pytest.fixture(scope="module")
def plan(spec):
    return plan_task(cell_of(spec), spec.planner, seed=spec.seed, settings=spec.settings.planning)


@pytest.fixture(scope="module")
def timed(spec, plan):
    def run(timing):
        return time_task(
            cell_of(spec),
            plan,
            tool_speed_m_s=spec.tool_speed_m_s,
            settings=spec.settings.planning,
            timing=timing,
        )

    return run


def test_planned_moves_rest_at_their_waypoints_and_the_lift_does_not(spec, plan):
    timing = timing_of(spec, plan)
    assert not timing.failures
    for phase, trajectory in timing.trajectories.items():
        rests = trajectory.path(trajectory.parameters[trajectory.rates == 0.0])
        if phase == Phase.LIFT:
            assert len(trajectory.rates) <= 4
        else:
            for waypoint in plan.moves[phase].path_rad:
                assert np.min(np.linalg.norm(rests - waypoint, axis=1)) < 1e-9


def test_it_takes_longer_than_the_time_optimal_motion(timed):
    optimal, trapezoid = timed(TimingSettings()), timed(TRAPEZOID)
    for phase in optimal.trajectories:
        assert trapezoid.trajectories[phase].duration_s > 0.999 * optimal.trajectories[phase].duration_s


@pytest.mark.parametrize("profile", list(TimingProfile))
def test_a_share_of_the_joints_speeds_is_kept(spec, timed, profile):
    trajectories = timed(TimingSettings(profile=profile, peak_speed=0.1, peak_acceleration=0.2)).trajectories
    fastest = np.array([joint.speed_rad_s for joint in spec.scene.robot.joints])
    used = 0.0
    for trajectory in trajectories.values():
        times = np.linspace(0.0, trajectory.duration_s, 4000)
        speeds = np.diff(trajectory.positions(times), axis=0) / times[1]
        used = max(used, float(np.max(np.abs(speeds) / fastest)))
    assert 0.098 < used <= 0.1 * 1.005


def test_its_text_is_exact(spec, plan):
    text = timing_to_json(timing_of(spec, plan))
    assert timing_to_json(timing_from_json(text)) == text


def test_it_runs_under_computed_torque(spec, plan):
    results = execute(spec, cell_of(spec), timing_of(spec, plan))
    assert [result.failure for result in results] == [None] * len(Phase)


def test_a_motion_that_touches_something_fails(spec, plan, monkeypatch):
    cell = cell_of(spec)

    class Nothing:
        def is_valid(self, q):
            return False

    running = {**cell.running, Phase.MOVE_TO_PLACE_APPROACH: Nothing()}
    monkeypatch.setattr(cell, "running", running)
    timing = timing_of(spec, plan)
    failure, _ = timing.failures[Phase.MOVE_TO_PLACE_APPROACH]
    assert failure is Failure.TRAJECTORY_IN_COLLISION
