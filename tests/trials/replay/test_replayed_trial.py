"""The replay of a trial: it changes no bit, and shows each link and object where independent engines have it."""

from __future__ import annotations

import math

import numpy as np
import pinocchio
import pytest

from rgss.evidence import record_digest
from rgss.scenes import assembled_urdf, finger_joint
from rgss.trials.conditions import conditions_of
from rgss.trials.pieces.run import run_trial
from rgss.trials.planning.plan import plan_of
from rgss.trials.replay.replay_scene import LineKind, NodeKind
from rgss.trials.replay.replayed_trial import run_replayed_trial
from rgss.trials.workcell import cell_of

pytestmark = pytest.mark.engine


@pytest.fixture(scope="module")
def spec(spec_of):
    return spec_of(65, 1)


@pytest.fixture(scope="module")
def replayed(spec):
    return run_replayed_trial(spec)


@pytest.fixture(scope="module")
def scene(replayed):
    return replayed.scene


def nodes(scene, kind):
    return {node.name: node for node in scene.nodes if node.kind is kind}


def test_it_changes_no_bit_of_the_record(spec, replayed):
    assert record_digest(run_trial(spec)) == record_digest(replayed.record)


def test_every_link_is_where_pinocchio_has_it(spec, replayed, scene):
    model = pinocchio.buildModelFromXML(assembled_urdf(spec.scene.robot, spec.gripper))
    data = model.createData()
    base = spec.scene.robot.base
    x, y, z, w = base.quaternion_xyzw
    to_world = pinocchio.SE3(pinocchio.Quaternion(w, x, y, z), np.array(base.position_m))
    arm = [model.joints[model.getJointId(joint.name)].idx_q for joint in spec.scene.robot.joints]
    fingers = [
        model.joints[model.getJointId(finger_joint(finger))].idx_q for finger in range(spec.gripper.geometry.fingers)
    ]
    trace, links = replayed.trace, nodes(scene, NodeKind.LINK)
    assert len(links) >= 6 + 1 + spec.gripper.geometry.fingers
    for sample in range(0, len(scene.time_s), 37):
        at = trace.sample_at(scene.time_s[sample])
        assert trace.time_s[at] == pytest.approx(scene.time_s[sample], abs=1e-9)
        q = np.zeros(model.nq)
        q[arm], q[fingers] = trace.joint_positions_rad[at], trace.finger_travel_m[at]
        pinocchio.framesForwardKinematics(model, data, q)
        for name, node in links.items():
            pose = to_world * data.oMf[model.getFrameId(name, pinocchio.FrameType.BODY)]
            found = node.positions_m[min(sample, len(node.positions_m) - 1)]
            qx, qy, qz, qw = node.quaternions_xyzw[min(sample, len(node.quaternions_xyzw) - 1)]
            assert found == pytest.approx(pose.translation, abs=1e-5)
            assert pinocchio.Quaternion(qw, qx, qy, qz).matrix() == pytest.approx(pose.rotation, abs=1e-5)


def test_the_object_is_where_the_trace_has_it(spec, replayed, scene):
    (node,) = nodes(scene, NodeKind.OBJECT).values()
    at = [replayed.trace.sample_at(time) for time in scene.time_s]

    assert node.name == spec.scene.workpiece.id
    assert node.positions_m == pytest.approx(replayed.trace.workpiece_position_m[at])
    turns = np.sum(node.quaternions_xyzw[1:] * node.quaternions_xyzw[:-1], axis=1)
    assert turns.min() > 0.0


def test_the_perceived_object_is_where_the_draws_put_it(spec_of):
    spec = spec_of(65, 1)
    conditions = conditions_of(spec)
    scene = run_replayed_trial(spec).scene
    (perceived,) = nodes(scene, NodeKind.PERCEIVED).values()
    (true,) = nodes(scene, NodeKind.OBJECT).values()

    assert perceived.positions_m == pytest.approx(np.array([conditions.perceived_scene.workpiece.pose.position_m]))
    apart = np.array(conditions.true_scene.workpiece.pose.position_m) - perceived.positions_m[0]
    (offset,) = scene.perceived
    assert offset.distance_m == pytest.approx(np.linalg.norm(apart))
    assert np.linalg.norm(true.positions_m[0] - perceived.positions_m[0]) == pytest.approx(offset.distance_m, abs=1e-3)


def test_the_forces_of_the_fingers_carry_the_object(spec, replayed, scene):
    """Newton's second law: over a carry that begins and ends at rest the mean vertical force is the weight."""
    trace = replayed.trace
    carry = next(span for span in trace.spans if span.phase == "move_to_place_approach")
    within = (scene.time_s > carry.start_s) & (scene.time_s <= carry.end_s)
    upward = sum(one.forces_n[within, 2] for one in scene.contacts)
    weight_n = conditions_of(spec).mass_kg * spec.scene.gravity_m_s2

    assert np.isfinite(upward).all()
    assert float(np.mean(upward)) == pytest.approx(weight_n, rel=0.05)


def test_contact_points_lie_on_the_object(spec, scene):
    (node,) = nodes(scene, NodeKind.OBJECT).values()
    shape = conditions_of(spec).true_scene.workpiece.shape
    reach = math.hypot(shape.radius_m, shape.half_height_m)
    for one in scene.contacts:
        known = np.isfinite(one.points_m[:, 0])
        apart = np.linalg.norm(one.points_m[known] - node.positions_m[known], axis=1)
        assert known.any()
        assert apart.max() < reach + 2e-3


def test_paths_and_graphs_are_those_of_the_plan(spec, scene):
    plan, arm = plan_of(spec), cell_of(spec).arm
    paths = {line.phase: line.points_m for line in scene.lines if line.kind is LineKind.PATH}
    graphs = {line.phase: line.points_m for line in scene.lines if line.kind is LineKind.GRAPH}
    for phase, move in plan.moves.items():
        ends = arm.tool_position(move.path_rad[[0, -1]])
        assert paths[phase][[0, -1]] == pytest.approx(ends)
        assert len(graphs[phase]) % 2 == 0
        # The search began at the start of the move.
        assert np.linalg.norm(graphs[phase] - ends[0], axis=1).min() == pytest.approx(0.0, abs=1e-9)
    assert set(paths) == set(plan.moves) | {phase for phase, path in plan.direct.items() if path is not None}


def test_a_long_trial_is_sampled_less_often(spec, scene, monkeypatch):
    monkeypatch.setattr("rgss.trials.replay.replayed_trial.MOST_SAMPLES", 100)
    short = run_replayed_trial(spec).scene

    assert 50 <= len(short.time_s) <= 101
    assert (short.time_s[0], short.time_s[-1]) == (scene.time_s[0], scene.time_s[-1])
