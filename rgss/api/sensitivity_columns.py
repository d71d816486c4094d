"""Columns of the frames on the sensitivity of a decision."""

from __future__ import annotations

from rgss.api.column import Column, FrameDescription, Kind
from rgss.api.shared_columns import AS_UNIT, UNIT, VARIANT

TORNADO = FrameDescription(
    name="tornado",
    row="an uncertain input of the decision, the largest swing first",
    index=(Column(name="input", meaning="its name as what_if takes it"),),
    columns=(
        Column(name="kind", meaning="weight, anchor, threshold, assumption or shape"),
        UNIT,
        Column(name="base", meaning="its value in the study", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="low", meaning="low end of its range", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="high", meaning="high end of its range", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="range_is", meaning="stated, elicited or a share of the value, or one of these cut"),
        Column(
            name="lead_low",
            meaning="lead of the choice over the best rival at the low end; missing where it is infeasible",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(name="lead_high", meaning="the same at the high end", unit="1", kind=Kind.NUMBER),
        Column(
            name="swing",
            meaning="greatest minus least lead; infinite where the choice is infeasible at an end",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(name="wins_low", meaning="variants that are best at the low end, separated by commas"),
        Column(name="wins_high", meaning="variants that are best at the high end, separated by commas"),
        Column(
            name="flip_low",
            meaning="value below which the choice changes; missing if it does not",
            unit=AS_UNIT,
            kind=Kind.NUMBER,
        ),
        Column(
            name="flip_high",
            meaning="value above which the choice changes; missing if it does not",
            unit=AS_UNIT,
            kind=Kind.NUMBER,
        ),
    ),
)


AS_REFERENCE = "as `reference_unit` says"

EXCHANGE_RATES = FrameDescription(
    name="exchange_rates",
    row="a measure with a weight, other than the one in which all is paid",
    index=(Column(name="measure", meaning="the measure"),),
    columns=(
        UNIT,
        Column(name="quantity", meaning="quantity of the chosen variant", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="step", meaning="a change for the better", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="gain", meaning="weighted value that it adds", unit="1", kind=Kind.NUMBER),
        Column(name="reference", meaning="the measure in which all is paid"),
        Column(name="reference_unit", meaning="its unit"),
        Column(name="worth", meaning="worth of the step in the reference", unit=AS_REFERENCE, kind=Kind.NUMBER),
        Column(name="is_bound", meaning="true if it is worth more than that", kind=Kind.TRUTH),
        Column(
            name="better_variant",
            meaning="variant with a better quantity and the least worsening of the reference; missing if none",
            unit="1",
            kind=Kind.COUNT,
        ),
        Column(name="better_quantity", meaning="its quantity", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(
            name="extra",
            meaning="its quantity of the reference minus that of the choice",
            unit=AS_REFERENCE,
            kind=Kind.NUMBER,
        ),
        Column(name="misses", meaning="requirements that it misses, separated by commas; none if it is feasible"),
        Column(
            name="is_tied",
            meaning="true if the evidence does not separate its value from that of the choice; missing if not known",
            kind=Kind.TRUTH,
        ),
    ),
)


WORTH_KEEPING = FrameDescription(
    name="worth_keeping",
    row="a feasible variant",
    index=(VARIANT,),
    columns=(
        Column(name="kept", meaning="true if it is worth keeping", kind=Kind.TRUTH),
        Column(name="reason", meaning="best_as_stated, best_for_some, within_margin, dominated or mixture"),
        Column(
            name="shortfall",
            meaning="least difference to the value of the best, over all weights",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="behind",
            meaning="difference to the value of the best at the study's weights",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(name="beaten_by", meaning="variants that beat one that is not kept, separated by commas"),
    ),
)


STAKEHOLDERS = FrameDescription(
    name="stakeholders",
    row="a stakeholder and a feasible variant",
    index=(Column(name="stakeholder", meaning="name of the stakeholder"), VARIANT),
    columns=(
        Column(
            name="regret",
            meaning="difference to the value of their best, by their own weights",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(name="best", meaning="true if it is their best", kind=Kind.TRUTH),
        Column(name="accepted", meaning="true if it is within the accepted distance of their best", kind=Kind.TRUTH),
        Column(
            name="compromise", meaning="true if its largest regret over all stakeholders is the least", kind=Kind.TRUTH
        ),
    ),
)

ASSUMPTIONS = FrameDescription(
    name="assumptions",
    row="an alternative of a modelling assumption",
    index=(
        Column(name="assumption", meaning="its name as what_if takes it"),
        Column(name="alternative", meaning="the alternative value"),
    ),
    columns=(
        Column(name="taken_as", meaning="the value in the study"),
        Column(
            name="chosen",
            meaning="variant that is then chosen; missing if none is, or if trials are missing",
            unit="1",
            kind=Kind.COUNT,
        ),
        Column(name="feasible", meaning="variants that are then feasible", unit="1", kind=Kind.COUNT),
        Column(
            name="changes_choice",
            meaning="true if the study's choice is beaten, and not tied with the best",
            kind=Kind.TRUTH,
        ),
        Column(name="trials", meaning="number of trials that it needs", unit="1", kind=Kind.COUNT),
        Column(name="missing", meaning="number of trials that would have to be run", unit="1", kind=Kind.COUNT),
        Column(name="read_off", meaning="number of trials that follow from stored searches", unit="1", kind=Kind.COUNT),
        Column(name="reason", meaning="why there is no answer; empty if there is one, or if trials are missing"),
    ),
)
