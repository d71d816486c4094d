"""An object that turns in the hand while it is carried."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from rgss.evidence import Failure
from tests.fixtures.shared_trials import record_without_bench

pytestmark = pytest.mark.engine


@pytest.mark.parametrize(
    ("mass_kg", "across_m", "turns"),
    [(0.6, (0.0, 0.014), True), (0.6, (0.014, 0.0), False), (0.3, (0.0, 0.014), False)],
    ids=["along the pads", "between the pads", "light"],
)
def test_an_object_that_turns_about_the_line_between_the_pads_is_dropped(lite6, mass_kg, across_m, turns):
    """The weight turns the cube by 0.082 N m in the first case, by half of that in the last."""
    heavy = replace(lite6.scene.workpiece, mass_kg=mass_kg, centre_of_mass_across_m=across_m)
    record = record_without_bench(replace(lite6, scene=replace(lite6.scene, workpiece=heavy)))

    if not turns:
        assert record.failure is None
        return
    assert record.failure is Failure.OBJECT_DROPPED
    told = re.fullmatch(
        r"red_cube tilted by (\d+) deg in the gripper, more than the 45 deg of the task", record.failure_detail
    )
    assert told
    assert 47 <= int(told[1]) < 91
    failed = next(phase for phase in record.phases if phase.outcome.value == "failed")
    assert (failed.metrics["slip_m"] < 0.02, failed.metrics["grip_margin_min"] > 1.5) == (True, True)
