"""Trade-off: values, weights and thresholds in; a certified and explained decision out."""

from rgss.tradeoff.certificate import Certificate, ConstraintResidual, StageCertificate
from rgss.tradeoff.checks import Agreement, Check, CheckKind
from rgss.tradeoff.conditions import ChanceBound, Comparison, Condition, Risk, TailBound, Threshold
from rgss.tradeoff.conflicts import (
    Conflicts,
    ConflictSurvival,
    JointRepair,
    LimitChange,
    NearestAlternative,
    Repair,
    RequirementCount,
)
from rgss.tradeoff.deciding import best_alternatives, decide
from rgss.tradeoff.decision import (
    Contribution,
    Counts,
    Decision,
    FlatMeasure,
    InfeasibleAlternative,
    RankedAlternative,
)
from rgss.tradeoff.evidence_table import Alternative, EvidenceTable, Samples
from rgss.tradeoff.export import certificate_to_json, checks_to_json, decision_to_json, fleet_to_json
from rgss.tradeoff.fleet import Assignment, FleetDecision, FleetProblem, FleetTask, decide_fleet
from rgss.tradeoff.fleet_checks import FleetAim
from rgss.tradeoff.fleet_work import Cut
from rgss.tradeoff.hierarchy import CriterionNode, weighting_of, weights_of_criteria
from rgss.tradeoff.independent_solver import SolverCheck, independent_run
from rgss.tradeoff.level_problem import LevelDecision, LevelProblem, decide_levels
from rgss.tradeoff.level_selection import LevelTable, smallest_table
from rgss.tradeoff.level_space import Incompatibility, LevelFactor, LevelSpace, LevelStructure
from rgss.tradeoff.lexicographic import Aim, EpsilonConstraint, Lexicographic
from rgss.tradeoff.minimax_regret import MinimaxRegret, Scenarios
from rgss.tradeoff.overlap import Overlap, SharedPart, overlapping_measures, shared_parts
from rgss.tradeoff.problem import TradeProblem
from rgss.tradeoff.program import AdditiveValue, Program
from rgss.tradeoff.stage import SolverRun
from rgss.tradeoff.status import DecisionStatus
from rgss.tradeoff.tchebycheff import Tchebycheff
from rgss.tradeoff.values import ExponentialValue, PiecewiseValue, TargetValue, ValueFunction
from rgss.tradeoff.weight_bounds import ElicitedInterval, ElicitedOrder, WeightBounds
from rgss.tradeoff.weighting import RankRule, Weighting, weights_from_points, weights_from_ranks

__all__ = [
    "AdditiveValue",
    "Agreement",
    "Aim",
    "Alternative",
    "Assignment",
    "Certificate",
    "ChanceBound",
    "Check",
    "CheckKind",
    "Comparison",
    "Condition",
    "ConflictSurvival",
    "Conflicts",
    "ConstraintResidual",
    "Contribution",
    "Counts",
    "CriterionNode",
    "Cut",
    "Decision",
    "DecisionStatus",
    "ElicitedInterval",
    "ElicitedOrder",
    "EpsilonConstraint",
    "EvidenceTable",
    "ExponentialValue",
    "FlatMeasure",
    "FleetAim",
    "FleetDecision",
    "FleetProblem",
    "FleetTask",
    "Incompatibility",
    "InfeasibleAlternative",
    "JointRepair",
    "LevelDecision",
    "LevelFactor",
    "LevelProblem",
    "LevelSpace",
    "LevelStructure",
    "LevelTable",
    "Lexicographic",
    "LimitChange",
    "MinimaxRegret",
    "NearestAlternative",
    "Overlap",
    "PiecewiseValue",
    "Program",
    "RankRule",
    "RankedAlternative",
    "Repair",
    "RequirementCount",
    "Risk",
    "Samples",
    "Scenarios",
    "SharedPart",
    "SolverCheck",
    "SolverRun",
    "StageCertificate",
    "TailBound",
    "TargetValue",
    "Tchebycheff",
    "Threshold",
    "TradeProblem",
    "ValueFunction",
    "WeightBounds",
    "Weighting",
    "best_alternatives",
    "certificate_to_json",
    "checks_to_json",
    "decide",
    "decide_fleet",
    "decide_levels",
    "decision_to_json",
    "fleet_to_json",
    "independent_run",
    "overlapping_measures",
    "shared_parts",
    "smallest_table",
    "weighting_of",
    "weights_from_points",
    "weights_from_ranks",
    "weights_of_criteria",
]
