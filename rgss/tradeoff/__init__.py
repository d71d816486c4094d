"""Trade-off: values, weights and thresholds in; a certified and explained decision out."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.tradeoff.deciding import best_alternatives, decide
    from rgss.tradeoff.decision import (
        Contribution,
        Decision,
        FlatMeasure,
        InfeasibleAlternative,
        RankedAlternative,
        decision_view,
    )
    from rgss.tradeoff.infeasibility import (
        Conflicts,
        ConflictSurvival,
        JointRepair,
        LimitChange,
        NearestAlternative,
        Repair,
        RequirementCount,
    )
    from rgss.tradeoff.levels import LevelProblem, LevelTable, decide_levels, smallest_table
    from rgss.tradeoff.milp import Agreement, Check, CheckKind, DecisionStatus, SolverCheck, SolverRun, independent_run
    from rgss.tradeoff.portfolio import (
        Assignment,
        Cut,
        PortfolioAim,
        PortfolioDecision,
        PortfolioProblem,
        PortfolioTask,
        decide_portfolio,
    )
    from rgss.tradeoff.problem import (
        SHAPE_KEYS,
        Alternative,
        Anchor,
        AnchoredValue,
        AnchorField,
        ChanceBound,
        Comparison,
        Condition,
        CriterionNode,
        ElicitedInterval,
        ElicitedOrder,
        EvidenceTable,
        ExponentialValue,
        Incompatibility,
        LevelFactor,
        LevelSpace,
        LevelStructure,
        PiecewiseValue,
        PointEntry,
        QuantityField,
        RankRule,
        RequirementAnchor,
        Risk,
        ShapeKeys,
        TailBound,
        TargetValue,
        Threshold,
        ValueFunction,
        WeightBounds,
        Weighting,
        shape_of,
        weighting_of,
        weights_from_points,
        weights_from_ranks,
        weights_of_criteria,
    )
    from rgss.tradeoff.programs import (
        AdditiveValue,
        Aim,
        EpsilonConstraint,
        Lexicographic,
        MinimaxRegret,
        Program,
        Scenarios,
        Tchebycheff,
        TradeProblem,
    )
    from rgss.tradeoff.robustness import Overlap, SharedPart, overlapping_measures, shared_parts
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
