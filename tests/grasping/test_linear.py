"""Linear programs: optimum, no solution, and a solver that gives up."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.optimize

from rgss.errors import DefinitionError
from rgss.grasping.linear import maximise

ONES = np.ones((1, 2))


def test_an_optimum():
    # x + y = 1 with x at most 0.25
    best = maximise(np.array([2.0, 1.0]), equal=(ONES, np.ones(1)), at_most=(np.array([[1.0, 0.0]]), np.array([0.25])))

    assert best == pytest.approx([0.25, 0.75])


def test_no_solution():
    assert maximise(np.ones(2), equal=(ONES, -np.ones(1))) is None


def test_another_method_is_tried(monkeypatch):
    solve, methods = scipy.optimize.linprog, []

    def gives_up_once(*arguments, method, **options):
        methods.append(method)
        if len(methods) == 1:
            return SimpleNamespace(status=4, message="lost")
        return solve(*arguments, method=method, **options)

    monkeypatch.setattr(scipy.optimize, "linprog", gives_up_once)

    assert maximise(np.array([2.0, 1.0]), equal=(ONES, np.ones(1))) == pytest.approx([1.0, 0.0])
    assert methods == ["highs-ds", "highs-ipm"]


def test_no_verdict(monkeypatch):
    monkeypatch.setattr(
        scipy.optimize, "linprog", lambda *_, **__: SimpleNamespace(status=4, message="lost\n in numbers")
    )

    with pytest.raises(DefinitionError) as caught:
        maximise(np.ones(2), equal=(ONES, np.ones(1)))

    assert str(caught.value) == (
        "the linear program of a grasp was not solved: lost in numbers "
        "(check that the contacts' coefficients and the limits are of a sensible size)"
    )
