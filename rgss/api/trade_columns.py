"""Columns of the frames of a trade-off."""

from __future__ import annotations

from rgss.api.column import Column, FrameDescription, Kind
from rgss.api.shared_columns import AS_UNIT, MEASURE, UNIT, VARIANT

RANKING = FrameDescription(
    name="ranking",
    row="a feasible variant, best first",
    index=(Column(name="place", meaning="its place, from 1; equals stand by ascending id", unit="1", kind=Kind.COUNT),),
    columns=(
        VARIANT,
        Column(name="value", meaning="weighted value, from 0 to 1", unit="1", kind=Kind.NUMBER),
        Column(name="tied", meaning="whether it is as good as the best", kind=Kind.TRUTH),
        Column(name="near_tie", meaning="whether it is not tied but within the practical margin", kind=Kind.TRUTH),
        Column(
            name="objective_N",
            meaning="what the program optimises in turn, N from 1",
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
            meaning="least by which the best is worth more, over all weights; missing if dominated",
            unit="1",
            kind=Kind.NUMBER,
        ),
        Column(
            name="dominated_by", meaning="a variant that dominates it; missing on the front", unit="1", kind=Kind.COUNT
        ),
        Column(
            name="value_MEASURE",
            meaning="what it is worth in a weighted measure, from 0 to 1",
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
        Column(
            name="factors", meaning="the factor, or two with a times sign between for what they do beyond each alone"
        ),
        Column(name="levels", meaning="its level, or the levels of both with a times sign between"),
    ),
    columns=(
        Column(
            name="effect",
            meaning="how far the mean there is from what the terms above say",
            unit=AS_UNIT,
            kind=Kind.NUMBER,
        ),
        Column(
            name="low", meaning="lower end of its 95 % interval; missing without noise", unit=AS_UNIT, kind=Kind.NUMBER
        ),
        Column(name="high", meaning="upper end of its 95 % interval", unit=AS_UNIT, kind=Kind.NUMBER),
        UNIT,
        Column(
            name="share", meaning="share of the differences between designs, of the term", unit="1", kind=Kind.NUMBER
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
        Column(name="below", meaning="variants that win just below, with commas between; empty if none"),
        Column(name="above", meaning="variants that win just above, with commas between; empty if none"),
    ),
)


ACCEPTABILITY = FrameDescription(
    name="acceptability",
    row="a variant",
    index=(VARIANT,),
    columns=(
        Column(name="first", meaning="share of weights and noise for which it is the best", unit="1", kind=Kind.NUMBER),
        Column(name="first_error", meaning="standard error of that", unit="1", kind=Kind.NUMBER),
        Column(name="unranked", meaning="share of noise in which it cannot be chosen", unit="1", kind=Kind.NUMBER),
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
    row="what is supposed, or follows from it",
    index=(
        Column(
            name="what", meaning="what is another, such as weight.t_e; a reading with its name, which has no numbers"
        ),
    ),
    columns=(
        Column(name="before", meaning="its value in the project", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="after", meaning="the value that is supposed", unit=AS_UNIT, kind=Kind.NUMBER),
        Column(name="unit", meaning="unit of both"),
        Column(name="asked", meaning="whether it was asked for; otherwise it follows", kind=Kind.TRUTH),
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
        Column(name="status", meaning="of the portfolio: optimal, or best found where that is not proven"),
        Column(name="gap", meaning="by how much another portfolio can be better at most", unit="1", kind=Kind.NUMBER),
    ),
)
