"""Study of the Python interface, the result of `rgss.load_study`."""

# long file: one class with a short method for each frame and action; half of its lines are their docstrings.

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.api.argument_terms import ErrorsNameArguments, text_argument, whole_argument
from rgss.api.assumptions import assumptions_frame, scenario_measures
from rgss.api.column import Column, Kind
from rgss.api.columns import FRAMES
from rgss.api.frames import (
    described_frame,
    frame_of,
    measures_frame,
    phases_frame,
    requirements_frame,
    trials_frame,
    variant_columns,
    verdicts_frame,
)
from rgss.api.html_views import study_view
from rgss.api.missing_trials import sweep_hint, with_trials
from rgss.api.plots import Plots
from rgss.api.portfolios import portfolio_of_study
from rgss.api.suppositions import WhatIf, suppositions_of
from rgss.api.sweep import sweep_study, variant_terms
from rgss.api.trade import Trade
from rgss.api.trial import Drawing, Trial, payload_of, run_one
from rgss.assessment import VariantMeasures, read_record
from rgss.counted import counted
from rgss.decision import ScreeningResult, measure_survivors
from rgss.decision.robustness import Robustness
from rgss.decision.what_if import suppose
from rgss.designs import DesignVariant, picked
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence import EvidenceStore
from rgss.studies import Project, load_project
from rgss.tradeoff import Decision
from rgss.trials.payload_bench import PayloadResult

if TYPE_CHECKING:
    import pandas as pd


