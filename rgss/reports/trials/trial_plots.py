"""The course of a trial as plots over time, its phases shaded and named."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rgss.documents import replaced_file
from rgss.evidence import PhaseOutcome, TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.reports.trials.lettering import headline, words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Okabe and Ito's colours, which most people with a colour deficiency can distinguish.
_SERIES_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
_LIMIT_COLOUR = "#b02418"
_BANDS = ("#eef2f6", "#ffffff")
_FAILED_BAND = "#f9dedb"
_INK = "#21252b"
_SIZE_IN, _DOTS_PER_INCH = (11.0, 9.0), 110


def write_trial_plots(path: Path, record: TrialRecord, trace: TrialTrace, *, joints: Sequence[str]) -> None:
    """Write the plots of a trial as a PNG.

    Args:
        path: The file.
        record: The trial.
        trace: Its course.
        joints: Names of the arm's joints.

    Raises:
        OSError: The file cannot be written.
    """
    figure = trial_figure(record, trace, joints=joints)
    with replaced_file(path) as part:
        figure.savefig(part, format="png", dpi=_DOTS_PER_INCH)


def trial_figure(record: TrialRecord, trace: TrialTrace, *, joints: Sequence[str]) -> Figure:
    """Joint positions, tool speed, finger forces and grip margin over simulated time.

    Args:
        record: The trial.
        trace: Its course.
        joints: Names of the arm's joints.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from rgss.reports.study_plots import StudyFigure

    figure = StudyFigure(figsize=_SIZE_IN, layout="constrained")
    figure.alt_text = f"{headline(record)}: joint positions, tool speed, finger forces and grip margin over time."
    FigureCanvasAgg(figure)
    figure.suptitle(headline(record), x=0.01, ha="left", fontsize=13, fontweight="bold", color=_INK)
    axes = figure.subplots(4, 1, sharex=True, height_ratios=(1.5, 1, 1, 1))
    _plot_joints(axes[0], trace, joints)
    _plot_speed(axes[1], trace)
    _plot_forces(axes[2], trace)
    _plot_margin(axes[3], trace)
    for ax in axes:
        _shade_phases(ax, record, trace)
        ax.grid(visible=True, axis="y", color="#d5dae0", linewidth=0.6)
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.margins(x=0)
        ax.legend(loc="upper left", bbox_to_anchor=(1.005, 1.02), frameon=False, fontsize=9)
    _name_phases(axes[0], trace)
    axes[-1].set_xlabel("simulated time without planning [s]")
    axes[-1].set_xlim(0.0, trace.spans[-1].end_s)
    figure.align_ylabels(axes)
    return figure


def _plot_joints(ax: Axes, trace: TrialTrace, joints: Sequence[str]) -> None:
    for index, name in enumerate(joints):
        label = words(name.removesuffix("_joint"))
        ax.plot(
            trace.time_s,
            np.degrees(trace.joint_positions_rad[:, index]),
            color=_SERIES_COLOURS[index % len(_SERIES_COLOURS)],
            linewidth=1.4,
            label=label,
        )
    ax.set_ylabel("joint position [°]")


def _plot_speed(ax: Axes, trace: TrialTrace) -> None:
    limit = trace.tool_speed_limit_m_s
    ax.plot(trace.time_s, trace.tool_speed_m_s, color=_SERIES_COLOURS[0], linewidth=1.4, label="tool speed")
    ax.axhline(limit, color=_LIMIT_COLOUR, linestyle="--", linewidth=1.2, label=f"limit {limit:.3g} m/s")
    ax.set_ylim(0.0, 1.15 * max(limit, float(trace.tool_speed_m_s.max())))
    ax.set_ylabel("tool speed [m/s]")


def _plot_forces(ax: Axes, trace: TrialTrace) -> None:
    fingers = trace.finger_forces_n.shape[1]
    for finger in range(fingers):
        ax.plot(
            trace.time_s,
            trace.finger_forces_n[:, finger],
            color=_SERIES_COLOURS[finger % len(_SERIES_COLOURS)],
            linewidth=1.2,
            label=f"finger {finger + 1}",
        )
    ax.plot(
        trace.time_s, trace.commanded_force_n, color=_LIMIT_COLOUR, linestyle="--", linewidth=1.2, label="commanded"
    )
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel("finger force [N]")


def _plot_margin(ax: Axes, trace: TrialTrace) -> None:
    ax.plot(trace.time_s, trace.grip_margin, color=_SERIES_COLOURS[2], linewidth=1.4, label="grip margin")
    ax.axhline(1.0, color=_LIMIT_COLOUR, linestyle="--", linewidth=1.2, label="slips below 1")
    known = trace.grip_margin[np.isfinite(trace.grip_margin)]
    ax.set_ylim(0.0, 1.15 * max(2.0, float(known.max(initial=0.0))))
    ax.set_ylabel("grip margin [1]")


def _shade_phases(ax: Axes, record: TrialRecord, trace: TrialTrace) -> None:
    outcomes = {phase.phase: phase.outcome for phase in record.phases}
    for number, span in enumerate(trace.spans):
        failed = outcomes[span.phase] is PhaseOutcome.FAILED
        colour = _FAILED_BAND if failed else _BANDS[number % len(_BANDS)]
        ax.axvspan(span.start_s, span.end_s, color=colour, linewidth=0, zorder=-1)


def _name_phases(ax: Axes, trace: TrialTrace) -> None:
    """Name the phases above the plots, slanted to leave room for short phases."""
    for number, span in enumerate(trace.spans, start=1):
        ax.annotate(
            f"{number} {words(span.phase)}",
            xy=((span.start_s + span.end_s) / 2, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(-3, 5),
            textcoords="offset points",
            rotation=24,
            ha="left",
            va="bottom",
            fontsize=9,
            color=_INK,
        )
