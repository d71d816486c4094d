"""Registry of value shapes: what a new shape must bring, and that its keys are nowhere else."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import SHAPE_KEYS, AnchoredValue, ShapeKeys, shape_of
from rgss.tradeoff.problem.values import (
    SHAPES,
    AnchoredExponential,
    AnchoredPiecewise,
    AnchoredSCurve,
    AnchoredTarget,
    ExponentialValue,
    PiecewiseValue,
    RequirementAnchor,
    TargetValue,
)

EXAMPLES: tuple[AnchoredValue, ...] = (
    AnchoredTarget(measure="m", target=0.5, too_low=-1.0, too_high=2.0),
    AnchoredPiecewise(measure="m", worst=2.0, best=-1.0, between=((1.0, 0.1),)),
    AnchoredExponential(measure="m", worst=-1.0, best=2.0, halfway=0.0),
    AnchoredSCurve(measure="m", worst=2.0, best=-1.0, steepest=0.0),
)


def test_every_shape_has_an_example():
    assert tuple(type(example) for example in EXAMPLES) == SHAPES


def test_the_document_has_the_keys_of_the_shapes_and_no_others():
    assert set(SHAPE_KEYS) == set(ShapeKeys.model_fields)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_fields_of_a_shape_are_its_keys(shape):
    fields = {field.name: field.default is dataclasses.MISSING for field in dataclasses.fields(shape)}
    assert fields.pop("measure")
    assert fields == {**dict.fromkeys(shape.required, True), **dict.fromkeys(shape.optional, False)}
    assert set(shape.own) <= set(fields)
    assert set(shape.ends) <= set(shape.required)


@pytest.mark.parametrize("shape", SHAPES)
def test_own_keys_decide_the_shape(shape):
    for other in SHAPES:
        assert other is shape or not set(shape.own) & set(other.own)
    assert shape_of(shape.own) is shape
    assert shape_of(("worst", "best")) is AnchoredPiecewise


@pytest.mark.parametrize("example", EXAMPLES)
def test_a_function_agrees_with_its_peak_its_points_and_its_ends(example):
    function = example.function(float)
    quantities = np.linspace(-2.0, 3.0, 201)
    values = [function.value_at(float(quantity)) for quantity in quantities]

    assert function.value_at(example.worst_anchor) == 0.0
    assert function.value_at(example.best_anchor) == 1.0
    assert (function.peak is None) is (function.more_is_better is not None)
    if function.peak is None:
        assert (np.diff(values) * (1.0 if function.more_is_better else -1.0) >= 0.0).all()
    else:
        assert function.value_at(function.peak) == 1.0
        assert function.value_at(function.peak - 0.1) < 1.0 > function.value_at(function.peak + 0.1)
    if function.breakpoints is not None:
        at, worth = np.transpose(function.breakpoints)
        assert (np.diff(at) > 0.0).all()
        np.testing.assert_allclose(np.interp(quantities, at, worth), values, atol=1e-12)


def test_anchors_move_and_resolve():
    anchored = AnchoredPiecewise(
        measure="m", worst=RequirementAnchor(requirement="R", times=2.0), best=9.0, between=((4.0, 0.5),)
    )
    resolved = {"R": 1.5}

    def quantity_of(anchor):
        return anchor.times * resolved[anchor.requirement] if isinstance(anchor, RequirementAnchor) else anchor

    assert anchored.function(quantity_of) == PiecewiseValue(measure="m", worst=3.0, best=9.0, interior=((4.0, 0.5),))
    assert set(anchored.anchors) == {"worst", "best"}
    moved = anchored.with_anchor("worst", 1.0)
    assert moved.function(quantity_of).worst == 1.0
    assert moved.between == anchored.between
    halfway = AnchoredExponential(measure="m", worst=0.0, best=1.0, halfway=0.2).with_anchor("halfway", 0.4)
    assert halfway.function(float) == ExponentialValue(measure="m", worst=0.0, best=1.0, halfway=0.4)
    target = AnchoredTarget(measure="m", target=0.5, too_low=0.0, too_high=1.0)
    assert target.function(float) == TargetValue(measure="m", target=0.5, too_low=0.0, too_high=1.0)


def test_an_s_curve_is_steepest_where_it_says_and_is_computed_alike_in_both_ways():
    curve = AnchoredSCurve(measure="m", worst=2.0, best=-1.0, steepest=0.5).function(float)
    quantities = np.linspace(-2.0, 3.0, 2001)
    values = curve.values_at(quantities)

    np.testing.assert_allclose(values, [curve.value_at(float(one)) for one in quantities], atol=1e-12)
    assert quantities[np.argmin(np.gradient(values))] == pytest.approx(0.5, abs=0.005)
    assert curve.value_at(0.5) == pytest.approx(0.5)
    with pytest.raises(TradeoffError, match=r"^the steepest quantity 2 of 'm' is not between 2 and -1 "):
        AnchoredSCurve(measure="m", worst=2.0, best=-1.0, steepest=2.0).function(float)
