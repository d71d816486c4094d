"""Gaps between moving bodies against closed forms and their finite differences."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.grasping import (
    BodyMotion,
    ContactPoint,
    Curvature,
    Twist,
    gap_between,
    is_potential_contact,
    recorded_motion,
    relative_motion,
)

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
ORIGIN = (0.0, 0.0, 0.0)


class Body:
    """A rigid body with constant linear acceleration and, at time 0, a known spin and its derivative."""

    def __init__(self, rng, position):
        self.position, self.velocity, self.acceleration = np.array(position), *rng.normal(size=(2, 3))
        self.spin, self.spin_rate = rng.normal(size=(2, 3))

    def rotation(self, t):
        """Exponential of ω t + α t² / 2, whose spin at 0 is ω and its derivative α."""
        x, y, z = self.spin * t + self.spin_rate * t**2 / 2
        angle = math.sqrt(x * x + y * y + z * z)
        skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        if angle == 0.0:
            return np.eye(3)
        return np.eye(3) + math.sin(angle) / angle * skew + (1 - math.cos(angle)) / angle**2 * skew @ skew

    def origin(self, t):
        return self.position + self.velocity * t + self.acceleration * t**2 / 2

    def point(self, local, t):
        return self.origin(t) + self.rotation(t) @ local

    def motion(self):
        return BodyMotion(
            reference_m=tuple(self.position.tolist()),
            twist=Twist(angular_rad_s=tuple(self.spin.tolist()), linear_m_s=tuple(self.velocity.tolist())),
            angular_acceleration_rad_s2=tuple(self.spin_rate.tolist()),
            linear_acceleration_m_s2=tuple(self.acceleration.tolist()),
        )

    def velocity_at(self, point, t, step=1e-5):
        """Velocity of the material point that is at a place at a time, by differences."""
        local = self.rotation(t).T @ (point - self.origin(t))
        return (self.point(local, t + step) - self.point(local, t - step)) / (2 * step)


def first_and_second(function, step=1e-4):
    """Derivatives at 0 by differences of fourth order."""
    far_back, back, now, ahead, far_ahead = (function(k * step) for k in (-2, -1, 0, 1, 2))
    first = (far_back - 8 * back + 8 * ahead - far_ahead) / (12 * step)
    second = (-far_back + 16 * back - 30 * now + 16 * ahead - far_ahead) / (12 * step**2)
    return first, second


def unit(vector):
    return vector / np.linalg.norm(vector)


def contact_at(point, normal, gap):
    return ContactPoint(position_m=tuple(point.tolist()), normal=tuple(normal.tolist()), gap_m=float(gap))


def ellipsoid_support(half_axes, rotation):
    """Half the square of the support function's matrix: h(u) = √(uᵀ M u)."""
    return rotation @ np.diag(np.square(half_axes)) @ rotation.T


def ellipsoid_curvature(half_axes, outward):
    """Point and curvature of an ellipsoid where its outward normal is given: the inverse of the support's Hessian."""
    matrix = ellipsoid_support(half_axes, np.eye(3))
    height = math.sqrt(outward @ matrix @ outward)
    hessian = matrix / height - np.outer(matrix @ outward, matrix @ outward) / height**3
    tangents = contact_at(np.zeros(3), outward, 0.0).axes()[1:]
    radii, directions = np.linalg.eigh(tangents @ hessian @ tangents.T)
    curvature = Curvature(
        along_per_m=1 / radii[0], across_per_m=1 / radii[1], direction=tuple((directions[:, 0] @ tangents).tolist())
    )
    return matrix @ outward / height, curvature


