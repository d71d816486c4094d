"""Figures of a study: size, typeface, colours, marks, title, alternative text."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from rgss.reports.study_plots.plotted import PlottedDesigns, Role

INK, FAINT, GRID = "#21252b", "#6b727c", "#d5dae0"
LIMIT = "#b02418"
# Okabe and Ito's colours, which most people with a colour deficiency can distinguish; each role has a shape too.
SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#21252b", "#8c6d1f")
MARKS: dict[Role, dict[str, Any]] = {
    Role.UNJUDGED: {"marker": "o", "s": 30, "facecolor": "#9db8cc", "edgecolor": INK, "linewidth": 0.6},
    Role.INFEASIBLE: {"marker": "x", "s": 26, "color": "#8a919a", "linewidth": 1.2},
    Role.FEASIBLE: {"marker": "o", "s": 30, "facecolor": "white", "edgecolor": "#4f6f86", "linewidth": 1.1},
    Role.FRONT: {"marker": "o", "s": 40, "facecolor": "#0072b2", "edgecolor": "white", "linewidth": 0.6},
    Role.RUNNER_UP: {"marker": "s", "s": 48, "facecolor": "#009e73", "edgecolor": INK, "linewidth": 0.8},
    Role.TIED: {"marker": "D", "s": 120, "facecolor": "none", "edgecolor": "#d55e00", "linewidth": 1.8},
    Role.CHOSEN: {"marker": "*", "s": 170, "facecolor": "#e69f00", "edgecolor": INK, "linewidth": 0.9},
}
LINES: dict[Role, dict[str, Any]] = {
    Role.UNJUDGED: {"color": "#7d9db5", "linewidth": 0.9},
    Role.INFEASIBLE: {"color": "#b3b9c0", "linewidth": 0.8, "linestyle": (0, (2, 2))},
    Role.FEASIBLE: {"color": "#7d9db5", "linewidth": 0.9},
    Role.FRONT: {"color": "#0072b2", "linewidth": 1.2},
    Role.RUNNER_UP: {"color": "#009e73", "linewidth": 2.2, "linestyle": (0, (6, 2))},
    Role.TIED: {"color": "#d55e00", "linewidth": 1.8},
    Role.CHOSEN: {"color": INK, "linewidth": 2.8},
}
DOTS_PER_INCH = 100


class StudyFigure(Figure):
    """A Matplotlib figure with a text for readers who do not see it.

    Attributes:
        alt_text: The text; notebooks keep it as the picture's alternative text.
    """

    alt_text: str = ""

    def __repr__(self) -> str:
        return self.alt_text or super().__repr__()

    def _repr_mimebundle_(self, **_kinds: Any) -> tuple[dict[str, str], dict[str, dict[str, str]]]:
        """PNG with its alternative text, for Jupyter."""
        picture = io.BytesIO()
        self.savefig(picture, format="png", metadata={"Software": None, "Description": self.alt_text})
        data = {"image/png": base64.b64encode(picture.getvalue()).decode("ascii"), "text/plain": repr(self)}
        return data, {"image/png": {"alt": self.alt_text}}


def new_figure(width_in: float, height_in: float, title: str) -> StudyFigure:
    """An empty figure with a title, which needs neither a display nor pyplot.

    Args:
        width_in: Width in inches.
        height_in: Height in inches.
        title: Its title.
    """
    figure = StudyFigure(figsize=(width_in, height_in), dpi=DOTS_PER_INCH, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    figure.suptitle(title, x=0.01, ha="left", fontsize=12, fontweight="bold", color=INK)
    return figure


def set_alt_text(figure: StudyFigure, *sentences: str) -> None:
    """Set the alternative text of a figure from sentences; empty ones are omitted."""
    figure.alt_text = ". ".join(one.rstrip(".") for one in sentences if one) + "."


def dress(axes: Iterable[Axes], *, grid: str = "both") -> None:
    """Give axes a light grid beneath the data, and no box.

    Args:
        axes: The axes.
        grid: ``x``, ``y`` or ``both``.
    """
    for ax in axes:
        ax.grid(visible=True, axis=grid, color=GRID, linewidth=0.6)  # type: ignore[arg-type]
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(labelsize=9, colors=INK)


def role_handles(designs: PlottedDesigns, *, lines: bool = False, front: str = "") -> list[Line2D]:
    """Legend entries for the roles of designs, the chosen one first.

    Args:
        designs: The designs.
        lines: True if designs are drawn as lines.
        front: Label of the nondominated ones, with the measures.
    """
    handles = []
    for role in reversed(Role):
        those = designs.with_role(role)
        if not those:
            continue
        label = front if role is Role.FRONT and front else role.value
        label += f" {those[0]}" if role in (Role.CHOSEN, Role.RUNNER_UP) else f" ({len(those)})"
        if lines:
            handles.append(Line2D([], [], label=label, **LINES[role]))
            continue
        mark = MARKS[role]
        handles.append(
            Line2D(
                [],
                [],
                linestyle="none",
                label=label,
                marker=mark["marker"],
                markersize=float(mark["s"]) ** 0.5,
                markerfacecolor=mark.get("facecolor", mark.get("color")),
                markeredgecolor=mark.get("edgecolor", mark.get("color")),
                markeredgewidth=mark["linewidth"],
            )
        )
    return handles


def legend_below(
    figure: Figure, handles: Sequence[Any], designs: PlottedDesigns, *notes: str, columns: int = 4
) -> None:
    """Put a legend outside of the axes, where it covers no data, with the study's name and notes.

    Args:
        figure: The figure.
        handles: Entries of the legend.
        designs: The designs that it shows.
        notes: Further notes; empty ones are omitted.
        columns: Number of entries side by side.
    """
    legend = figure.legend(
        handles=handles,
        loc="outside lower left",
        ncols=max(1, min(columns, len(handles))),
        frameon=False,
        fontsize=9,
        title="; ".join(part for part in (designs.study, *notes, designs.note) if part),
        title_fontsize=8,
        alignment="left",
    )
    legend.get_title().set_color(FAINT)
