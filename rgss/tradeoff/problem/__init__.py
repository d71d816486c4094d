"""Statement of a trade-off: alternatives, values, weights, conditions and hierarchy."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.requirements import Comparison
    from rgss.tradeoff.problem.alternatives import Array, Mask, checked_values, checked_weights, classes
    from rgss.tradeoff.problem.conditions import (
        EVIDENCE_PREFIX,
        LIMIT_PREFIX,
        PREFIXES,
        ChanceBound,
        Condition,
        Risk,
        TailBound,
        Threshold,
        replicates_of,
    )
    from rgss.tradeoff.problem.dominance import nondominated
    from rgss.tradeoff.problem.equals import chosen_of_equals, surpassed_equals
    from rgss.tradeoff.problem.evidence_table import Alternative, EvidenceTable, Samples, check_evidence, tabulated
    from rgss.tradeoff.problem.further_replicates import further_shifts
    from rgss.tradeoff.problem.hierarchy import CriterionNode, weighting_of, weights_of_criteria
    from rgss.tradeoff.problem.level_space import Incompatibility, LevelFactor, LevelSpace, LevelStructure
    from rgss.tradeoff.problem.posterior import ObservedRows, posterior_means
    from rgss.tradeoff.problem.resampling import FEWEST_REPLICATES, Resamples, bootstrap, interval
    from rgss.tradeoff.problem.values import (
        SHAPE_KEYS,
        TIE_TOLERANCE,
        Anchor,
        AnchoredBent,
        AnchoredValue,
        AnchorField,
        ExponentialValue,
        PiecewiseValue,
        PointEntry,
        QuantityField,
        RequirementAnchor,
        ShapeKeys,
        TargetValue,
        ValueFunction,
        bent_values,
        half_value_share,
        shape_of,
    )
    from rgss.tradeoff.problem.weight_bounds import ElicitedInterval, ElicitedOrder, WeightBounds
    from rgss.tradeoff.problem.weighting import RankRule, Weighting, weights_from_points, weights_from_ranks
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
