"""Time of a trial, state by state: planning and motion as bars, from the record of the trial."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.patches import Patch

from rgss.reports.study_plots.canvas import (
    FAINT,
    INK,
    LIMIT,
    SERIES,
    StudyFigure,
    dress,
    legend_below,
    new_figure,
    set_alt_text,
)
from rgss.reports.study_plots.plotted import PlottedDesigns

MOST_TRIALS = 30


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseBar:
    """One state of the task in a trial.

    Attributes:
        phase: Its name.
        planning_s: Time of its planning; 0 if nothing is planned.
        duration_s: Simulated time; 0 if it did not run.
    """

    phase: str
    planning_s: float
    duration_s: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialBars:
    """A trial as bars.

    Attributes:
        variant: Its variant.
        seed: Its seed.
        failure: Words for its failure; empty on success.
        phases: The states, in order.
    """

    variant: int
    seed: int
    failure: str
    phases: tuple[PhaseBar, ...]

    @property
    def total_s(self) -> float:
        """Time of the attempt, planning included."""
        return sum(one.planning_s + one.duration_s for one in self.phases)


def timeline_figure(trials: Sequence[TrialBars], designs: PlottedDesigns) -> StudyFigure:
    """A row for each trial, a bar for each of its states.

    Args:
        trials: The trials; of more than `MOST_TRIALS` the failed ones are drawn first, and the rest are counted.
        designs: The designs of the study.
    """
    drawn = list(trials)
    if len(trials) > MOST_TRIALS:
        drawn = sorted(trials, key=lambda one: (not one.failure, one.variant, one.seed))[:MOST_TRIALS]
    rest = len(trials) - len(drawn)
    variants = list(dict.fromkeys(one.variant for one in trials))
    note = f"failed trials first, {rest} more are not drawn" if rest else ""
    shown = f"variant {variants[0]}" if len(variants) == 1 else f"{len(variants)} variants"
    title = f"States of the task over time, {shown}"
    figure = new_figure(8.4, 2.2 + 0.30 * max(len(drawn), 2), title)
    ax = figure.subplots()
    names = list(dict.fromkeys(bar.phase for trial in drawn for bar in trial.phases))
    for row, trial in enumerate(drawn):
        start = 0.0
        for bar in trial.phases:
            number = names.index(bar.phase)
            colour = SERIES[number % len(SERIES)]
            if bar.planning_s > 0.0:
                ax.barh(
                    row, bar.planning_s, left=start, height=0.7, facecolor="white", edgecolor=colour, hatch="//////"
                )
            start += bar.planning_s
            ax.barh(row, bar.duration_s, left=start, height=0.7, color=colour, edgecolor="white", linewidth=0.5)
            if bar.duration_s > 0.045 * max(one.total_s for one in drawn):
                ax.text(
                    start + bar.duration_s / 2,
                    row,
                    str(number + 1),
                    ha="center",
                    va="center",
                    fontsize=8,
                    color="white" if number % len(SERIES) not in (4, 5) else INK,
                )
            start += bar.duration_s
        words = f" ✕ {trial.failure}" if trial.failure else f" {trial.total_s:.1f} s"
        ax.text(start, row, words, va="center", fontsize=8, color=LIMIT if trial.failure else FAINT)
    many = len(variants) > 1
    ax.set_yticks(
        range(len(drawn)), [f"{one.variant}, seed {one.seed}" if many else f"seed {one.seed}" for one in drawn]
    )
    ax.invert_yaxis()
    ax.set_xlabel("time of the trial [s], planning included\n← lower is better", fontsize=9.5, color=INK)
    ax.set_ylabel("variant and seed" if many else "trial", fontsize=9.5, color=INK)
    ax.margins(x=0.16, y=0.02)
    ax.set_xlim(left=0.0)
    dress([ax], grid="x")
    handles = [
        Patch(color=SERIES[at % len(SERIES)], label=f"{at + 1} {name.replace('_', ' ')}")
        for at, name in enumerate(names)
    ]
    handles.append(Patch(facecolor="white", edgecolor=FAINT, hatch="//////", label="planning of the move that follows"))
    legend_below(figure, handles, designs, note, columns=3)
    failed = sum(1 for one in trials if one.failure)
    set_alt_text(
        figure,
        f"Time of {len(trials)} trials of {shown} by state of the task, {failed} of them failed",
        "; ".join(f"seed {one.seed}: {one.failure or f'{one.total_s:.1f} s'}" for one in drawn[:6]),
        note,
    )
    return figure
