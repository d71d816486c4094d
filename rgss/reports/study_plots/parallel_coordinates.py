"""Parallel coordinates: a line for each design through all measures, with the better end at the top."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rgss.figures import rounded_figure
from rgss.reports.decision import ids_text
from rgss.reports.study_plots.canvas import (
    FAINT,
    INK,
    LIMIT,
    LINES,
    StudyFigure,
    legend_below,
    new_figure,
    role_handles,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import Limit, PlottedDesigns, PlottedMeasure, Role
from rgss.reports.study_plots.scatter import finite_span
from rgss.trace.views import value_in_words

_LINE_WORDS = 14
_SHIFT = 0.022
"""Offset between the lines of coinciding designs, as a share of the height."""


def parallel_figure(measures: Sequence[PlottedMeasure], designs: PlottedDesigns, flat: Sequence[str]) -> StudyFigure:
    """A line for each design.

    Args:
        measures: The measures, none of which is the same for all designs.
        designs: The designs.
        flat: Measures that are omitted because all designs have the same value.
    """
    note = f"the same for all designs: {', '.join(flat)}" if flat else ""
    figure = new_figure(max(7.4, 1.35 * len(measures) + 1.0), 5.4, "Designs over all measures")
    ax = figure.subplots()
    spans = [_span(measure, designs) for measure in measures]
    groups: dict[tuple[float, ...], list[int]] = {}
    for variant in designs.roles:
        heights = tuple(_height(one, one.value(variant), span) for one, span in zip(measures, spans, strict=True))
        groups.setdefault(heights, []).append(variant)
    places = np.arange(len(measures))
    order = list(Role)
    for heights, variants in groups.items():
        roles = sorted({designs.roles[variant] for variant in variants}, key=order.index)
        for number, role in enumerate(roles):
            shifted = np.array(heights) + _SHIFT * number
            single = len([one for one in heights if math.isfinite(one)]) == 1
            ax.plot(places, shifted, zorder=3 + order.index(role), marker="o" if single else None, **LINES[role])
    for place, (measure, span) in enumerate(zip(measures, spans, strict=True)):
        _draw_axis(figure, place, measure, span)
    ax.set_xlim(-0.45, len(measures) - 0.4)
    ax.set_ylim(-0.1, 1.12)
    ax.set_xticks(places, [_title(measure) for measure in measures], fontsize=8.5, color=INK)
    ax.tick_params(length=0)
    ax.set_yticks([])
    ax.set_ylabel("better →", fontsize=9.5, color=INK)
    ax.spines[["top", "right", "left", "bottom"]].set_visible(False)
    legend_below(figure, role_handles(designs, lines=True), designs, note)
    chosen = designs.with_role(Role.CHOSEN)
    shown = "; ".join(f"{one.id} {value_in_words(one.value(chosen[0]), one.unit)}" for one in measures if chosen)
    set_alt_text(
        figure,
        f"Parallel coordinates of {len(designs.roles)} designs over {', '.join(one.id for one in measures)}, the "
        "better end above",
        designs.summary(),
        f"the chosen design has {shown}" if shown else "",
        f"lines that coincide: {ids_text(_coinciding(groups))}" if _coinciding(groups) else "",
        note,
    )
    return figure


def _coinciding(groups: dict[tuple[float, ...], list[int]]) -> list[int]:
    return [variant for variants in groups.values() if len(variants) > 1 for variant in variants]


def _span(measure: PlottedMeasure, designs: PlottedDesigns) -> tuple[float, float]:
    low, high = finite_span(measure.value(variant) for variant in designs.roles)
    span = (high - low) or abs(high) or 1.0
    near = [one.value for one in measure.limits if low - span <= one.value <= high + span]
    return min([low, *near]), max([high, *near])


def _height(measure: PlottedMeasure, value: float, span: tuple[float, float]) -> float:
    share = (value - span[0]) / ((span[1] - span[0]) or 1.0)
    # Rounded, so that noise in the last digit does not separate coinciding lines.
    return round(1.0 - share if measure.sign < 0 else share, 9)


def _title(measure: PlottedMeasure) -> str:
    lines = [""]
    for word in measure.name.split():
        joined = f"{lines[-1]} {word}".strip()
        if len(joined) > _LINE_WORDS and lines[-1]:
            lines.append(word)
        else:
            lines[-1] = joined
    return "\n".join([*lines, measure.symbol, f"{measure.better.value} is better"])


def _draw_axis(figure: StudyFigure, place: int, measure: PlottedMeasure, span: tuple[float, float]) -> None:
    ax = figure.axes[0]
    ax.axvline(place, color=FAINT, linewidth=0.9, zorder=2, ymin=0.1 / 1.22, ymax=1.1 / 1.22)
    worst, best = span if measure.sign > 0 else span[::-1]
    for height, value, va in ((1.02, best, "bottom"), (-0.025, worst, "top")):
        ax.text(place, height, rounded_figure(value), ha="center", va=va, fontsize=8.5)
    for limit in measure.limits:
        if span[0] <= limit.value <= span[1]:
            _draw_limit(figure, place, limit, _height(measure, limit.value, span))


def _draw_limit(figure: StudyFigure, place: int, limit: Limit, height: float) -> None:
    ax = figure.axes[0]
    ax.plot([place - 0.09, place + 0.09], [height, height], color=LIMIT, linewidth=2.0, zorder=12)
    ax.annotate(
        limit.requirement,
        xy=(place + 0.1, height),
        xytext=(2, 0),
        textcoords="offset points",
        va="center",
        fontsize=8,
        color=LIMIT,
        zorder=15,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6},
    )
