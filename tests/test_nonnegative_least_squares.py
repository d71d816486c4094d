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
