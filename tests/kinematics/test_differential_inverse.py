"""Differential inverse kinematics against a general solver, and at the ends of what joints can do."""

from __future__ import annotations

import cvxpy
import numpy as np
import pytest

from rgss.kinematics import DifferentialInverse
from rgss.scenes import Joint

BRAKING_S = 0.05


def joints(count, *, reach=3.0, speed=2.0):
    return [
        Joint(
            name=f"j{index}",
            lower_rad=-reach,
            upper_rad=reach,
            speed_rad_s=speed,
            acceleration_rad_s2=5.0,
            torque_n_m=50.0,
        )
        for index in range(count)
    ]


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("count", [4, 6, 7])
def test_the_speeds_are_those_of_a_general_solver(seed, count):
    random = np.random.default_rng([seed, count])
    jacobian, velocity = random.normal(size=(6, count)), random.normal(size=6) * random.choice([0.1, 3.0])
    preferred = random.normal(size=count)
    q = random.uniform(-3.0, 3.0, size=count)
    damping = 1e-3
    inverse = DifferentialInverse(joints(count), braking_s=BRAKING_S, damping=damping)

    found = inverse.speeds(jacobian, velocity, q, preferred)

    variable = cvxpy.Variable(count)
    cost = cvxpy.sum_squares(jacobian @ variable - velocity) + damping * cvxpy.sum_squares(variable - preferred)
    limits = [
        variable <= np.minimum(2.0, (3.0 - q) / BRAKING_S),
        variable >= np.maximum(-2.0, (-3.0 - q) / BRAKING_S),
    ]
    cvxpy.Problem(cvxpy.Minimize(cost), limits).solve(solver=cvxpy.CLARABEL)
    assert found == pytest.approx(variable.value, abs=1e-4)
    assert np.all(np.abs(found) <= 2.0 + 1e-9)


def test_a_joint_never_leaves_its_range_however_it_is_pulled():
    inverse = DifferentialInverse(joints(1, reach=1.0), braking_s=BRAKING_S)
    q, step_s = np.zeros(1), 0.004
    for _ in range(2000):
        q = q + step_s * inverse.speeds(np.eye(6, 1), np.array([9.0, 0, 0, 0, 0, 0]), q, np.zeros(1))
        assert q[0] <= 1.0
    assert q[0] == pytest.approx(1.0, abs=1e-6)
    back = inverse.speeds(np.eye(6, 1), np.array([-9.0, 0, 0, 0, 0, 0]), q, np.zeros(1))
    assert back == pytest.approx([-2.0])


def test_what_the_tool_leaves_open_follows_the_preferred_speeds():
    jacobian = np.zeros((6, 7))
    jacobian[:, :6] = np.eye(6)

    found = DifferentialInverse(joints(7), braking_s=BRAKING_S).speeds(
        jacobian, np.full(6, 0.5), np.zeros(7), np.array([0.5, 0.5, 0.5, 0.5, 0.5, 0.5, -1.25])
    )

    assert found == pytest.approx([0.5] * 6 + [-1.25])


def test_near_a_singularity_the_speeds_stay_bounded():
    jacobian = np.diag([1.0, 1.0, 1.0, 1.0, 1.0, 1e-9])

    found = DifferentialInverse(joints(6), braking_s=BRAKING_S).speeds(jacobian, np.ones(6), np.zeros(6), np.zeros(6))

    assert found[:5] == pytest.approx([1.0] * 5, abs=1e-4)
    assert abs(found[5]) < 1e-2
