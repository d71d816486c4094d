"""The shape of a gripper against plain geometry."""

import math

import pytest

from rgss.scenes import Gripper


@pytest.fixture
def geometry(kitchen):
    return kitchen.gripper()


def test_the_base_hangs_on_the_flange(geometry):
    assert geometry.base_pose.position_m == (0.0, 0.0, 0.04)
    assert geometry.base_pose.tilt_rad == 0.0


def test_the_grasp_centre_lies_on_the_axis(geometry):
    assert geometry.grasp_centre.position_m == (0.0, 0.0, 0.13)
    assert geometry.grasp_centre.quaternion_xyzw == (0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("opening_m", [0.0, 0.025, 0.06])
def test_each_pad_stands_at_the_opening_and_faces_the_axis(geometry, opening_m):
    for finger, azimuth in enumerate(geometry.azimuths_rad):
        pose = geometry.finger_pose(finger, opening_m)
        pad = pose.rotate((-geometry.finger.size_m[0] / 2, 0.0, 0.0))
        x, y, z = (a + b for a, b in zip(pose.position_m, pad, strict=True))
        assert (x, y) == pytest.approx((opening_m * math.cos(azimuth), opening_m * math.sin(azimuth)), abs=1e-15)
        assert z == pytest.approx(0.08 + 0.045)  # from the base's end, half a finger on
        assert pose.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, 1.0))


def test_the_mass_is_that_of_base_and_fingers(geometry):
    gripper = Gripper(
        geometry=geometry,
        base_mass_kg=0.4,
        finger_mass_kg=0.3,
        finger_velocity_m_s=0.04,
        finger_force_n=10.0,
        friction=0.7,
    )
    assert gripper.geometry.fingers == 3
    assert gripper.mass_kg == pytest.approx(0.4 + 3 * 0.3)
