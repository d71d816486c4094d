"""Motions whose check steps over what is in their way."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure
from rgss.trials import Workcell, plan_of, timing_of
from rgss.trials.timing import time_task
from tests.fixtures.eight_states import Phase
from tests.trials.spec_changes import with_body


@pytest.mark.engine
def test_what_a_coarse_check_steps_over_is_found_by_the_clearance(spec_of):
    """At 3 rad a handful of configurations are checked; the samples of the clearance are milliseconds apart."""
    spec, phase = spec_of(), Phase.MOVE_TO_PLACE_APPROACH
    plan = plan_of(spec)
    approach = timing_of(spec, plan).trajectories[phase]
    planning = replace(spec.settings.planning, resolution_rad=3.0, verification_resolution_rad=3.0)
    free = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=spec.task)
    on_the_way = free.arm.tool_position(approach.positions(np.array([0.3 * approach.duration_s])))[0]
    scene = with_body(spec, (0.02, 0.02, 0.02), tuple(map(float, on_the_way))).scene
    cell = Workcell(scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=spec.task)
    timing = time_task(cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)

    failure, detail = timing.failures[phase]
    assert failure is Failure.TRAJECTORY_IN_COLLISION
    assert re.fullmatch(
        r"the timed motion overlaps an obstacle by [\d.]+ mm between configurations that were checked, 3 rad apart",
        detail,
    )
    assert phase not in timing.trajectories
    assert phase not in timing.qualities
