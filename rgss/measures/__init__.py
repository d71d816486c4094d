"""Measures of performance and effectiveness: definitions, expressions, estimates, verdicts."""

from rgss.measures.definition_digest import definition_digest
from rgss.measures.definitions import (
    Assumption,
    Constant,
    Direction,
    Equation,
    EstimateRule,
    Estimator,
    InputSymbol,
    Measure,
    MeasureKind,
    MeasureSet,
    Population,
    Summary,
)
from rgss.measures.document import MeasuresDocument
from rgss.measures.estimates import Estimate
from rgss.measures.evaluation import design_values, evaluate, trial_values
from rgss.measures.loading import load_measures
from rgss.measures.verdicts import StaleCause, Verdict, judge, meets

__all__ = [
    "Assumption",
    "Constant",
    "Direction",
    "Equation",
    "Estimate",
    "EstimateRule",
    "Estimator",
    "InputSymbol",
    "Measure",
    "MeasureKind",
    "MeasureSet",
    "MeasuresDocument",
    "Population",
    "StaleCause",
    "Summary",
    "Verdict",
    "definition_digest",
    "design_values",
    "evaluate",
    "judge",
    "load_measures",
    "meets",
    "trial_values",
]
