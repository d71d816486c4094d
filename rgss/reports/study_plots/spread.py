"""Distribution of a measure over the designs: intervals in order, and boxes with every design as a mark."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from rgss.reports.study_plots.canvas import (
    FAINT,
    INK,
    MARKS,
    StudyFigure,
    dress,
    legend_below,
    new_figure,
    role_handles,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import PlottedDesigns, PlottedMeasure, Role
from rgss.reports.study_plots.scatter import draw_limit, end_within

_MOST_NAMED = 40
"""With more designs, the axis labels only some of them."""


def spread_figure(
    measure: PlottedMeasure, designs: PlottedDesigns, groups: Mapping[str, Sequence[int]], grouped_by: str
) -> StudyFigure:
    """Intervals of a measure, the best design first, beside boxes of its values."""
    known = measure.known(designs.roles)
    missing = len(designs.roles) - len(known)
    note = f"{missing} designs have no value" if missing else ""
    title = f"{measure.name} of {len(known)} designs"
    figure = new_figure(8.4, 4.8, title)
    wide, boxes = figure.subplots(1, 2, sharey=True, width_ratios=(2.4, 0.5 + 0.45 * len(groups)))
    ordered = sorted(known, key=lambda variant: (-measure.sign * measure.value(variant), variant))
    _draw_intervals(wide, measure, designs, ordered)
    _draw_boxes(boxes, measure, designs, groups)
    for ax in (wide, boxes):
        for limit in measure.limits:
            draw_limit(ax, limit, vertical=False, words=ax is wide)
    # The boxes share the scale of the intervals.
    end_within(wide, measure, vertical=False)
    wide.set_ylabel(f"{measure.title}\n{measure.better_end}", fontsize=9.5, color=INK)
    wide.set_xlabel("design variant, the best on the left; bars are 95 % intervals", fontsize=9.5, color=INK)
    boxes.set_xlabel(grouped_by, fontsize=9.5, color=INK)
    dress([wide, boxes], grid="y")
    legend_below(figure, role_handles(designs), designs, note)
    values = [measure.value(variant) for variant in known]
    spread = f"from {min(values):.4g} to {max(values):.4g}, median {float(np.median(values)):.4g}" if values else ""
    limits = "; ".join(str(limit) for limit in measure.limits)
    set_alt_text(
        figure,
        f"Distribution of {measure.title} over {len(known)} designs {spread}, {measure.better.value} is better",
        designs.summary(),
        f"limits: {limits}" if limits else "",
        note,
    )
    return figure


def _draw_intervals(ax: Axes, measure: PlottedMeasure, designs: PlottedDesigns, ordered: Sequence[int]) -> None:
    for order, role in enumerate(Role):
        those = [(at, variant) for at, variant in enumerate(ordered) if designs.roles[variant] is role]
        if not those:
            continue
        for at, variant in those:
            ends = measure.interval(variant)
            if ends is not None:
                ax.plot([at, at], ends, color=FAINT, linewidth=0.9, zorder=2)
        ax.scatter(
            [at for at, _ in those],
            [measure.value(variant) for _, variant in those],
            zorder=3 + order,
            clip_on=False,
            **{**MARKS[role], "s": 0.6 * float(MARKS[role]["s"])},
        )
    step = max(1, -(-len(ordered) // _MOST_NAMED))
    ax.set_xticks(
        range(0, len(ordered), step),
        [str(variant) for variant in ordered[::step]],
        fontsize=7,
        rotation=90 if len(ordered) > 12 else 0,
    )
    ax.margins(x=0.02, y=0.08)


def _draw_boxes(
    ax: Axes, measure: PlottedMeasure, designs: PlottedDesigns, groups: Mapping[str, Sequence[int]]
) -> None:
    kept = {name: measure.known(variants) for name, variants in groups.items()}
    names = [name for name, variants in kept.items() if variants]
    for at, name in enumerate(names):
        values = [measure.value(variant) for variant in kept[name]]
        ax.boxplot(
            [values],
            positions=[at],
            widths=0.55,
            showfliers=False,
            manage_ticks=False,
            medianprops={"color": INK, "linewidth": 1.6},
            boxprops={"color": FAINT},
            whiskerprops={"color": FAINT},
            capprops={"color": FAINT},
        )
        side = _sideways(values)
        for order, role in enumerate(Role):
            those = [number for number, variant in enumerate(kept[name]) if designs.roles[variant] is role]
            if those:
                ax.scatter(
                    [at + side[number] for number in those],
                    [values[number] for number in those],
                    zorder=3 + order,
                    clip_on=False,
                    **{**MARKS[role], "s": 0.45 * float(MARKS[role]["s"])},
                )
    ax.set_xticks(range(len(names)), [f"{name}\n{len(kept[name])}" for name in names], fontsize=9)
    ax.set_xlim(-0.6, max(len(names), 1) - 0.4)


def _sideways(values: Sequence[float]) -> list[float]:
    """Horizontal shifts that place equal values side by side."""
    rounded = [float(f"{value:.6g}") for value in values]
    counts = {value: rounded.count(value) for value in set(rounded)}
    seen: dict[float, int] = {}
    shifts = []
    for value in rounded:
        number = seen.get(value, 0)
        seen[value] = number + 1
        step = min(0.07, 0.5 / counts[value])
        shifts.append((number - (counts[value] - 1) / 2) * step)
    return shifts
