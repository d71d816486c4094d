"""Figures of a study: `Study.plot` and `Trade.plot`."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from rgss.api.argument_terms import text_argument, texts_argument, whole_argument
from rgss.api.plot_data import deciding_measures, measure_named, plotted_designs, plotted_measure
from rgss.api.sensitivity_frames import computed_tornado
from rgss.api.trade_frames import weights_frame
from rgss.assessment import VariantMeasures
from rgss.decision.robustness import Robustness
from rgss.decision.sensitivity import Sensitivity, TornadoBar
from rgss.errors import DefinitionError, TradeoffError
from rgss.evidence import TrialRecord
from rgss.figures import rounded_figure
from rgss.measures import Direction
from rgss.studies import Project
from rgss.tradeoff import Decision

if TYPE_CHECKING:
    from rgss.measures import Measure
    from rgss.reports.study_plots import InputBar, PlottedDesigns, PlottedMeasure, StudyFigure, TrialBars

INSTALL = "pip install 'rgss[notebooks]'"

MOST_INPUTS = 14
"""Number of bars in a tornado."""


def require_matplotlib() -> None:
    """Make sure that figures can be drawn.

    Raises:
        DefinitionError: Matplotlib is not installed.
    """
    if importlib.util.find_spec("matplotlib") is None:
        raise DefinitionError("plot needs Matplotlib, which is not installed", hint=INSTALL)


@dataclass(frozen=True, kw_only=True, eq=False)
class Plots:
    """Matplotlib figures of a trade-off, each with a text for readers who do not see it.

    A figure needs neither a display nor pyplot; ``figure.savefig("front.svg")`` writes it, and Jupyter shows it. Marks
    and lines have a shape and a colour for each role: chosen, tied with it (equal, or within the practical margin),
    runner-up, feasible, infeasible.

    Attributes:
        project: The project, under suppositions if there are any.
        measured: Every variant among which the decision chooses.
        decision: Function that makes the decision.
        robustness: Function that analyses its robustness.
        sensitivity: Function that analyses its sensitivity.
    """

    project: Project = field(repr=False)
    measured: tuple[VariantMeasures, ...] = field(repr=False)
    decision: Callable[[], Decision] = field(repr=False)
    robustness: Callable[[], Robustness] = field(repr=False)
    sensitivity: Callable[[], Sensitivity] = field(repr=False)

    def __repr__(self) -> str:
        return f"Plots({self.project.study.id!r}: pareto, front, parallel, measure, timeline, tornado, weights)"

    def pareto(self, x: str | None = None, y: str | None = None) -> StudyFigure:
        """Designs over two measures with their intervals, the limits of both and the front of both.

        Args:
            x: Measure along the horizontal axis; by default one of the two with the greatest weights.
            y: Measure along the vertical axis; by default the other one.

        Raises:
            DefinitionError: There is no such measure, or both are the same.
            EvidenceError: There is no evidence.
        """
        from rgss.reports.study_plots import pareto_figure

        for argument, name in (("x", x), ("y", y)):
            if name is not None:
                text_argument(argument, name, hint="give the id of a measure")
        if x is not None and x == y:
            raise DefinitionError(f"x, y: both are {x}", hint="name two measures")
        heaviest = [name for name in self._weights if name not in (x, y)]
        if (x is None) + (y is None) > len(heaviest):
            raise DefinitionError("x, y: the trade-off weighs fewer than two measures", hint="name both")
        across = self._measure(heaviest.pop(0) if x is None else x, "x")
        up = self._measure(heaviest.pop(0) if y is None else y, "y")
        designs = self._designs_on_front((across, up))
        return pareto_figure(across, up, designs, front=f"nondominated in {across.id} and {up.id}")

    def front(self, measures: Sequence[str]) -> StudyFigure:
        """A scatter plot for each pair of measures, with the feasible designs that none dominates in all of them.

        Args:
            measures: Ids of two or more measures.

        Raises:
            DefinitionError: There is no such measure, or fewer than two.
            EvidenceError: There is no evidence.
        """
        from rgss.reports.study_plots import front_figure, nondominated_of

        hint = "such as front(['C_total', 'P_max'])"
        names = dict.fromkeys(
            [measures] if isinstance(measures, str) else texts_argument("measures", measures, hint=hint)
        )
        if len(names) < 2:
            raise DefinitionError(f"measures: name two or more, got {', '.join(map(repr, names)) or 'none'}", hint=hint)
        axes = [self._measure(name, "measures") for name in names]
        designs = self._designs_on_front(axes)
        return front_figure(axes, designs, nondominated_of(axes, designs.feasible))

    def parallel(self, measures: Sequence[str] = ()) -> StudyFigure:
        """A line for each design through all measures, the better end of each above.

        Args:
            measures: Ids of the measures; by default those with a weight or a limit.

        Raises:
            DefinitionError: There is no such measure, or none differs between the designs.
            EvidenceError: There is no evidence.
        """
        from rgss.reports.study_plots import parallel_figure

        names = texts_argument("measures", measures, hint="such as parallel(['C_total', 'P_max'])")
        named = [self._measure(name, "measures") for name in dict.fromkeys(names)]
        designs = self._designs()
        shown = named or [self._plotted(one) for one in deciding_measures(self.project, among=self._weights)]
        varied = [one for one in shown if len({one.value(variant) for variant in one.known(designs.roles)}) > 1]
        if not varied:
            raise DefinitionError("measures: all designs have the same values", hint="name measures that differ")
        flat = [one.id for one in shown if one not in varied]
        return parallel_figure(varied, designs, flat)

    def measure(self, measure: str, *, by: str | None = None) -> StudyFigure:
        """Intervals of a measure, the best design first, beside the distribution of its values.

        Args:
            measure: Its id.
            by: Factor of the design space whose levels divide the distribution; all designs together by default.

        Raises:
            DefinitionError: There is no such measure or factor.
            EvidenceError: There is no evidence.
        """
        from rgss.reports.study_plots import spread_figure

        shown = self._measure(measure, "measure")
        levels = {one.variant.id: one.variant.levels for one in self.measured}
        factors = list(dict.fromkeys(factor for own in levels.values() for factor in own))
        if by is not None and text_argument("by", by, hint=f"factors: {', '.join(factors)}") not in factors:
            raise DefinitionError(f"by: {by!r} is not a factor", hint=f"factors: {', '.join(factors)}")
        groups: dict[str, list[int]] = {}
        for variant, own in sorted(levels.items()):
            groups.setdefault("all" if by is None else own.get(by, "none"), []).append(variant)
        return spread_figure(shown, self._designs(), groups, "designs" if by is None else f"by {by}, with counts")

    def timeline(self, variant: int | None = None) -> StudyFigure:
        """States of the task over time in each stored trial of a design: planning and motion, and what failed.

        Args:
            variant: Its id; the chosen design by default.

        Raises:
            DefinitionError: There is no such design, or none is chosen.
            EvidenceError: There is no evidence.
        """
        from rgss.reports.study_plots import timeline_figure

        decision = self._decision
        if variant is not None:
            variant = whole_argument("variant", variant, hint="name a variant of the study")
        chosen = decision.chosen if variant is None and decision is not None else variant
        found = [one for one in self.measured if one.variant.id == chosen]
        if not found:
            why = "no design is chosen" if chosen is None else f"unknown variant {chosen}"
            raise DefinitionError(f"variant: {why}", hint="name a variant of the study")
        return timeline_figure([_bars(record) for record in found[0].records], self._designs())

    def tornado(self) -> StudyFigure:
        """Lead of the chosen design over its best rival over the range of each uncertain input.

        Raises:
            TradeoffError: It could not be computed.
            EvidenceError: Trials have no evidence.
        """
        from rgss.reports.decision import no_rival_clause
        from rgss.reports.study_plots import tornado_figure

        found = computed_tornado(self.sensitivity())
        if found.lead is None:
            raise TradeoffError(
                f"tornado: {no_rival_clause(found)}", hint="it needs two feasible designs of different value"
            )
        shown = [_input_bar(bar) for bar in found.moving[:MOST_INPUTS]]
        return tornado_figure(shown, found.lead, self._designs(), len(found.moving) - len(shown))

    def weights(self) -> StudyFigure:
        """Range of each weight alone within which the chosen design stays the best.

        Raises:
            TradeoffError: It could not be computed.
            EvidenceError: Trials have no evidence.
        """
        from rgss.reports.study_plots import WeightRange, weights_figure

        rows = weights_frame(self.robustness()).reset_index().to_dict("records")
        names = ("measure", "weight", "low", "high", "below", "above")
        return weights_figure([WeightRange(**{name: row[name] for name in names}) for row in rows], self._designs())

    @cached_property
    def _decision(self) -> Decision | None:
        """The decision; None while trials are missing."""
        return None if any(one.missing for one in self.measured) else self.decision()

    def _designs(self) -> PlottedDesigns:
        return plotted_designs(self.project, self.measured, self._decision)

    def _designs_on_front(self, measures: Sequence[PlottedMeasure]) -> PlottedDesigns:
        from rgss.reports.study_plots import nondominated_of, with_front

        designs = self._designs()
        if any(one.better is Direction.NONE for one in measures):
            return designs
        return with_front(designs, nondominated_of(measures, designs.feasible))

    def _plotted(self, measure: Measure) -> PlottedMeasure:
        return plotted_measure(self.project, self.measured, measure)

    def _measure(self, name: str, argument: str) -> PlottedMeasure:
        return self._plotted(measure_named(self.project, name, argument=argument))

    @property
    def _weights(self) -> list[str]:
        """The weighted measures, the heaviest first."""
        weights = self.project.study.trade_off.weighting.weights
        return sorted(weights, key=lambda name: -weights[name])


def _bars(record: TrialRecord) -> TrialBars:
    from rgss.reports.study_plots import PhaseBar, TrialBars

    planning_s = {one.subtask: one.time_s or 0.0 for one in record.planning}
    phases = [
        PhaseBar(phase=one.phase, planning_s=planning_s.get(one.phase, 0.0), duration_s=one.duration_s or 0.0)
        for one in record.phases
    ]
    failure = "" if record.failure is None else record.failure.value.replace("_", " ")
    return TrialBars(variant=record.variant, seed=record.seed, failure=failure, phases=tuple(phases))


def _input_bar(bar: TornadoBar) -> InputBar:
    from rgss.reports.study_plots import InputBar

    return InputBar(
        id=bar.id,
        low=_quantity(bar.low.value, bar.unit),
        high=_quantity(bar.high.value, bar.unit),
        lead_low=math.nan if bar.low.lead is None else bar.low.lead,
        lead_high=math.nan if bar.high.lead is None else bar.high.lead,
    )


def _quantity(value: float, unit: str) -> str:
    number = rounded_figure(value)
    return number if unit in ("", "1") else f"{number} {unit}"
