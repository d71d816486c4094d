"""Bars of a decision's sensitivity: the tornado of its inputs, and the range of each weight."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from rgss.reports.decision import ids_text
from rgss.reports.study_plots.canvas import (
    FAINT,
    INK,
    LIMIT,
    StudyFigure,
    dress,
    legend_below,
    new_figure,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import PlottedDesigns, Role

_LOW, _HIGH = "#56b4e9", "#d55e00"


@dataclass(frozen=True, slots=True, kw_only=True)
class InputBar:
    """An uncertain input of a decision.

    Attributes:
        id: Its name.
        low: Text of the low end of its range.
        high: Text of the high end.
        lead_low: Lead of the chosen design at the low end; NaN if it is infeasible there.
        lead_high: Lead at the high end.
    """

    id: str
    low: str
    high: str
    lead_low: float
    lead_high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightRange:
    """A weight, and the range in which the choice stays the same.

    Attributes:
        measure: Id of its measure.
        weight: The weight.
        low: Least weight at which the choice stays.
        high: Greatest one.
        below: Variants that win below the range.
        above: Variants that win above it.
    """

    measure: str
    weight: float
    low: float
    high: float
    below: str
    above: str


def tornado_figure(bars: Sequence[InputBar], lead: float, designs: PlottedDesigns, left_out: int) -> StudyFigure:
    """Lead of the chosen design over its best rival over the range of each input.

    Args:
        bars: The inputs, the largest swing first.
        lead: Lead with the values of the study.
        designs: The designs.
        left_out: Number of inputs that are not drawn.
    """
    note = f"{left_out} inputs with a smaller effect are not drawn" if left_out else ""
    chosen = (designs.with_role(Role.CHOSEN) or [0])[0]
    title = f"Lead of variant {chosen} over the range of each input"
    figure = new_figure(8.4, 2.0 + 0.34 * len(bars), title)
    ax = figure.subplots()
    known = [end for bar in bars for end in (bar.lead_low, bar.lead_high) if math.isfinite(end)]
    least, most = min([0.0, lead, *known]), max([0.0, lead, *known])
    room = 0.16 * ((most - least) or 1.0)
    for row, bar in enumerate(bars):
        ends = sorted(
            ((bar.lead_low, _LOW, bar.low), (bar.lead_high, _HIGH, bar.high)), key=lambda end: -_far(end[0], lead)
        )
        for end, colour, _ in ends:
            if math.isfinite(end):
                ax.barh(row, end - lead, left=lead, height=0.62, color=colour, edgecolor="white", linewidth=0.5)
        missed = [words for end, _, words in ends if not math.isfinite(end)]
        if missed:
            ax.text(
                least - 0.1 * room,
                row,
                f"✕ at {' and '.join(missed)}",
                ha="right",
                va="center",
                fontsize=8,
                color=LIMIT,
            )
    ax.axvline(lead, color=INK, linewidth=1.2)
    ax.axvline(0.0, color=LIMIT, linestyle="--", linewidth=1.1)
    any_missed = any(not math.isfinite(end) for bar in bars for end in (bar.lead_low, bar.lead_high))
    ax.set_xlim(least - room * (2.6 if any_missed else 0.4), most + 0.4 * room)
    ax.set_yticks(range(len(bars)), [f"{bar.id}\n{bar.low} to {bar.high}" for bar in bars], fontsize=8)
    ax.invert_yaxis()
    ax.set_xlabel("lead over the best rival [1]; below 0 another design is chosen\nhigher is better →", fontsize=9.5)
    ax.set_ylabel("uncertain input with its range", fontsize=9.5, color=INK)
    dress([ax], grid="x")
    handles = [
        Patch(color=_LOW, label="low end"),
        Patch(color=_HIGH, label="high end"),
        Line2D([], [], color=INK, label=f"as stated: {lead:.4f}"),
        Line2D([], [], color=LIMIT, linestyle="--", label="no lead; ✕ infeasible"),
    ]
    legend_below(figure, handles, designs, note)
    set_alt_text(
        figure,
        f"Tornado of the lead of variant {chosen}, {lead:.4f} as stated",
        "the largest swing first: " + ", ".join(bar.id for bar in bars[:8]) if bars else "no input moves it",
        note,
    )
    return figure


def weights_figure(ranges: Sequence[WeightRange], designs: PlottedDesigns) -> StudyFigure:
    """Range of each weight alone within which the chosen design stays the best."""
    chosen = ids_text(designs.with_role(Role.CHOSEN))
    figure = new_figure(8.4, 2.0 + 0.5 * len(ranges), f"Weights at which variant {chosen} stays the best")
    ax = figure.subplots()
    for row, one in enumerate(ranges):
        ax.plot([0.0, 1.0], [row, row], color="#e3e7eb", linewidth=9, solid_capstyle="butt", zorder=1)
        ax.plot([one.low, one.high], [row, row], color="#0072b2", linewidth=9, solid_capstyle="butt", zorder=2)
        ax.scatter([one.weight], [row], marker="D", s=42, facecolor="#e69f00", edgecolor=INK, zorder=4)
        for at, ha, shift, winner in ((one.low, "right", -3, one.below), (one.high, "left", 3, one.above)):
            if winner:
                ax.annotate(
                    f"{winner} win" + ("" if "," in winner or "–" in winner else "s"),
                    xy=(at, row),
                    xytext=(shift, 9),
                    textcoords="offset points",
                    ha="left" if at < 0.2 else ha,
                    fontsize=8,
                    color=FAINT,
                )
    ax.set_yticks(range(len(ranges)), [f"{one.measure}\n{one.low:.3g} to {one.high:.3g}" for one in ranges], fontsize=9)
    ax.set_ylim(len(ranges) - 0.4, -0.7)
    ax.set_xlim(-0.02, 1.02)
    ax.set_xlabel("weight [1], the others in their proportions; no preferred direction", fontsize=9.5, color=INK)
    ax.set_ylabel("weighted measure", fontsize=9.5, color=INK)
    dress([ax], grid="x")
    handles = [
        Patch(color="#0072b2", label=f"variant {chosen} stays the best"),
        Patch(color="#e3e7eb", label="another is better"),
        Line2D([], [], linestyle="none", marker="D", markerfacecolor="#e69f00", markeredgecolor=INK, label="as stated"),
    ]
    legend_below(figure, handles, designs)
    set_alt_text(
        figure,
        f"Range of each weight at which variant {chosen} stays the best",
        "; ".join(f"{one.measure} {one.weight:.3g}, from {one.low:.3g} to {one.high:.3g}" for one in ranges),
    )
    return figure


def _far(end: float, lead: float) -> float:
    return abs(end - lead) if math.isfinite(end) else math.inf
