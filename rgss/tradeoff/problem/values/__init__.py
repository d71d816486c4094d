"""Value functions: linear, piecewise, exponential and target.

Every function is anchored on fixed quantities (a requirement's threshold, a goal), never on the sample, so that the
value of an alternative does not depend on the others.
"""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.problem.values.anchors import Anchor, AnchorField, PointEntry, QuantityField, RequirementAnchor
    from rgss.tradeoff.problem.values.bent import AnchoredBent, bent_values, half_value_share
    from rgss.tradeoff.problem.values.exponential import AnchoredExponential, ExponentialValue
    from rgss.tradeoff.problem.values.piecewise import AnchoredPiecewise, PiecewiseValue
    from rgss.tradeoff.problem.values.s_curve import AnchoredSCurve
    from rgss.tradeoff.problem.values.shapes import SHAPE_KEYS, SHAPES, ShapeKeys, shape_of
    from rgss.tradeoff.problem.values.target import AnchoredTarget, TargetValue
    from rgss.tradeoff.problem.values.value_function import TIE_TOLERANCE, AnchoredValue, ValueFunction
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
