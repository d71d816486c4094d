"""Scatter plots of designs over two measures: roles, intervals, limits, coinciding marks."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.text import Annotation
from matplotlib.transforms import Bbox

from rgss.reports.decision import ids_text
from rgss.reports.study_plots.canvas import (
    FAINT,
    INK,
    LIMIT,
    MARKS,
    StudyFigure,
    dress,
    legend_below,
    new_figure,
    role_handles,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import Limit, PlottedDesigns, PlottedMeasure, Role
from rgss.tradeoff.problem import nondominated

_CELLS = 90
"""Distance, as a share of an axis, below which marks count as coinciding."""
_NAMED = (Role.CHOSEN, Role.TIED, Role.RUNNER_UP, Role.FRONT)
_LONGEST_LABEL = 20
_NEAR = 0.35
"""Greatest distance of a drawn limit from the data, as a share of their span."""
_OFFSETS = ((7, 6), (7, -12), (-7, 6), (-7, -12), (0, 13), (0, -19), (16, -3), (-16, -3), (20, 16), (-20, 16))

Place = tuple[float, float]


def pareto_figure(x: PlottedMeasure, y: PlottedMeasure, designs: PlottedDesigns, *, front: str) -> StudyFigure:
    """Designs over two measures, with the front of both.

    Args:
        x: Measure along the horizontal axis.
        y: Measure along the vertical axis.
        designs: The designs.
        front: Label of the nondominated designs, with the measures.
    """
    shown = y.known(x.known(designs.roles))
    missing = len(designs.roles) - len(shown)
    note = f"{missing} without a value of both are not drawn" if missing else ""
    figure = new_figure(7.4, 5.2, f"{y.name} against {x.name.lower()}")
    ax = figure.subplots()
    ends = front_line(ax, x, y, designs)
    places = scatter_designs(ax, x, y, designs, intervals=True)
    ax.set_xlabel(f"{x.title}\n{x.better_end}", fontsize=9.5, color=INK)
    ax.set_ylabel(f"{y.title}\n{y.better_end}", fontsize=9.5, color=INK)
    dress([ax])
    handles = role_handles(designs, front=front)
    if ends:
        handles.append(Line2D([], [], color="#0072b2", linewidth=1.2, label="front of these two measures"))
    legend_below(figure, handles, designs, note, columns=2)
    label_places(ax, places, designs)
    set_alt_text(
        figure,
        f"Scatter plot of {len(shown)} designs over {x.title} ({x.better.value} is better) and {y.title} "
        f"({y.better.value} is better)",
        designs.summary(),
        f"front of these two measures: {ids_text(ends)}" if ends else "",
        note,
    )
    return figure


def nondominated_of(measures: Sequence[PlottedMeasure], variants: Iterable[int]) -> list[int]:
    """Nondominated variants in some measures; a variant without a value is omitted.

    Args:
        measures: The measures, each with a preferred direction.
        variants: The variants.
    """
    known = list(variants)
    for measure in measures:
        known = measure.known(known)
    if not known:
        return []
    values = np.array([[one.sign * one.value(variant) for one in measures] for variant in known])
    return [variant for variant, is_best in zip(known, nondominated(values), strict=True) if is_best]


def front_line(ax: Axes, x: PlottedMeasure, y: PlottedMeasure, designs: PlottedDesigns) -> list[int]:
    """Draw the front of two measures as steps; returns its variants, none if a measure has no preferred direction."""
    feasible = [variant for variant, role in designs.roles.items() if role not in (Role.INFEASIBLE, Role.UNJUDGED)]
    if x.better.value == "none" or y.better.value == "none":
        return []
    ends = nondominated_of((x, y), feasible)
    corners = sorted({(x.value(variant), y.value(variant)) for variant in ends})
    if len(corners) > 1:
        # Between two designs of the front, one with the worse value of both is not yet dominated.
        where = "post" if x.sign < 0 else "pre"
        across, up = zip(*corners, strict=True)
        ax.step(across, up, where=where, color="#0072b2", linewidth=1.2, zorder=1.5)  # type: ignore[arg-type]
    return ends


def scatter_designs(
    ax: Axes, x: PlottedMeasure, y: PlottedMeasure, designs: PlottedDesigns, *, intervals: bool = False
) -> dict[Place, list[int]]:
    """Draw designs and the limits of both measures.

    Args:
        ax: The axes.
        x: Measure along the horizontal axis.
        y: Measure along the vertical axis.
        designs: The designs.
        intervals: True to draw the intervals of chosen, tied and nondominated designs.

    Returns:
        The variants at each place; coinciding marks are grouped.
    """
    shown = y.known(x.known(designs.roles))
    for order, role in enumerate(Role):
        those = [variant for variant in shown if designs.roles[variant] is role]
        points = ([x.value(variant) for variant in those], [y.value(variant) for variant in those])
        if those:
            ax.scatter(*points, zorder=3 + order, clip_on=False, **MARKS[role])
        for variant in those if intervals and role in _NAMED else ():
            across, up = x.interval(variant), y.interval(variant)
            if across is not None:
                ax.plot(across, [y.value(variant)] * 2, color=FAINT, linewidth=0.7, zorder=2)
            if up is not None:
                ax.plot([x.value(variant)] * 2, up, color=FAINT, linewidth=0.7, zorder=2)
    ax.margins(0.09)
    for measure, vertical in ((x, True), (y, False)):
        for limit in measure.limits:
            draw_limit(ax, limit, vertical=vertical)
        end_within(ax, measure, vertical=vertical)
    return _places(x, y, shown)


def end_within(ax: Axes, measure: PlottedMeasure, *, vertical: bool) -> None:
    """End the axis of a measure where its estimates must, such as that of a share at 1; no mark or limit is left out.

    Args:
        ax: The axes, with all that is drawn.
        measure: The measure.
        vertical: True for its values along the horizontal axis.
    """
    data = ax.dataLim.intervalx if vertical else ax.dataLim.intervaly
    low, high = sorted(ax.get_xlim() if vertical else ax.get_ylim())
    drawn = [*data, *(limit.value for limit in measure.limits if low <= limit.value <= high)]
    if min(drawn) >= measure.within.low:
        low = max(low, measure.within.low)
    if max(drawn) <= measure.within.high:
        high = min(high, measure.within.high)
    (ax.set_xlim if vertical else ax.set_ylim)(low, high)


def draw_limit(ax: Axes, limit: Limit, *, vertical: bool, words: bool = True) -> None:
    """Draw a limit if it is near the data.

    Args:
        ax: The axes, with its data.
        limit: The limit.
        vertical: True for a vertical line.
        words: True to label it.
    """
    low, high = sorted(ax.get_xlim() if vertical else ax.get_ylim())
    reach = _NEAR * (high - low)
    if not low - reach <= limit.value <= high + reach:
        return
    line = ax.axvline if vertical else ax.axhline
    line(limit.value, color=LIMIT, linestyle="--", linewidth=1.1, zorder=1)
    edge = 0.04 * (high - low)
    (ax.set_xlim if vertical else ax.set_ylim)(min(low, limit.value - edge), max(high, limit.value + edge))
    if words:
        # A level label is at the end that is farther from upright ones.
        start, end = ax.get_xlim()
        upright = [text.xy[0] for text in ax.texts if isinstance(text, Annotation) and text.get_rotation() == 90.0]
        at_left = not vertical and any(abs(one - end) < abs(one - start) for one in upright)
        at = (limit.value, 0.99) if vertical else (0.01 if at_left else 0.99, limit.value)
        ax.annotate(
            str(limit),
            xy=at,
            xycoords=("data", "axes fraction") if vertical else ("axes fraction", "data"),
            xytext=(-3, 0) if vertical else (0, 3),
            textcoords="offset points",
            rotation=90 if vertical else 0,
            ha="left" if at_left else "right",
            va="top" if vertical else "bottom",
            fontsize=8,
            color=LIMIT,
            # The line of another limit passes beneath the label, not through it.
            bbox={"boxstyle": "square,pad=0.15", "facecolor": "white", "edgecolor": "none"},
            zorder=2.5,
        )


def label_places(ax: Axes, places: dict[Place, list[int]], designs: PlottedDesigns) -> None:
    """Label the important designs, and the number that coincide at a place, without overlaps.

    Args:
        ax: The axes, whose layout is fixed here.
        places: The variants at each place.
        designs: The designs.
    """
    figure = ax.figure
    figure.draw_without_rendering()  # type: ignore[union-attr]
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    pixel = figure.dpi / 72.0
    at = {place: ax.transData.transform(place) for place in places}
    taken = [Bbox.from_extents(px - 4, py - 4, px + 4, py + 4) for px, py in at.values()]
    taken += [text.get_window_extent(renderer) for text in ax.texts]
    frame = ax.get_window_extent(renderer)
    for place, variants in sorted(places.items(), key=lambda item: _importance(item[1], designs)):
        text = _label(variants, designs)
        if not text:
            continue
        own = Bbox.from_extents(*(at[place] - 4), *(at[place] + 4))
        for right, up in _OFFSETS:
            align = "left" if right > 0 else "right" if right < 0 else "center"
            note = ax.annotate(
                text, xy=place, xytext=(right, up), textcoords="offset points", ha=align, fontsize=8, color=INK
            )
            box = note.get_window_extent(renderer).padded(0.5 * pixel)
            inside = frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
            if inside and not any(box.overlaps(one) for one in taken if one.bounds != own.bounds):
                taken.append(box)
                note.set_zorder(20)
                note.set_in_layout(False)
                break
            note.remove()


def _places(x: PlottedMeasure, y: PlottedMeasure, shown: Sequence[int]) -> dict[Place, list[int]]:
    if not shown:
        return {}
    points = np.array([(x.value(variant), y.value(variant)) for variant in shown])
    span = np.ptp(points, axis=0)
    cell = np.where(span > 0.0, span / _CELLS, 1.0)
    keys = np.rint((points - points.min(axis=0)) / cell).astype(int)
    found: dict[tuple[int, ...], list[int]] = {}
    for number, key in enumerate(keys.tolist()):
        found.setdefault(tuple(key), []).append(number)
    places = {}
    for members in found.values():
        middle = points[members].mean(axis=0)
        places[(float(middle[0]), float(middle[1]))] = [shown[number] for number in members]
    return places


def _importance(variants: Sequence[int], designs: PlottedDesigns) -> tuple[int, int]:
    order = list(Role)
    return -max(order.index(designs.roles[variant]) for variant in variants), -len(variants)


def _label(variants: Sequence[int], designs: PlottedDesigns) -> str:
    named = any(designs.roles[variant] in _NAMED for variant in variants)
    if not named:
        return f"×{len(variants)}" if len(variants) > 1 else ""
    best = [variant for variant in variants if designs.roles[variant] in (Role.CHOSEN, Role.TIED)] or variants
    text = ids_text(best)
    if len(text) > _LONGEST_LABEL:
        chosen = [variant for variant in best if designs.roles[variant] is Role.CHOSEN]
        best = chosen or best[:1]
        text = ids_text(best)
    rest = len(variants) - len(best)
    return f"{text} and {rest} more" if rest else text


def finite_span(values: Iterable[float]) -> tuple[float, float]:
    """Least and greatest of the finite numbers; 0 and 1 if there are none."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else (0.0, 1.0)
