"""The same trial at another step rate: what the physics says does not depend on how finely it is stepped."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.physics import World
from rgss.tasks import default_task
from rgss.trials.execution import Execution
from rgss.trials.planning import plan_task
from rgss.trials.reference import reference_of
from rgss.trials.timing import time_task
from rgss.trials.workcell import Workcell
from tests.fixtures.eight_states import Phase
from tests.fixtures.shared_trials import record_without_bench

pytestmark = [pytest.mark.engine, pytest.mark.slow]


@pytest.mark.verifies("SYS-011")
@pytest.mark.parametrize(("variant", "seed"), [(12, 1), (30, 1), (66, 3)])
def test_240_and_1000_hertz_agree(spec_of, variant, seed):
    spec = spec_of(variant=variant, seed=seed)
    settings = spec.settings
    fine = replace(spec, settings=replace(settings, physics=replace(settings.physics, rate_hz=1000.0)))
    coarse_record, fine_record = record_without_bench(spec), record_without_bench(fine)

    assert coarse_record.success
    assert fine_record.success
    assert coarse_record.metrics["task_time_s"] == pytest.approx(fine_record.metrics["task_time_s"], rel=0.01)
    assert coarse_record.metrics["slip_m"] == pytest.approx(fine_record.metrics["slip_m"], abs=0.5e-3)
    assert coarse_record.metrics["slip_m"] < 0.25e-3


class Carry:
    """The timed task of a variant with 2 or 3 fingers, run with any object, finger, rate and iterations."""

    def __init__(self, spec):
        self.spec = spec
        planning = spec.settings.planning
        self.cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=default_task())
        plan = plan_task(self.cell, spec.planner, seed=spec.seed, settings=planning)
        self.timing = time_task(self.cell, plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)

    def limit_kg(self):
        """Mass at which the grip margin is 1 at the greatest acceleration of the tool."""
        spec = self.spec
        friction_n = spec.gripper.friction * spec.scene.workpiece.friction * spec.gripper.finger_force_n
        greatest = spec.scene.gravity_m_s2 + spec.scene.robot.tool_acceleration_m_s2
        return friction_n * spec.gripper.geometry.fingers / greatest

    def run(self, *, rate_hz, iterations, phases=tuple(Phase), workpiece=None, gripper=None, **control):
        """Results by phase."""
        spec = self.spec
        scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, **(workpiece or {})))
        physics = replace(spec.settings.physics, rate_hz=rate_hz, solver_iterations=iterations)
        references = {
            phase: reference_of(found, self.cell.arm, step_s=physics.step_s, gravity_m_s2=scene.gravity_m_s2)
            for phase, found in self.timing.trajectories.items()
            if phase in phases
        }
        settings = replace(spec.settings.control, **control)
        with World(scene, replace(spec.gripper, **(gripper or {})), physics) as world:
            results = Execution(world, references, settings, self.cell.arm, task=default_task()).run()
        return {result.phase: result for result in results}


@pytest.fixture(scope="module", params=[28, 10], ids=["two fingers", "three fingers"])
def carry(request, spec_of):
    return Carry(spec_of(variant=request.param, seed=3))


def slip_m(results):
    return max(result.metrics.get("slip_m") or 0.0 for result in results.values())


SOLVERS = [(240.0, 20), (240.0, 200), (1000.0, 20), (1000.0, 200)]


@pytest.mark.parametrize("share", [0.79, 0.97])
@pytest.mark.parametrize(("rate_hz", "iterations"), SOLVERS)
def test_what_friction_can_carry_does_not_slip_at_any_rate(carry, share, rate_hz, iterations):
    """Grip margins of 1.27 and 1.03; without a yielding pad the object swings, without the arc it drifts."""
    found = carry.run(
        rate_hz=rate_hz, iterations=iterations, workpiece={"mass_kg": share * carry.limit_kg()}, holding_share=1.0
    )
    assert [result.failure for result in found.values()] == [None] * len(Phase)
    assert slip_m(found) < 0.3e-3


@pytest.mark.parametrize(("rate_hz", "iterations"), SOLVERS)
def test_what_friction_cannot_carry_slips_at_every_rate(carry, rate_hz, iterations):
    found = carry.run(
        rate_hz=rate_hz, iterations=iterations, workpiece={"mass_kg": 1.03 * carry.limit_kg()}, holding_share=1.0
    )
    assert slip_m(found) > 3e-3


RATES_HZ = (120.0, 240.0, 500.0, 1000.0, 2000.0, 4000.0)
CLOSING = (Phase.MOVE_TO_GRASP,)


@pytest.mark.parametrize(
    ("finger", "within"),
    [
        ({}, 0.15),  # the design's: 0.4 kg at 0.04 m/s
        ({"finger_mass_kg": 1.0, "finger_velocity_m_s": 0.2}, 0.25),
    ],
    ids=["closing", "impact"],
)
def test_the_sensed_force_of_closing_converges_as_the_step_shrinks(carry, finger, within):
    read = [
        carry.run(rate_hz=rate_hz, iterations=20, phases=CLOSING, gripper=finger, workpiece={"force_limit_n": 1.0e6})[
            Phase.GRASP
        ].metrics["sensed_finger_force_n"]
        for rate_hz in RATES_HZ
    ]
    finest = read[-1]
    assert read == pytest.approx([finest] * len(read), rel=within)
    assert read[2:] == pytest.approx([finest] * len(read[2:]), rel=0.07)
    # With the damping that the implicit step adds on top of the pad's, 1000 Hz reads 6 % low.
    assert read[3:] == pytest.approx([finest] * len(read[3:]), rel=0.04)
    # Of the impulse, no more than the motor's over the window and the momentum of a finger that rebounds as fast.
    gripper = replace(carry.spec.gripper, **finger)
    window_s = carry.spec.scene.workpiece.force_window_s
    blow_n = gripper.finger_mass_kg * gripper.finger_velocity_m_s / window_s
    assert finest < gripper.finger_force_n + 2 * blow_n


@pytest.mark.parametrize("rate_hz", RATES_HZ)
@pytest.mark.parametrize(("limit_n", "is_whole"), [(24.0, False), (42.0, True)])
def test_the_same_blow_damages_the_same_object_at_every_rate(carry, rate_hz, limit_n, is_whole):
    """1 kg at 0.2 m/s reads 36 N over 10 ms; in one step it is 40 N at 120 Hz, and 810 N at 4 kHz on a rigid pad."""
    found = carry.run(
        rate_hz=rate_hz,
        iterations=20,
        phases=CLOSING,
        gripper={"finger_mass_kg": 1.0, "finger_velocity_m_s": 0.2},
        workpiece={"force_limit_n": limit_n},
    )[Phase.GRASP]
    assert (found.failure is None) == is_whole


def test_a_grasp_is_firm_at_the_same_time_with_the_same_force_at_every_rate(carry):
    found = [carry.run(rate_hz=rate_hz, iterations=20, phases=(*CLOSING, Phase.LIFT)) for rate_hz in RATES_HZ[1:]]
    finest = found[-1]
    for results in found:
        assert [result.failure for result in results.values()] == [None] * 3
        grasp, lifted = results[Phase.GRASP], results[Phase.LIFT]
        assert grasp.duration_s == pytest.approx(finest[Phase.GRASP].duration_s, abs=0.005)
        assert sum(grasp.metrics["finger_force_n"]) == pytest.approx(
            sum(finest[Phase.GRASP].metrics["finger_force_n"]), rel=0.01
        )
        for phase in (Phase.GRASP, Phase.LIFT):
            assert results[phase].metrics["tightenings"] == finest[phase].metrics["tightenings"]
        assert lifted.metrics["grip_margin_min"] == pytest.approx(
            finest[Phase.LIFT].metrics["grip_margin_min"], rel=0.02
        )


def test_the_arc_of_a_step_is_what_the_tangent_leaves_out():
    """On a circle of 1 m at 1 rad/s: half of v²/r dt², towards the centre."""

    class Circle:
        duration_s = 1.0

        def positions(self, times_s):
            return times_s[:, None]

        def tool_position(self, angles):
            angle = angles[:, 0]
            return np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)

    step_s = 1.0 / 240.0
    found = reference_of(Circle(), Circle(), step_s=step_s, gravity_m_s2=9.81)
    for index, arc in enumerate(found.arc_m.tolist()):
        angle = found.positions_rad[index, 0]
        towards = (-math.cos(angle), -math.sin(angle), 0.0)
        assert arc == pytest.approx([0.5 * step_s**2 * part for part in towards], abs=1e-9)
