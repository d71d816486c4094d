"""Columns of the frames of a trade-off."""

from __future__ import annotations

from rgss.api.column import Column, FrameDescription, Kind
from rgss.api.shared_columns import AS_UNIT, MEASURE, UNIT, VARIANT

RANKING = FrameDescription(
    name="ranking",
    row="a feasible variant, best first",
    index=(Column(name="place", meaning="its rank, from 1; equals are ordered by id", unit="1", kind=Kind.COUNT),),
    columns=(
        VARIANT,
        Column(name="value", meaning="weighted value, from 0 to 1", unit="1", kind=Kind.NUMBER),
        Column(name="tied", meaning="true if it is as good as the best", kind=Kind.TRUTH),
        Column(name="near_tie", meaning="true if it is not tied but within the practical margin", kind=Kind.TRUTH),
        Column(
            name="objective_N",
            meaning="objective N of the program, from 1",
            unit="the program's",
            kind=Kind.NUMBER,
        ),
    ),
)


PARETO = FrameDescription(
    name="pareto",
    row="a feasible variant",
    index=(VARIANT,),
    columns=(
        Column(
            name="support", meaning="extreme, supported, weakly_supported or unsupported on the front, or dominated"
        ),
        Column(
            name="shortfall",
            meaning="least difference to the value of the best, over all weights; missing if dominated",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="dominated_by", meaning="a variant that dominates it; missing on the front", unit="1", kind=Kind.COUNT
        ),
        Column(
            name="value_MEASURE",
            meaning="its value in a weighted measure, from 0 to 1",
            unit="1",
            kind=Kind.NUMBER,
        ),
    ),
)


EFFECTS = FrameDescription(
    name="effects",
    row="a measure, one or two factors, and a level of each",
    index=(
        MEASURE,
        Column(name="factors", meaning="the factor, or two joined by a times sign for their interaction"),
        Column(name="levels", meaning="its level, or the levels of both joined by a times sign"),
    ),
    columns=(
        Column(
            name="effect",
            meaning="difference of the mean there from the sum of the lower-order terms",
            unit=AS_UNIT,
            kind=Kind.NUMBER,
        ),
        Column(
            name="low", meaning="lower end of its 95 % interval; missing without noise", unit=AS_UNIT, kind=Kind.NUMBER
        ),
        Column(name="high", meaning="upper end of its 95 % interval", unit=AS_UNIT, kind=Kind.NUMBER),
        UNIT,
        Column(
            name="share",
            meaning="share of the variance between designs that the term explains",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(name="share_low", meaning="lower end of the share's 95 % interval", unit="1", kind=Kind.NUMBER),
        Column(name="share_high", meaning="upper end of the share's 95 % interval", unit="1", kind=Kind.NUMBER),
    ),
)


WEIGHTS = FrameDescription(
    name="weights",
    row="a measure with a weight above 0",
    index=(MEASURE,),
    columns=(
        Column(name="weight", meaning="its weight in the decision", unit="1", kind=Kind.NUMBER),
        Column(
            name="low", meaning="least weight at which the chosen variant is still best", unit="1", kind=Kind.NUMBER
        ),
        Column(name="high", meaning="greatest such weight", unit="1", kind=Kind.NUMBER),
        Column(name="below", meaning="variants that win just below, separated by commas; empty if none"),
        Column(name="above", meaning="variants that win just above, separated by commas; empty if none"),
    ),
)


ACCEPTABILITY = FrameDescription(
    name="acceptability",
    row="a variant",
    index=(VARIANT,),
    columns=(
        Column(name="first", meaning="share of weights and noise for which it is the best", unit="1", kind=Kind.NUMBER),
        Column(name="first_error", meaning="standard error of that share", unit="1", kind=Kind.NUMBER),
        Column(name="unranked", meaning="share of the noise in which it cannot be chosen", unit="1", kind=Kind.NUMBER),
        Column(
            name="confidence",
            meaning="probability that it is best at its central weights; missing if it never is",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="central_MEASURE", meaning="mean weight of a measure where it is the best", unit="1", kind=Kind.NUMBER
        ),
    ),
)


CHANGES = FrameDescription(
    name="changes",
    row="a supposition, or a consequence of one",
    index=(
        Column(
            name="what",
            meaning="name of the changed quantity, such as weight.t_e; an alternative reading has no numbers",
        ),
    ),
    columns=(
        Column(name="before", meaning="its value in the project", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="after", meaning="the supposed value", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of both"),
        Column(name="asked", meaning="true if it was supposed, false if it is a consequence", kind=Kind.TRUTH),
    ),
)


PORTFOLIO = FrameDescription(
    name="portfolio",
    row="a study that the portfolio serves",
    index=(Column(name="study", meaning="file of the study"),),
    columns=(
        Column(name="member", meaning="member of the portfolio that serves it: a component, or a variant"),
        Column(name="variant", meaning="id of the design variant that serves it", unit="1", kind=Kind.COUNT),
        Column(name="value", meaning="its weighted value in that study", unit="1", kind=Kind.NUMBER),
        Column(name="status", meaning="status of the portfolio: optimal, or best found where that is not proven"),
        Column(name="gap", meaning="upper bound of the improvement by another portfolio", unit="1", kind=Kind.NUMBER),
    ),
)
