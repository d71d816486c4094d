"""Matrix of scatter plots of the nondominated designs, for each pair of some measures."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.reports.decision import ids_text
from rgss.reports.study_plots.canvas import (
    INK,
    StudyFigure,
    dress,
    legend_below,
    new_figure,
    role_handles,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import PlottedDesigns, PlottedMeasure, Role
from rgss.reports.study_plots.scatter import label_places, scatter_designs

_PANEL_IN = 2.5


def front_figure(measures: Sequence[PlottedMeasure], designs: PlottedDesigns, front: Sequence[int]) -> StudyFigure:
    """A scatter plot for each pair of measures.

    Args:
        measures: Two or more measures.
        designs: The designs; nondominated ones have the role of the front, or a better one.
        front: The nondominated designs.
    """
    size = len(measures) - 1
    across = max(6.4, _PANEL_IN * size + 1.2)
    title = f"Nondominated in {len(measures)} measures: {ids_text(front) or 'none'}"
    figure = new_figure(across, max(4.8, _PANEL_IN * size + 1.5), title)
    axes = figure.subplots(size, size, squeeze=False, sharex="col", sharey="row")
    drawn = []
    for row in range(size):
        for column in range(size):
            ax = axes[row][column]
            if column > row:
                ax.set_visible(False)
                continue
            x, y = measures[column], measures[row + 1]
            drawn.append((ax, scatter_designs(ax, x, y, designs)))
            if row == size - 1:
                ax.set_xlabel(f"{x.id} [{x.unit}]\n{x.better_end}", fontsize=9, color=INK)
            if column == 0:
                ax.set_ylabel(f"{y.id} [{y.unit}]\n{y.better_end}", fontsize=9, color=INK)
    dress(ax for ax, _ in drawn)
    words = ", ".join(one.id for one in measures)
    legend_below(figure, role_handles(designs, front="nondominated in these"), designs, columns=3)
    if size == 1:
        label_places(drawn[0][0], drawn[0][1], designs)
    set_alt_text(
        figure,
        f"Scatter plots of each pair of {words}",
        f"nondominated in all of them: {ids_text(front) or 'none'}",
        designs.summary(),
    )
    return figure


def with_front(designs: PlottedDesigns, front: Sequence[int]) -> PlottedDesigns:
    """The designs with the front of other measures than the weighted ones."""
    best = set(front)
    roles = {}
    for variant, role in designs.roles.items():
        if role in (Role.FEASIBLE, Role.FRONT):
            roles[variant] = Role.FRONT if variant in best else Role.FEASIBLE
        else:
            roles[variant] = role
    return PlottedDesigns(study=designs.study, roles=roles, note=designs.note)