@pytest.mark.parametrize("seed", range(8))
def test_two_spheres(seed):
    rng = np.random.default_rng(seed)
    finger, grasped = Body(rng, rng.normal(size=3)), Body(rng, 3.0 + rng.normal(size=3))
    radii = rng.uniform(0.2, 1.5, 2)  # far apart, touching or one in the other: the formulas hold for all

    def normal(t):
        return unit(grasped.origin(t) - finger.origin(t))

    def gap(t):
        return np.linalg.norm(grasped.origin(t) - finger.origin(t)) - radii.sum()

    def slip(t):
        n = normal(t)
        on_finger, on_object = finger.origin(t) + radii[0] * n, grasped.origin(t) - radii[1] * n
        relative = grasped.velocity_at(on_object, t) - finger.velocity_at(on_finger, t)
        return relative - (relative @ n) * n

    n = normal(0.0)
    spheres = [
        Curvature(along_per_m=1 / r, across_per_m=1 / r, direction=tuple(np.cross(n, X).tolist())) for r in radii
    ]
    motion = relative_motion(
        contact_at(grasped.origin(0.0) - radii[1] * n, n, gap(0.0)),
        finger.motion(),
        grasped.motion(),
        finger_curvature=spheres[0],
        object_curvature=spheres[1],
    )
    rate, acceleration = first_and_second(gap)
    slip_rate = first_and_second(slip, step=1e-3)[0]

    assert motion.gap_rate_m_s == pytest.approx(rate, abs=1e-8)
    assert motion.gap_acceleration_m_s2 == pytest.approx(acceleration, abs=1e-6)
    assert motion.tangential_velocity_m_s == pytest.approx(slip(0.0), abs=1e-8)
    assert motion.tangential_acceleration_m_s2 == pytest.approx(slip_rate - (slip_rate @ n) * n, abs=1e-5)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("ellipsoid_is_grasped", [True, False])
