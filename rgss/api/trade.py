"""Trade-off of the Python interface: the decision and its analyses, with or without suppositions."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from rgss.api.argument_terms import ErrorsNameArguments
from rgss.api.plots import Plots, require_matplotlib
from rgss.api.sensitivity_frames import exchange_rates_frame, stakeholders_frame, tornado_frame, worth_keeping_frame
from rgss.api.trade_frames import (
    acceptability_frame,
    changes_frame,
    computed_effects,
    effects_frame,
    pareto_frame,
    ranking_frame,
    weights_frame,
)
from rgss.assessment import VariantMeasures
from rgss.counted import counted
from rgss.decision import choose, trade_problem
from rgss.decision.robustness import Robustness, analyse_robustness
from rgss.decision.sensitivity import Sensitivity, analyse_sensitivity
from rgss.decision.what_if import Scenario
from rgss.reports.decision import decision_to_json
from rgss.studies import Project
from rgss.tradeoff import Decision, decision_view
from rgss.tradeoff.programs import Enumeration, enumerate_alternatives

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, kw_only=True, eq=False)
class Trade:
    """The choice among a study's variants; each analysis is computed once, at its first use.

    The constructor and every method raise `EvidenceError` if trials have no evidence, and `TradeoffError`
    if the choice is ill posed.

    Attributes:
        project: The project, under suppositions if there are any.
        measured: Every variant among which the decision chooses.
        scenario: The suppositions; None if there are none.
    """

    project: Project = field(repr=False)
    measured: tuple[VariantMeasures, ...] = field(repr=False)
    scenario: Scenario | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        supposed = "" if self.scenario is None else ", under suppositions"
        return f"Trade({self.project.study.id!r}, {counted(len(self.measured), 'variant')}{supposed})"

    def _repr_html_(self) -> str:
        return decision_view(self.decision, title=repr(self))

    @property
    def plot(self) -> Plots:
        """Figures of the trade-off.

        Raises:
            DefinitionError: Matplotlib is not installed.
        """
        require_matplotlib()
        return Plots(
            project=self.project,
            measured=self.measured,
            decision=lambda: self.decision,
            robustness=self.robustness,
            sensitivity=self.sensitivity,
        )

    @cached_property
    @ErrorsNameArguments()
    def decision(self) -> Decision:
        """Decision: choice, runner-up, ties, ranking, infeasible variants with reasons, certificate."""
        return choose(self.project, self.measured)

    @cached_property
    @ErrorsNameArguments()
    def enumeration(self) -> Enumeration:
        """Every variant with its value and its violations."""
        return enumerate_alternatives(trade_problem(self.project, self.measured))

    @property
    def ranking(self) -> pd.DataFrame:
        """The feasible variants, best first."""
        return ranking_frame(self.decision)

    @property
    @ErrorsNameArguments()
    def pareto(self) -> pd.DataFrame:
        """The feasible variants with their dominance over the weighted measures."""
        return pareto_frame(trade_problem(self.project, self.measured), self.enumeration)

    @property
    def changes(self) -> pd.DataFrame:
        """The suppositions; no row if there are none."""
        return changes_frame(self.scenario)

    def robustness(self) -> Robustness:
        """Robustness of the decision; takes some seconds the first time."""
        return self._robustness

    def sensitivity(self) -> Sensitivity:
        """Sensitivity of the decision to its inputs; takes some seconds the first time."""
        return self._sensitivity

    def effects(self) -> pd.DataFrame:
        """Effects of the levels of each factor, and of each pair of factors, on the measures."""
        return effects_frame(computed_effects(self._robustness))

    def weights(self) -> pd.DataFrame:
        """Range of each weight alone within which the choice stays the same."""
        return weights_frame(self._robustness)

    def tornado(self) -> pd.DataFrame:
        """Effects of the uncertain inputs on the lead of the choice, the largest swing first."""
        return tornado_frame(self.sensitivity())

    def exchange_rates(self) -> pd.DataFrame:
        """Worth of a better quantity of each measure to the choice, in units of one measure."""
        return exchange_rates_frame(self.sensitivity())

    def worth_keeping(self) -> pd.DataFrame:
        """The feasible variants, each with the reason to keep it or the variants that beat it."""
        return worth_keeping_frame(self.sensitivity())

    def stakeholders(self) -> pd.DataFrame:
        """Value of each feasible variant to each stakeholder."""
        return stakeholders_frame(self.sensitivity())

    def acceptability(self) -> pd.DataFrame:
        """Acceptability indices (SMAA-2): share of weights and replicate noise for which each variant is the best."""
        return acceptability_frame(self._robustness)

    def to_dict(self) -> dict[str, Any]:
        """The decision as plain values for JSON."""
        return decision_to_json(self.decision)

    @cached_property
    @ErrorsNameArguments()
    def _sensitivity(self) -> Sensitivity:
        problem = trade_problem(self.project, self.measured)
        return analyse_sensitivity(
            self.project,
            self.measured,
            self.decision,
            self._robustness,
            problem=problem,
            is_supposed=self.scenario is not None,
        )

    @cached_property
    @ErrorsNameArguments()
    def _robustness(self) -> Robustness:
        return analyse_robustness(self.project, self.measured, self.decision)
