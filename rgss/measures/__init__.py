"""Measures of performance and effectiveness: definitions, expressions, estimates, verdicts."""

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
from rgss.measures.verdicts import Verdict, judge, meets

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
    "Summary",
    "Verdict",
    "design_values",
    "evaluate",
    "judge",
    "load_measures",
    "meets",
    "trial_values",
]