def test_an_ellipsoid_and_a_plane(seed, ellipsoid_is_grasped):
    rng = np.random.default_rng(seed)
    half_axes, facing = rng.uniform(0.3, 1.2, 3), unit(rng.normal(size=3))
    plane, ellipsoid = Body(rng, rng.normal(size=3)), Body(rng, rng.normal(size=3))
    point, curvature = ellipsoid_curvature(half_axes, -facing)
    flat = Curvature(along_per_m=0.0, across_per_m=0.0, direction=tuple(np.cross(facing, (0.3, 0.5, 0.9)).tolist()))

    def gap(t):
        n, matrix = plane.rotation(t) @ facing, ellipsoid_support(half_axes, ellipsoid.rotation(t))
        return n @ (ellipsoid.origin(t) - plane.origin(t)) - math.sqrt(n @ matrix @ n)

    on_ellipsoid = ellipsoid.position + point
    if ellipsoid_is_grasped:
        contact = contact_at(on_ellipsoid, facing, gap(0.0))
        motion = relative_motion(
            contact, plane.motion(), ellipsoid.motion(), finger_curvature=flat, object_curvature=curvature
        )
    else:
        contact = contact_at(on_ellipsoid - gap(0.0) * facing, -facing, gap(0.0))
        motion = relative_motion(contact, ellipsoid.motion(), plane.motion(), finger_curvature=curvature)
    rate, acceleration = first_and_second(gap)

    assert motion.gap_rate_m_s == pytest.approx(rate, abs=1e-8)
    assert motion.gap_acceleration_m_s2 == pytest.approx(acceleration, abs=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_a_sharp_tip_on_a_face_and_on_a_sphere(seed):
    rng = np.random.default_rng(seed)
    finger, grasped = Body(rng, rng.normal(size=3)), Body(rng, 2.0 + rng.normal(size=3))
    tip, facing, radius = rng.normal(size=3), unit(rng.normal(size=3)), 0.7

    def face_gap(t):
        # The face looks along -n, from the object to the finger.
        return (grasped.rotation(t) @ facing) @ (grasped.origin(t) - finger.point(tip, t))

    def sphere_gap(t):
        return np.linalg.norm(grasped.origin(t) - finger.point(tip, t)) - radius

    at_tip = finger.point(tip, 0.0)
    n = unit(grasped.position - at_tip)
    round_object = Curvature(along_per_m=1 / radius, across_per_m=1 / radius, direction=tuple(np.cross(n, Y).tolist()))
    cases = [(face_gap, facing, None), (sphere_gap, n, round_object)]
    for gap, normal, curvature in cases:
        motion = relative_motion(
            contact_at(at_tip + gap(0.0) * normal, normal, gap(0.0)),
            finger.motion(),
            grasped.motion(),
            object_curvature=curvature,
        )
        rate, acceleration = first_and_second(gap)
        assert motion.gap_rate_m_s == pytest.approx(rate, abs=1e-8)
        assert motion.gap_acceleration_m_s2 == pytest.approx(acceleration, abs=1e-6)


def test_a_ball_that_rolls_on_a_floor():
    # The floor is the finger; the ball turns about y and so moves along x.
    radius, speed = 0.5, 2.0
    floor = BodyMotion(reference_m=ORIGIN, twist=Twist())
    ball = BodyMotion(
        reference_m=(0.0, 0.0, radius),
        twist=Twist(angular_rad_s=(0.0, speed / radius, 0.0), linear_m_s=(speed, 0.0, 0.0)),
    )
    motion = relative_motion(
        ContactPoint(position_m=ORIGIN, normal=Z),
        floor,
        ball,
        finger_curvature=Curvature(along_per_m=0.0, across_per_m=0.0, direction=X),
        object_curvature=Curvature(along_per_m=1 / radius, across_per_m=1 / radius, direction=X),
    )

    assert motion.gap_rate_m_s == 0.0
    assert motion.gap_acceleration_m_s2 == pytest.approx(0.0, abs=1e-12)
    assert motion.tangential_velocity_m_s == pytest.approx(ORIGIN)
    assert motion.tangential_acceleration_m_s2 == pytest.approx(ORIGIN)


def test_a_flat_pad_on_a_cylinder_touches_along_a_line():
    # Neither surface bends along z, where the nearest points are not unique.
    pad = Curvature(along_per_m=0.0, across_per_m=0.0, direction=Z)
    cylinder = Curvature(along_per_m=0.0, across_per_m=1 / 0.03, direction=Z)
    still = BodyMotion(reference_m=ORIGIN, twist=Twist())
    sliding = BodyMotion(
        reference_m=ORIGIN, twist=Twist(linear_m_s=(0.0, 0.0, -0.2)), linear_acceleration_m_s2=(0.5, 0.0, -9.81)
    )
    motion = relative_motion(
        ContactPoint(position_m=(-0.03, 0.0, 0.01), normal=X),
        still,
        sliding,
        finger_curvature=pad,
        object_curvature=cylinder,
    )

    assert (motion.gap_rate_m_s, motion.gap_acceleration_m_s2) == (0.0, pytest.approx(0.5))
    assert motion.tangential_velocity_m_s == pytest.approx((0.0, 0.0, -0.2))
    assert motion.tangential_acceleration_m_s2 == pytest.approx((0.0, 0.0, -9.81))


def test_a_direction_of_curvature_lies_in_the_tangent_plane():
    with pytest.raises(DefinitionError) as caught:
        Curvature(along_per_m=1.0, across_per_m=0.0, direction=Z).tensor(np.array(Z))

    assert str(caught.value) == (
        "the direction (0.0, 0.0, 1.0) of a curvature is along the normal (give a vector in the tangent plane)"
    )


def test_recorded_motion_is_split_along_the_normal():
    motion = recorded_motion(
        ContactPoint(position_m=ORIGIN, normal=X, gap_m=-2e-5, relative_velocity_m_s=(0.3, 0.1, -0.2))
    )

    assert (motion.gap_m, motion.gap_rate_m_s) == (-2e-5, pytest.approx(0.3))
    assert motion.tangential_velocity_m_s == pytest.approx((0.0, 0.1, -0.2))
    assert motion.gap_acceleration_m_s2 is None
    assert motion.tangential_acceleration_m_s2 is None


def test_gaps_are_negative_where_bodies_penetrate():
    assert gap_between((0.0, 0.0, 1.0), Z, (0.2, 0.0, 1.5)) == 0.5
    assert gap_between((0.0, 0.0, 1.0), Z, (0.2, 0.0, 0.9)) == pytest.approx(-0.1)


@pytest.mark.parametrize(
    ("object_point", "object_normal", "expected"),
    [
        ((0.0, 0.0, 0.5), (0.0, 0.0, -1.0), True),
        ((0.0, 0.0, -0.5), (0.0, 0.0, -1.0), True),
        (ORIGIN, (0.0, 0.0, -1.0), True),
        ((0.0, 0.0, 0.5), Z, False),
        ((0.0, 0.1, 0.5), (0.0, 0.0, -1.0), False),
        ((0.0, 0.0, 0.5), (0.0, 0.6, -0.8), False),
    ],
)
def test_potential_contacts_face_one_another(object_point, object_normal, expected):
    assert is_potential_contact(ORIGIN, Z, object_point, object_normal) is expected
