"""Measures of performance and effectiveness: definitions, expressions, estimates and verdicts."""

from rgss.measures.anytime_evidence import bounded_mean_evidence, proportion_evidence
from rgss.measures.building import load_measures
from rgss.measures.definition_digests import definition_digest
from rgss.measures.definitions import (
    Constant,
    Direction,
    InputSymbol,
    Measure,
    MeasureKind,
    MeasureSet,
)
from rgss.measures.document import MeasuresDocument
from rgss.measures.equation_gaps import ModelGap, model_gaps
from rgss.measures.estimates import Estimate, proportion_estimate
from rgss.measures.estimators import Estimator, Population, Summary
from rgss.measures.evaluation import (
    COMPLETE,
    design_values,
    evaluate,
    needed_symbols,
    replicate_ranges,
    trial_values,
)
from rgss.measures.expressions import Binary, Call, Name, Negative, Node, Number, Power
from rgss.measures.functions import FIRST_KNOWN, FUNCTIONS, Value
from rgss.measures.possible_values import estimate_ranges
from rgss.measures.ranges import Range
from rgss.measures.ratios import ratio_values
from rgss.measures.readings import with_alternative
from rgss.measures.substitutions import Substitution, may_substitute, replaceable_symbols, substitutions_in
from rgss.measures.undefined import undefined_measures
from rgss.measures.verdicts import StaleCause, Verdict, judge, meets
