"""Registry of the shapes of value functions: a shape's classes are added here, and nowhere else."""

from __future__ import annotations

from collections.abc import Collection

from rgss.tradeoff.problem.values.exponential import AnchoredExponential, ExponentialKeys
from rgss.tradeoff.problem.values.piecewise import AnchoredPiecewise, PiecewiseKeys
from rgss.tradeoff.problem.values.s_curve import AnchoredSCurve, SCurveKeys
from rgss.tradeoff.problem.values.target import AnchoredTarget, TargetKeys
from rgss.tradeoff.problem.values.value_function import AnchoredValue

SHAPES: tuple[type[AnchoredValue], ...] = (AnchoredTarget, AnchoredPiecewise, AnchoredExponential, AnchoredSCurve)
"""The shapes, in the order in which their own keys decide."""

SHAPE_KEYS = tuple(dict.fromkeys(key for shape in SHAPES for key in (*shape.required, *shape.optional)))
"""The keys of all shapes."""


class ShapeKeys(TargetKeys, SCurveKeys, ExponentialKeys, PiecewiseKeys):
    """Base of the document model with the keys of every shape; editors list the last base's first."""


def shape_of(keys: Collection[str]) -> type[AnchoredValue]:
    """The shape that is meant by some keys; linear where no key is a shape's own."""
    return next((shape for shape in SHAPES if any(key in keys for key in shape.own)), AnchoredPiecewise)
