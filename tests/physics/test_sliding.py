"""A flat puck on a slope: it rests below the friction angle and slides by Coulomb's law above it.

The coefficient of a contact is the product of the coefficients of both bodies.
"""

import math

import pytest

from rgss.scenes import Box, Cylinder, Pose, SceneBody

pytestmark = pytest.mark.engine

OF_SLOPE, OF_PUCK = 0.7, 0.5
FRICTION_ANGLE_RAD = math.atan(OF_SLOPE * OF_PUCK)
TIME_S = 0.5


def slope(angle_rad: float, direction_rad: float) -> SceneBody:
    """A board that goes down along a direction in the horizontal plane."""
    there, back = (Pose.from_roll_pitch_yaw((0, 0, 0), (0, 0, yaw)) for yaw in (direction_rad, -direction_rad))
    tilt = there @ Pose.from_roll_pitch_yaw((0, 0, 0), (0, angle_rad, 0)) @ back
    pose = Pose(position_m=(5.0, 0.0, 1.0), quaternion_xyzw=tilt.quaternion_xyzw)
    return SceneBody(
        id="slope", shape=Box(size_m=(2, 2, 0.1)), pose=pose, friction=OF_SLOPE, colour=(0.0, 0.0, 0.0, 1.0)
    )


@pytest.fixture
def slide(three_fingers):
    def run(
        angle_rad: float, direction_rad: float, rate_hz: float = 240.0, time_s: float = TIME_S
    ) -> tuple[float, float, float]:
        """Distance down the slope, distance across it, and tilt against it after some time."""
        board = slope(angle_rad, direction_rad)
        puck = three_fingers.with_workpiece(
            shape=Cylinder(radius_m=0.05, height_m=0.02),
            pose=board.pose @ Pose(position_m=(0.0, 0.0, 0.06)),
            friction=OF_PUCK,
        )
        with three_fingers.world(
            rate_hz=rate_hz, bodies=(board,), support="slope", place_support="slope", **puck
        ) as world:
            for _ in range(round(time_s * rate_hz)):
                world.step()
            assert world.contacts().workpiece_bodies == ("slope",)
            on_board = board.pose.inverse() @ world.workpiece_pose()
        x, y, _ = on_board.position_m
        along = x * math.cos(direction_rad) + y * math.sin(direction_rad)
        across = y * math.cos(direction_rad) - x * math.sin(direction_rad)
        return along, across, on_board.tilt_rad

    return run


def expected_slide(angle_rad: float, rate_hz: float) -> float:
    acceleration = 9.81 * (math.sin(angle_rad) - OF_SLOPE * OF_PUCK * math.cos(angle_rad))
    return acceleration * TIME_S * (TIME_S + 1 / rate_hz) / 2  # the integrator's sum, as in a fall


@pytest.mark.parametrize("direction_deg", [0, 15, 30, 45, 90])
def test_it_rests_just_below_the_friction_angle(slide, direction_deg):
    along, across, tilt = slide(0.97 * FRICTION_ANGLE_RAD, math.radians(direction_deg))
    assert math.hypot(along, across) < 1e-4
    # The engine finds one point of the contact a step, and drops one that has drifted: the puck then falls about the
    # others for one step, and comes back within some tens of steps.
    assert tilt * 0.05 < 9.81 / 240.0**2
    assert slide(0.97 * FRICTION_ANGLE_RAD, math.radians(direction_deg), 1000.0)[2] < 1e-4


@pytest.mark.parametrize("direction_deg", [0, 15, 30, 45, 90])
def test_a_resting_puck_comes_to_lie_flat(slide, direction_deg):
    *_, tilt = slide(0.97 * FRICTION_ANGLE_RAD, math.radians(direction_deg), time_s=2.0)
    assert tilt < 1e-4


@pytest.mark.parametrize("direction_deg", [0, 90, 180])
def test_it_slides_by_coulombs_law_along_the_axes_of_the_contact(slide, direction_deg):
    angle = FRICTION_ANGLE_RAD + math.radians(10)
    along, across, _ = slide(angle, math.radians(direction_deg))
    assert along == pytest.approx(expected_slide(angle, 240.0), rel=0.02)
    assert abs(across) < 0.01 * along


@pytest.mark.parametrize("direction_deg", [20, 45, 70])
def test_between_the_axes_friction_is_a_little_weaker_and_never_stronger(slide, direction_deg):
    """The solver finds the two components of friction one after the other and then shortens their sum."""
    angle = FRICTION_ANGLE_RAD + math.radians(10)
    along, _, _ = slide(angle, math.radians(direction_deg))
    expected = expected_slide(angle, 240.0)
    assert 0.99 * expected < along < 1.10 * expected


def test_a_finer_step_comes_nearer_to_the_law(slide):
    angle = FRICTION_ANGLE_RAD + math.radians(10)
    along, _, _ = slide(angle, 0.0, 960.0)
    assert along == pytest.approx(expected_slide(angle, 960.0), rel=0.005)
