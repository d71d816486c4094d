"""Linear programs: optimum, no solution, and a solver that gives up."""

from __future__ import annotations

import highspy
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from rgss.errors import DefinitionError
from rgss.grasping.linear import maximise

ONES = np.ones((1, 2))


def test_an_optimum():
    # x + y = 1 with x at most 0.25
    best = maximise(np.array([2.0, 1.0]), equal=(ONES, np.ones(1)), at_most=(np.array([[1.0, 0.0]]), np.array([0.25])))

    assert best == pytest.approx([0.25, 0.75])


def test_no_solution():
    assert maximise(np.ones(2), equal=(ONES, -np.ones(1))) is None


@given(st.integers(0, 2**32 - 1), st.integers(1, 5), st.integers(1, 12), st.integers(0, 3))
def test_programs_have_the_optimum_that_another_entrance_finds(seed, equations, width, bounds):
    rng = np.random.default_rng(seed)
    objective, rows = rng.normal(size=width), rng.normal(size=(equations, width))
    # Every second one has a solution for sure.
    sides = rows @ rng.uniform(size=width) if seed % 2 else rng.normal(size=equations)
    limits = (np.vstack([np.ones(width), rng.normal(size=(bounds, width))]), rng.uniform(1.0, width, bounds + 1))
    expected = linprog(
        -objective, A_ub=limits[0], b_ub=limits[1], A_eq=rows, b_eq=sides, bounds=(0.0, None), method="highs"
    )
    found = maximise(objective, equal=(rows, sides), at_most=limits)

    assert (found is None) == (expected.status == 2)
    if found is not None:
        assert objective @ found == pytest.approx(-expected.fun, abs=1e-7)
        assert np.all(found >= -1e-9)
        assert rows @ found == pytest.approx(sides, abs=1e-7)
        assert np.all(limits[0] @ found <= limits[1] + 1e-7)


@pytest.fixture
def gives_up(monkeypatch):
    """Lets the solver reach no verdict for the first times, and notes with what methods it was asked."""
    methods, verdict = [], highspy.Highs.getModelStatus

    def times(count):
        def status(solver):
            methods.append(solver.getOptionValue("solver")[1])
            return highspy.HighsModelStatus.kUnknown if len(methods) <= count else verdict(solver)

        monkeypatch.setattr(highspy.Highs, "getModelStatus", status)
        return methods

    return times


def test_another_method_is_tried(gives_up):
    methods = gives_up(1)

    assert maximise(np.array([2.0, 1.0]), equal=(ONES, np.ones(1))) == pytest.approx([1.0, 0.0])
    assert methods == ["simplex", "ipm"]


def test_no_verdict(gives_up):
    gives_up(2)

    with pytest.raises(DefinitionError) as caught:
        maximise(np.ones(2), equal=(ONES, np.ones(1)))

    assert str(caught.value) == (
        "the linear program of a grasp was not solved: Unknown "
        "(check that the contacts' coefficients and the limits are of a sensible size)"
    )
