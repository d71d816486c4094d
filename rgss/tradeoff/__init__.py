"""Trade-off: values, weights and thresholds in; a certified and explained decision out."""

from rgss.tradeoff.certificate import Certificate, ConstraintResidual
from rgss.tradeoff.conflicts import Conflicts, NearestAlternative, RequirementCount
from rgss.tradeoff.deciding import decide
from rgss.tradeoff.decision import Contribution, Decision, InfeasibleAlternative, RankedAlternative
from rgss.tradeoff.export import decision_to_json
from rgss.tradeoff.overlap import Overlap, overlapping_measures
from rgss.tradeoff.problem import Alternative, Comparison, Threshold, TradeProblem
from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.values import ValueFunction, Weighting

__all__ = [
    "Alternative",
    "Certificate",
    "Comparison",
    "Conflicts",
    "ConstraintResidual",
    "Contribution",
    "Decision",
    "DecisionStatus",
    "InfeasibleAlternative",
    "NearestAlternative",
    "Overlap",
    "RankedAlternative",
    "RequirementCount",
    "Threshold",
    "TradeProblem",
    "ValueFunction",
    "Weighting",
    "decide",
    "decision_to_json",
    "overlapping_measures",
]
