"""Trials under uncertainty: what each draw does to the machine, against theory where there is one."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.evidence import Failure, record_digest, record_from_json, record_to_json
from rgss.scenes.uncertainty import Constant, Normal, Uncertainty, UncertainValue
from rgss.trials.conditions import conditions_of
from rgss.trials.pieces.run import Pieces, run_trial
from tests.fixtures.eight_states import Phase
from tests.fixtures.shared_trials import UNTRIED

pytestmark = pytest.mark.engine

THREE, TWO = 12, 30


@pytest.fixture(scope="module")
def pieces():
    """Trials of this module share what they have in common."""
    return Pieces(bench=lambda _: UNTRIED)


def drawn(spec, **values):
    named = {name.replace("__", "."): value for name, value in values.items()}
    return replace(
        spec,
        uncertainty=Uncertainty(
            values=tuple(
                UncertainValue(quantity=name, distribution=Constant(value=value)) for name, value in named.items()
            )
        ),
    )


def phase_of(record, phase):
    return next(one for one in record.phases if one.phase == phase)


def test_a_hand_drops_what_is_heavier_than_coulomb_s_law_lets_it_hold(spec_of, pieces):
    spec = spec_of(TWO)
    gripper, scene = spec.gripper, spec.scene
    # Force of both fingers at their greatest, in the lift: mu N F = m (g + a).
    friction = gripper.friction * scene.workpiece.friction
    full_n = friction * 2 * gripper.finger_force_n

    def lifted(share, **more):
        # The robot believes the light cup, and so holds with the first share of its force.
        first_n = full_n * spec.settings.control.holding_share
        record = pieces.record(drawn(spec, workpiece__mass=share * first_n / scene.gravity_m_s2, **more))
        return record.failed_phase not in (Phase.GRASP, Phase.LIFT), record

    held, record = lifted(0.85)
    assert held, record.failure_detail
    slipped, record = lifted(1.1)
    assert not slipped
    assert record.failure in (Failure.OBJECT_DROPPED, Failure.NO_FIRM_GRASP)
    # With a tenth less friction, what was held slips.
    slipped, record = lifted(0.85, workpiece__friction=0.7 * scene.workpiece.friction)
    assert not slipped


def test_the_robot_plans_with_what_it_perceives_and_pushes_what_it_does_not_see(spec_of, pieces):
    geometry = spec_of(TWO).gripper.geometry
    far_m = geometry.largest_opening_m - spec_of(TWO).scene.workpiece.shape.radius_m + 0.01

    seen = pieces.record(drawn(spec_of(TWO), workpiece__x=-far_m))
    assert seen.failed_phase not in (Phase.MOVE_TO_GRASP, Phase.GRASP), seen.failure_detail
    # A finger comes down on the object, and presses it against the counter.
    unseen = pieces.record(drawn(spec_of(TWO), workpiece__x=-far_m, perception__x=far_m))
    assert (unseen.failure, unseen.failed_phase) == (Failure.OBJECT_DAMAGED, Phase.MOVE_TO_GRASP)
    # On this side the other hand has no finger, and closes beside the object.
    beside = pieces.record(drawn(spec_of(THREE), workpiece__x=-far_m, perception__x=far_m))
    assert (beside.failure, beside.failed_phase) == (Failure.NO_FIRM_GRASP, Phase.GRASP)


def test_an_encoder_error_moves_the_tool_by_its_lever(spec_of, pieces):
    spec = spec_of(THREE)
    offset_rad = 0.002

    record = pieces.record(drawn(spec, robot__joint_offset=offset_rad))
    nominal = pieces.record(spec)
    # What the encoders say follows the path as well as before: the robot cannot know.
    assert record.metrics["tracking_error_m"] < 0.1e-3
    held = [phase_of(each, Phase.LIFT).metrics["workpiece_position_m"] for each in (record, nominal)]
    shift_m = math.dist(*held)
    assert 0.2e-3 < shift_m < 6 * offset_rad * 1.5


def test_the_first_force_reading_is_as_late_as_the_sensor(spec_of, pieces):
    spec = spec_of(THREE)

    times = [
        phase_of(pieces.record(each), Phase.GRASP).duration_s
        for each in (spec, drawn(spec, gripper__force_sensor__delay=0.1))
    ]
    assert times[1] - times[0] == pytest.approx(0.1, abs=1.5 / spec.settings.physics.rate_hz)


def test_slow_fingers_close_later(spec_of, pieces):
    spec = spec_of(THREE)
    geometry = spec.gripper.geometry
    travel_m = geometry.largest_opening_m - spec.scene.workpiece.shape.radius_m

    times = [
        phase_of(pieces.record(each), Phase.GRASP).duration_s
        for each in (spec, drawn(spec, gripper__finger__speed=0.8))
    ]
    slower_s = travel_m / spec.gripper.finger_velocity_m_s * (1 / 0.8 - 1)
    assert times[1] - times[0] == pytest.approx(slower_s, rel=0.1)


def test_a_sensor_that_reads_nothing_never_finds_a_firm_grasp(spec_of, pieces):
    record = pieces.record(drawn(spec_of(THREE), gripper__force_sensor__offset=-20.0))

    assert (record.failure, record.failed_phase) == (Failure.NO_FIRM_GRASP, Phase.GRASP)


def test_a_strong_hand_damages(spec_of, pieces):
    record = pieces.record(drawn(spec_of(THREE), gripper__finger__force=7.0))

    assert record.failure is Failure.OBJECT_DAMAGED


def test_a_trial_by_its_seed_is_the_same_again_and_keeps_its_draws(spec_of):
    uncertainty = Uncertainty(
        values=tuple(
            UncertainValue(quantity=name, distribution=distribution)
            for name, distribution in {
                "perception.x": Normal(mean=0.0, sd=0.004),
                "perception.pitch": Normal(mean=0.0, sd=0.02),
                "gripper.force_sensor.noise": Constant(value=0.3),
                "workpiece.centre_of_mass": Normal(mean=0.0, sd=0.01),
                "robot.joint_offset": Normal(mean=0.0, sd=0.0005),
            }.items()
        )
    )
    spec = replace(spec_of(THREE, 3), uncertainty=uncertainty)

    record = run_trial(spec)

    assert record_digest(run_trial(spec)) == record_digest(record)
    assert record.draws == conditions_of(spec).draws
    assert len(record.draws) == 10
    assert record_from_json(record_to_json(record)) == record
