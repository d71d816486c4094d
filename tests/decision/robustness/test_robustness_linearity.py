"""Whether a measure is linear in its symbols, read off expressions and held against their values."""

from __future__ import annotations

import itertools

import pytest

from rgss.decision.robustness.linearity import AFFINE, CONSTANT, OTHER, _degree, is_affine
from rgss.measures import design_values
from rgss.measures.parsing import parse_expression


@pytest.mark.parametrize(
    ("text", "degree"),
    [
        ("3", CONSTANT),
        ("k + 2", CONSTANT),
        ("k / (k + 1) ** 2", CONSTANT),
        ("min(k, 2)", CONSTANT),
        ("x", AFFINE),
        ("-x + 2 * y - 1", AFFINE),
        ("k * x / 3", AFFINE),
        ("sum(x) + mean(y)", AFFINE),
        ("x ** 1", AFFINE),
        ("x * y", OTHER),
        ("x ** 2", OTHER),
        ("1 / x", OTHER),
        ("min(x, 2)", OTHER),
        ("abs(x)", OTHER),
        ("sqrt(x)", OTHER),
        ("max(k, y)", OTHER),
    ],
)
def test_expressions(text, degree):
    expression = parse_expression(text)

    assert _degree(expression.root, {"x": AFFINE, "y": AFFINE}) == degree


@pytest.mark.parametrize(
    ("measure", "symbols", "affine"),
    [
        ("C_total", ["c_m", "c_g", "c_a", "c_al"], True),
        ("C_total", ["c_a", "N_a"], False),
        ("P_max", ["M_a"], False),
        ("P_max", ["c_m"], True),
        ("M_g", ["M_a"], True),
        ("t_gc", ["d_f"], True),
        ("t_gc", ["v_f"], False),
        ("t_e", ["d_f"], True),
        ("t_e", ["v_d"], False),
        ("S", ["phases_completed"], False),
    ],
)
def test_measures_of_the_shipped_project(shipped, measure, symbols, affine):
    assert is_affine(shipped.measures, measure, symbols) is affine


@pytest.mark.parametrize("measure", ["C_total", "M_g", "C_g", "t_gc", "P_max_g", "P_max_m", "P_max"])
def test_what_is_called_affine_is(shipped, measure):
    """For every pair of inputs of designs: equal steps make equal changes."""
    from rgss.designs import sources

    fixed = dict(sources(shipped.designs.expand()[0]))
    inputs = [symbol for symbol in shipped.measures.inputs if not symbol.from_trial]

    def at(changes):
        return design_values(shipped.measures, fixed={**fixed, **changes}, variant=1)[measure]

    checked = 0
    for first, second in itertools.combinations(inputs, 2):
        if not is_affine(shipped.measures, measure, [first.id, second.id]):
            continue
        checked += 1
        values = {one.source: float(fixed[one.source]) for one in (first, second)}
        steps = [at({source: value * (1.0 + 0.1 * step) for source, value in values.items()}) for step in range(3)]
        assert steps[2] - steps[1] == pytest.approx(steps[1] - steps[0], abs=1e-9 * abs(steps[0]))
    assert checked
