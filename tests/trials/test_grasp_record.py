"""The grasp that a trial records, against theory."""

import math

import pytest

from rgss.evidence import Phase
from rgss.trials.grasp_record import PREFIX

pytestmark = pytest.mark.engine

# Pyramids of six edges lose at most this share of friction.
PYRAMID = math.cos(math.pi / 6)


def phase_metrics(record, phase):
    (found,) = (entry.metrics for entry in record.phases if entry.phase is phase)
    return found


@pytest.mark.parametrize("variant", [28, 10])
@pytest.mark.verifies("SYS-006")
def test_the_lifted_grasp_bears_the_weight_as_often_as_friction_allows(replicate, variant):
    spec, record = replicate.specs[variant], replicate.records[variant]
    metrics = phase_metrics(record, Phase.LIFT)
    gripper, cup = spec.gripper, spec.scene.workpiece
    fingers, friction = gripper.geometry.fingers, gripper.friction * cup.friction
    theory = friction * gripper.finger_force_n * fingers / (cup.mass_kg * spec.scene.gravity_m_s2)

    assert metrics[f"{PREFIX}force_closure"] == 1
    assert PYRAMID * theory * 0.98 <= metrics[f"{PREFIX}load_factor_1"] <= theory * 1.02
    assert metrics["contacts_slipping"] == 0
    assert abs(metrics["contact_gap_min_m"]) < 1e-4


@pytest.mark.parametrize("variant", [28, 10])
def test_a_trial_is_judged_by_its_worst_carried_grasp(replicate, variant):
    record = replicate.records[variant]
    carried = [
        phase_metrics(record, phase) for phase in (Phase.LIFT, Phase.MOVE_TO_PLACE_APPROACH, Phase.MOVE_TO_PLACE)
    ]

    for name in ("q_msv_1", "q_gii_1", "q_smw_n", "load_factor_1"):
        assert record.metrics[PREFIX + name] == min(metrics[PREFIX + name] for metrics in carried)
    assert record.metrics[f"{PREFIX}q_diff_m"] == max(metrics[f"{PREFIX}q_diff_m"] for metrics in carried)


def test_three_fingers_make_a_regular_polygon_and_two_make_none(replicate):
    assert phase_metrics(replicate.records[10], Phase.LIFT)[f"{PREFIX}q_gpri_1"] < 0.01
    assert phase_metrics(replicate.records[28], Phase.LIFT)[f"{PREFIX}q_gpri_1"] is None


def test_the_bench_of_a_gripper_is_in_every_record_of_it(replicate):
    by_fingers = {}
    for variant, record in replicate.records.items():
        by_fingers.setdefault(replicate.specs[variant].gripper.geometry.fingers, set()).add(
            record.metrics["bench_payload_kg"]
        )

    assert {fingers: len(payloads) for fingers, payloads in by_fingers.items()} == {2: 1, 3: 1}
    # 0.7 · 10 N · fingers / (9.81 + 1.2) m/s²; the search is done to half a per cent.
    assert {fingers: payloads.pop() for fingers, payloads in by_fingers.items()} == pytest.approx(
        {2: 1.2716, 3: 1.9074}, rel=0.01
    )