def unpickled(folder: Path, label: str, asked: tuple[str, int, bool], drawing: Drawing) -> Study:
    """A study that was pickled, from its files as they are now.

    Args:
        folder: The project's folder.
        label: The study file.
        asked: Its fidelity, its replicates, and whether it adds replicates until it is decided.
        drawing: Functions that draw a trial.
    """
    fidelity, replicates, is_sequential = asked
    project = load_project(folder, label)
    if (project.study.replicates, project.study.is_sequential) != (replicates, is_sequential):
        project = project.with_replicates(replicates)
    if project.study.fidelity.value != fidelity:
        project = project.with_fidelity(fidelity)
    return Study(project=project, _drawing=drawing)


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """A study and its evidence as pandas frames; docs/api.md describes their columns.

    Evidence is read at the first access and then cached, so that all frames agree; `sweep`
    returns a study with the new evidence. Each access makes a new frame, which can be changed
    without an effect on others.

    Attributes:
        project: Inputs of the study: requirements, measures, designs, scene.
    """

    project: Project = field(repr=False)
    _drawing: Drawing = field(repr=False)

    def __repr__(self) -> str:
        study = self.project.study
        return (
            f"Study({study.id!r}, {counted(len(self._designs), 'variant')} × {counted(study.replicates, 'seed')}, "
            f"{study.fidelity.value} fidelity)"
        )

    def __reduce__(self) -> tuple[Callable[..., Study], tuple[object, ...]]:
        """Pickle the folder and the arguments of `rgss.load_study`; unpickling reads files and evidence."""
        study = self.project.study
        asked = (study.fidelity.value, study.replicates, study.is_sequential)
        return unpickled, (self.project.folder.resolve(), study.label, asked, self._drawing)

    def __copy__(self) -> Study:
        return replace(self)

    def _repr_html_(self) -> str:
        return study_view(repr(self), self.project, len(self._designs))

    @property
    def plot(self) -> Plots:
        """Figures of the study; as of `trade`.

        Raises:
            DefinitionError: Matplotlib is not installed.
        """
        return self._trade.plot

    @property
    def variants(self) -> pd.DataFrame:
        """The designs, with their feasibility and value in the trade-off as far as there is evidence."""
        rows = []
        measured = {entry.variant.id: entry for entry in self._known}
        outcomes = {} if self._screened is None else {one.variant: one.outcome.value for one in self._screened.variants}
        judged = bool(measured) and not any(entry.missing for entry in measured.values())
        enumeration = self.trade().enumeration if judged else None
        # A screened-out design has no missing trials.
        untried = 0 if measured else self.project.study.replicates
        for variant in self._designs:
            entry = measured.get(variant.id)
            row = {
                "variant": variant.id,
                **variant.columns(),
                **{f"level_{factor}": level for factor, level in variant.levels.items()},
                "trials": 0 if entry is None else len(entry.records),
                "missing": untried if entry is None else entry.missing,
                "screening": outcomes.get(variant.id),
            }
            if enumeration is not None and entry is not None:
                violated = enumeration.violated_by(variant.id)
                row |= {
                    "feasible": not violated,
                    "violates": ", ".join(violated),
                    "weighted_value": enumeration.value_of(variant.id),
                }
            rows.append(row)
        return described_frame("variants", rows, variant_columns(self.project))

    @property
    def requirements(self) -> pd.DataFrame:
        """The system requirements with their criteria; no evidence is read."""
        return requirements_frame(self.project)

    @property
    def trials(self) -> pd.DataFrame:
        """One row for each variant and seed.

        Raises:
            EvidenceError: There is no evidence for the present project.
        """
        return trials_frame(self._tried)

    @property
    def phases(self) -> pd.DataFrame:
        """One row for each variant, seed and state of the task.

        Raises:
            EvidenceError: There is no evidence for the present project.
        """
        return phases_frame(record for entry in self._tried for record in entry.records)

    @property
    def measures(self) -> pd.DataFrame:
        """One row for each variant and measure: the estimate with its interval.

        Raises:
            EvidenceError: There is no evidence store.
        """
        return measures_frame(self.project, self._measured)

    @property
    def verdicts(self) -> pd.DataFrame:
        """One row for each variant and requirement with a criterion.

        Raises:
            EvidenceError: There is no evidence store.
        """
        return verdicts_frame(self.project, self._measured)

    @property
    def decision(self) -> Decision:
        """Decision as a frame; as of `trade`."""
        return self._trade.decision

    @property
    def ranking(self) -> pd.DataFrame:
        """The feasible variants, best first; as of `trade`."""
        return self._trade.ranking

    @property
    def pareto(self) -> pd.DataFrame:
        """The feasible variants and the Pareto front; as of `trade`."""
        return self._trade.pareto

    @ErrorsNameArguments()
    def trade(self, what_if: WhatIf = (), *, run: bool = False, jobs: int | None = None) -> Trade:
        """The trade-off, of the study as it is or under suppositions.

        Args:
            what_if: The suppositions, such as ``{"weight.t_p": 0.4, "SYS-012.threshold": "0.9 kg"}`` or
                ``{"planning.charge_per_check": "0.5 ms"}``.
            run: True to run missing trials that the suppositions need; they are stored as evidence.
            jobs: Number of worker processes for them, as for `sweep`.

        Raises:
            EvidenceError: Trials have no evidence, or the suppositions need trials that were not run.
            SimulationError: Trials could not be run.
            DefinitionError: A supposition has an unknown name or an impossible value.
            TradeoffError: Weights contradict each other.
        """
        texts = suppositions_of(what_if)
        if jobs is not None:
            jobs = whole_argument("jobs", jobs, hint="omit it for one process for each core")
        if not texts:
            return self._trade
        scenario = suppose(self.project, texts)
        measured = scenario_measures(self.project, scenario, self._measured, run=run, jobs=jobs)
        return Trade(project=scenario.project, measured=measured, scenario=scenario)

    @ErrorsNameArguments()
    def assumptions(self) -> pd.DataFrame:
        """The choice under each alternative of each modelling assumption, as far as the evidence shows.

        Raises:
            EvidenceError: Trials of the study have no evidence.
            TradeoffError: The choice is ill posed.
        """
        return assumptions_frame(self.project, self._measured)

    def robustness(self) -> Robustness:
        """Robustness of the decision; as of `trade`."""
        return self._trade.robustness()

    def effects(self) -> pd.DataFrame:
        """Effects of the factors' levels on the measures; as of `trade`."""
        return self._trade.effects()

    def tornado(self) -> pd.DataFrame:
        """Effects of the uncertain inputs on the lead of the choice; as of `trade`."""
        return self._trade.tornado()

    @ErrorsNameArguments()
    def portfolio(self) -> pd.DataFrame:
        """The designs that together serve the studies of the portfolio best, each by the evidence of its study.

        Raises:
            DefinitionError: The study has no portfolio.
            EvidenceError, TradeoffError: Trials have no evidence, or the choice is ill posed.
        """
        return portfolio_of_study(self.project)

    def columns(self, frame: str) -> pd.DataFrame:
        """Meanings of the columns of a frame, with their units.

        Args:
            frame: Its name, such as ``trials``.

        Raises:
            DefinitionError: There is no frame of that name.
        """
        hint = f"frames: {', '.join(FRAMES)}"
        if text_argument("frame", frame, hint=hint) not in FRAMES:
            raise DefinitionError(f"unknown frame {frame!r}", hint=hint)
        described = FRAMES[frame]
        columns = variant_columns(self.project) if frame == "variants" else described.columns
        rows = [{"column": one.title, "unit": one.unit, "meaning": one.meaning} for one in (*described.index, *columns)]
        name, *others = (Column(name=name, meaning="", kind=Kind.TEXT) for name in ("column", "unit", "meaning"))
        return frame_of([name], others, rows)

    @ErrorsNameArguments()
    def sweep(
        self,
        only: Sequence[str | int] | str | int = (),
        *,
        jobs: int | None = None,
        on_trial: Callable[[int, int], None] | None = None,
    ) -> Study:
        """Run every trial that has no evidence yet; pieces that trials share are made once.

        These are the study's `replicates` of each variant, as of ``rgss sweep --replicates``. Where the study states a
        budget, plain ``rgss sweep`` adds replicates until it is decided; this does not.

        Args:
            only: The variants, as for ``--only``: ids such as ``"1,5,60-72"``, filters such as
                ``"planning.planner=RRT"`` or ``"robot.tool_speed <= 0.8 m/s"``; all of several must hold. All
                variants by default.
            jobs: Number of worker processes, one for each core by default; 0 for one child process. A script
                that uses others needs ``if __name__ == "__main__":``, for they import it.
            on_trial: Called after each trial with the number of stored trials and the number of all.

        Returns:
            The study with the new evidence.

        Raises:
            DefinitionError: `only` or `jobs` is invalid.
            EvidenceError: The store cannot be read or written.
            SimulationError: Trials could not be run; the others are stored.
        """
        sweep_study(
            self.project,
            picked(self.project.designs, variant_terms(only), option="only"),
            jobs=jobs,
            on_trial=on_trial,
        )
        return replace(self)

    @ErrorsNameArguments()
    def trial(
        self, variant: int, seed: int | None = None, *, fidelity: str | None = None, rate_hz: float | None = None
    ) -> Trial:
        """Run one trial, at contact fidelity with its course over time; nothing is stored.

        Args:
            variant: Id of the variant.
            seed: The seed; the study's first by default.
            fidelity: Fidelity of the simulation; the study's by default.
            rate_hz: Rate of the physics steps; the study's by default.

        Raises:
            DefinitionError: There is no such variant or fidelity, or a number is out of range.
            SimulationError: The physics engine cannot build the world.
        """
        return run_one(self.project, self._drawing, variant, seed, fidelity=fidelity, rate_hz=rate_hz)

    @ErrorsNameArguments()
    def payload(
        self, variant: int, *, friction: float | None = None, finger_force_n: float | None = None
    ) -> PayloadResult:
        """Test a variant's gripper on the payload bench: the mass at which it first fails.

        Args:
            variant: Id of the variant.
            friction: Another coefficient of friction of its pads.
            finger_force_n: Another force of each finger.

        Returns:
            ``payload_kg`` with the limiting cause, and ``theory_kg`` by Coulomb's law.

        Raises:
            DefinitionError: There is no such variant, or the bench cannot be run with these values.
            SimulationError: The physics engine cannot build the rig.
        """
        return payload_of(self.project, variant, friction=friction, finger_force_n=finger_force_n)

    @cached_property
    def _designs(self) -> tuple[DesignVariant, ...]:
        return self.project.designs.expand()

    @cached_property
    @ErrorsNameArguments()
    def _read(self) -> tuple[tuple[VariantMeasures, ...], ScreeningResult | None]:
        project = self.project
        if not project.evidence.exists():
            raise EvidenceError(f"there is no evidence in {project.evidence}", hint=sweep_hint(project))
        with EvidenceStore.open(project.evidence, create=False) as store:
            return measure_survivors(project, store, recorded=read_record(project.folder))

    @property
    def _measured(self) -> tuple[VariantMeasures, ...]:
        return self._read[0]

    @property
    def _known(self) -> tuple[VariantMeasures, ...]:
        """Every variant with its estimates; none if there is no evidence yet."""
        return self._measured if self.project.evidence.exists() else ()

    @property
    def _screened(self) -> ScreeningResult | None:
        return self._read[1] if self.project.evidence.exists() else None

    @property
    def _tried(self) -> tuple[VariantMeasures, ...]:
        """Every variant with its estimates, of which at least one has a trial."""
        return with_trials(self.project, self._measured)

    @cached_property
    def _trade(self) -> Trade:
        return Trade(project=self.project, measured=self._measured)
