"""An object much lighter than the fingers that hold it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.fixtures.shared_trials import record_without_bench

pytestmark = pytest.mark.engine


@pytest.mark.parametrize("iterations", [20, 50])
def test_a_light_cup_does_not_creep_out_of_a_hand_that_holds_many_times_its_weight(spec_of, iterations):
    """The solver needs the more iterations to press with the whole force, the lighter what it presses on."""
    spec = spec_of(28)
    cup = replace(spec.scene.workpiece, mass_kg=0.01)
    physics = replace(spec.settings.physics, solver_iterations=iterations)
    light = replace(
        spec,
        scene=replace(spec.scene, workpiece=cup),
        settings=replace(spec.settings, physics=physics),
    )
    record = record_without_bench(light)
    assert record.success
    assert record.metrics["grip_margin_min"] > 50.0
    assert record.metrics["slip_m"] < 3e-4
