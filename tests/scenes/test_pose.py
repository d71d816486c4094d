import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from rgss.scenes import Pose

TOLERANCE = 1e-12

lengths = st.floats(-10, 10)
angles = st.floats(-2 * math.pi, 2 * math.pi)
points = st.tuples(lengths, lengths, lengths)
poses = st.builds(Pose.from_roll_pitch_yaw, points, st.tuples(angles, angles, angles))


def matrix(pose: Pose) -> np.ndarray:
    """The homogeneous transform, by an independent implementation."""
    transform = np.eye(4)
    transform[:3, :3] = Rotation.from_quat(pose.quaternion_xyzw).as_matrix()
    transform[:3, 3] = pose.position_m
    return transform


@given(points, angles, angles, angles)
def test_roll_pitch_yaw_turn_about_fixed_axes_as_in_urdf(position, roll, pitch, yaw):
    pose = Pose.from_roll_pitch_yaw(position, (roll, pitch, yaw))
    expected = Rotation.from_euler("xyz", [roll, pitch, yaw])
    assert pose.position_m == position
    assert np.allclose(Rotation.from_quat(pose.quaternion_xyzw).as_matrix(), expected.as_matrix(), atol=TOLERANCE)
    assert math.hypot(*pose.quaternion_xyzw) == pytest.approx(1, abs=TOLERANCE)


@given(poses, points)
def test_rotate_turns_a_direction(pose, vector):
    expected = Rotation.from_quat(pose.quaternion_xyzw).apply(vector)
    assert np.allclose(pose.rotate(vector), expected, atol=1e-11)


@given(poses, poses)
def test_chained_transforms_multiply(outer, inner):
    assert np.allclose(matrix(outer @ inner), matrix(outer) @ matrix(inner), atol=1e-11)


@given(poses)
def test_inverse_is_the_inverse_matrix(pose):
    assert np.allclose(matrix(pose.inverse()), np.linalg.inv(matrix(pose)), atol=1e-11)


@given(poses)
def test_there_and_back_is_nowhere(pose):
    for round_trip in (pose @ pose.inverse(), pose.inverse() @ pose):
        assert np.allclose(matrix(round_trip), np.eye(4), atol=1e-11)


@given(poses, poses, poses)
def test_chaining_is_associative(a, b, c):
    assert np.allclose(matrix((a @ b) @ c), matrix(a @ (b @ c)), atol=1e-10)


@given(poses)
def test_the_default_pose_changes_nothing(pose):
    assert np.allclose(matrix(pose @ Pose()), matrix(pose), atol=TOLERANCE)
    assert np.allclose(matrix(Pose() @ pose), matrix(pose), atol=TOLERANCE)


@given(poses, lengths)
def test_raised_moves_along_the_outer_z(pose, height):
    raised = pose.raised(height)
    assert raised.quaternion_xyzw == pose.quaternion_xyzw
    assert raised.position_m == (*pose.position_m[:2], pose.position_m[2] + height)


@given(poses)
def test_tilt_is_the_angle_between_the_z_axes(pose):
    axis = matrix(pose)[:3, 2]
    expected = math.atan2(math.hypot(axis[0], axis[1]), axis[2])
    assert pose.tilt_rad == pytest.approx(expected, abs=3e-8)  # the arc cosine near its ends


@given(angles, st.floats(0, math.pi), angles)
def test_tilt_does_not_depend_on_turns_about_the_two_z_axes(before, tilt, after):
    turn_before, turn_after = (Pose.from_roll_pitch_yaw((0, 0, 0), (0, 0, yaw)) for yaw in (before, after))
    tilted = turn_after @ Pose.from_roll_pitch_yaw((0, 0, 0), (tilt, 0, 0)) @ turn_before
    assert tilted.tilt_rad == pytest.approx(tilt, abs=3e-8)


def test_a_rounded_quaternion_does_not_break_the_tilt():
    assert Pose(quaternion_xyzw=(0.0, 0.0, 0.0, 1.0 + 1e-9)).tilt_rad == 0.0
    assert Pose(quaternion_xyzw=(1.0 + 1e-9, 0.0, 0.0, 0.0)).tilt_rad == pytest.approx(math.pi)


@given(poses, poses)
def test_a_pose_seen_from_another_is_in_that_ones_frame(pose, frame):
    expected = np.linalg.inv(matrix(frame)) @ matrix(pose)
    assert np.allclose(matrix(pose.relative_to(frame)), expected, atol=1e-10)
    assert pose.relative_to(frame).quaternion_xyzw == pytest.approx((frame.inverse() @ pose).quaternion_xyzw, abs=1e-12)


@given(pose=poses)
def test_angles_give_the_orientation_back(pose):
    again = Pose.from_roll_pitch_yaw(pose.position_m, pose.roll_pitch_yaw_rad())
    assert np.abs(np.dot(again.quaternion_xyzw, pose.quaternion_xyzw)) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2, math.pi / 2 - 1e-7, -math.pi / 2 + 1e-9])
@pytest.mark.parametrize(("roll", "yaw"), [(0.0, 0.0), (0.7, 0.0), (0.4, -2.1), (-3.0, 1.0)])
def test_angles_at_gimbal_lock_give_the_orientation_back(roll, pitch, yaw):
    pose = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (roll, pitch, yaw))
    again = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), pose.roll_pitch_yaw_rad())
    assert np.abs(np.dot(again.quaternion_xyzw, pose.quaternion_xyzw)) == pytest.approx(1.0, abs=1e-12)
