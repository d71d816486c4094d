"""Non-negative least squares, compared with quadratic programs, also where SciPy's answer is no minimum."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.optimize
from scipy.optimize import minimize

from rgss.nonnegative_least_squares import is_minimum, lawson_hanson, nonnegative_least_squares


def _problems(count):
    """Tall, wide, rank-deficient and nearly solvable problems."""
    rng = np.random.default_rng(20)
    for number in range(count):
        rows, columns = int(rng.integers(2, 9)), int(rng.integers(1, 30))
        matrix = rng.normal(size=(rows, columns))
        if number % 3 == 0:
            matrix[:, columns // 2 :] = matrix[:, : columns - columns // 2] * 2.0
        target = matrix @ rng.random(columns) if number % 4 == 0 else rng.normal(size=rows)
        yield matrix, target


def test_the_method_of_lawson_and_hanson_finds_minima():
    for matrix, target in _problems(400):
        point = lawson_hanson(matrix, target, most_steps=30 * matrix.shape[1])
        assert is_minimum(matrix, target, point)


def test_no_smaller_residual_is_found_by_a_general_method():
    for matrix, target in list(_problems(40)):
        point, residual = nonnegative_least_squares(matrix, target)
        assert residual == pytest.approx(np.linalg.norm(matrix @ point - target), abs=1e-12)
        other = minimize(
            lambda x, a=matrix, b=target: 0.5 * float(((a @ x - b) ** 2).sum()),
            np.ones(matrix.shape[1]),
            jac=lambda x, a=matrix, b=target: a.T @ (a @ x - b),
            bounds=[(0.0, None)] * matrix.shape[1],
            method="L-BFGS-B",
        )
        assert residual <= np.sqrt(2.0 * other.fun) + 1e-6


def test_an_answer_of_scipy_that_is_no_minimum_is_replaced(monkeypatch):
    matrix, target = np.array([[1.0, 0.0], [0.0, 1.0]]), np.array([1.0, -1.0])
    monkeypatch.setattr(scipy.optimize, "nnls", lambda *_, **__: (np.array([0.0, 0.5]), 0.0))
    point, residual = nonnegative_least_squares(matrix, target)
    assert point.tolist() == [1.0, 0.0]
    assert residual == 1.0


def test_what_neither_finds_is_said(monkeypatch):
    monkeypatch.setattr(scipy.optimize, "nnls", lambda *_, **__: (np.array([0.0, 0.5]), 0.0))
    with pytest.raises(RuntimeError, match=r"^no minimum of the 2 x 2 least squares was found$"):
        nonnegative_least_squares(np.eye(2), np.ones(2), most_steps=1)


def test_points_that_are_no_minima():
    matrix, target = np.eye(2), np.array([1.0, -1.0])
    assert not is_minimum(matrix, target, np.array([0.0, 0.0]))
    assert not is_minimum(matrix, target, np.array([1.0, -1.0]))
    assert not is_minimum(matrix, target, np.array([2.0, 0.0]))
    assert is_minimum(matrix, target, np.array([1.0, 0.0]))


def test_columns_that_are_nearly_opposite_leave_a_gradient_of_rounding():
    """Contacts of two parallel pads on a box that is held at its middle: their wrenches all but cancel."""
    matrix = np.array(
        [
            [
                -0.999999999999902,
                -0.999999999999902,
                -0.9999999999985857,
                -0.999999999999902,
                0.999999999999902,
                0.9999999999985857,
                0.999999999999666,
                0.9999999999985857,
            ],
            [
                -3.4572819087074813e-07,
                -3.4572818725681377e-07,
                -8.55845623150477e-07,
                -3.457281872365331e-07,
                3.457281863846488e-07,
                8.558456219933738e-07,
                4.473648322617533e-07,
                8.558456228619559e-07,
            ],
            [
                -2.7660616168530385e-07,
                -2.766061681116592e-07,
                -1.4477763802220575e-06,
                -2.766061714337807e-07,
                2.766061707661025e-07,
                1.4477763805343427e-06,
                6.838896437576112e-07,
                1.4477763821903292e-06,
            ],
            [
                -2.93160845024162e-07,
                -9.757045138955232e-08,
                1.4856381718014057e-06,
                9.047422337483357e-07,
                2.931614732676099e-07,
                -2.816314205498164e-08,
                -1.2859290704206417e-06,
                -1.485639736636369e-06,
            ],
            [
                0.5650015956321996,
                0.5650007375122811,
                -2.3341351894263194,
                -2.3341370653392883,
                -0.5650058063079995,
                -0.5650024606523318,
                2.334133960817592,
                2.334134560857375,
            ],
            [
                0.35365757917721835,
                -0.3534492020072206,
                0.3536604277479559,
                -0.35344568373196467,
                -0.353654585091087,
                0.35345101032167653,
                0.35344828623879576,
                -0.3536589743726173,
            ],
        ]
    )
    target = np.array(
        [
            1.5520917884259688e-12,
            -6.117540749871598e-07,
            -1.5784536957955838e-06,
            5.069213667083554e-07,
            9.666906490846117e-06,
            -8.858282757040481e-06,
        ]
    )
    solution, residual = nonnegative_least_squares(matrix, target)

    assert (solution >= 0.0).all()
    # No descent that rounding does not explain, and no point near by or on the axes that is better by more than that.
    generator = np.random.default_rng(1)
    for _ in range(2000):
        other = solution * (1.0 + 1e-3 * generator.standard_normal(8))
        assert np.linalg.norm(matrix @ other - target) >= residual * (1.0 - 1e-3)
