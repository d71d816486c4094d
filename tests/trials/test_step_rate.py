"""The same trial at another step rate: what the physics says does not depend on how finely it is stepped."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.trials.run import run_trial

pytestmark = [pytest.mark.engine, pytest.mark.slow]


@pytest.mark.verifies("SYS-011")
@pytest.mark.parametrize(("variant", "seed"), [(12, 1), (30, 1), (66, 3)])
def test_240_and_1000_hertz_agree(spec_of, variant, seed):
    spec = spec_of(variant=variant, seed=seed)
    settings = spec.settings
    fine = replace(spec, settings=replace(settings, physics=replace(settings.physics, rate_hz=1000.0)))
    coarse_record, fine_record = run_trial(spec), run_trial(fine)

    assert coarse_record.success
    assert fine_record.success
    assert coarse_record.metrics["task_time_s"] == pytest.approx(fine_record.metrics["task_time_s"], rel=0.01)
    assert coarse_record.metrics["slip_m"] == pytest.approx(fine_record.metrics["slip_m"], abs=0.5e-3)
    assert coarse_record.metrics["slip_m"] < 0.25e-3
