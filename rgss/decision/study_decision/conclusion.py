"""Conclusion on every design: feasible, infeasible or open, by its verdicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.assessment import VariantMeasures, requirements_with_criteria, stale_remedies
from rgss.measures import Verdict, judge
from rgss.studies import Project
from rgss.trace.evidence import FailedVerifications

_NONE_FAILED = FailedVerifications()


class Feasibility(str, Enum):
    """Conclusion on a design under all requirements with a criterion."""

    FEASIBLE = "feasible"
    """Every verdict is met."""
    INFEASIBLE = "infeasible"
    """Some verdict is not met."""
    OPEN = "open"
    """No verdict is not met, and some is inconclusive, stale or not run."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignStanding:
    """Verdicts on one design.

    Attributes:
        variant: Its id.
        met: Ids of the requirements that are shown to be met.
        open: Ids of those whose verdict is inconclusive.
        missed: Ids of those that are shown not to be met.
        not_run: Ids of those without valid evidence, and of those without a criterion.
        undecided: Ids of those with a criterion that are open or without evidence.
        stale: Ids of those whose verdict is stale.
    """

    variant: int
    met: tuple[str, ...]
    open: tuple[str, ...]
    missed: tuple[str, ...]
    not_run: tuple[str, ...]
    undecided: tuple[str, ...]
    stale: tuple[str, ...] = ()

    @property
    def feasibility(self) -> Feasibility:
        """Feasible, infeasible or open; of requirements without a criterion only those count that are missed."""
        if self.missed:
            return Feasibility.INFEASIBLE
        return Feasibility.OPEN if self.undecided else Feasibility.FEASIBLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Conclusion:
    """Conclusion on a study's designs.

    Attributes:
        standings: The verdicts on each design, by ascending id.
        chosen: The verdicts on the chosen design; None if nothing is chosen.
        unmeasured: Ids of the system requirements without a criterion.
        failed: Requirements that tests or verification records show are not met.
        remedies: Sentences that name the commands after which no verdict is stale; empty if none is.
    """

    standings: tuple[DesignStanding, ...]
    chosen: DesignStanding | None
    unmeasured: tuple[str, ...]
    failed: FailedVerifications = _NONE_FAILED
    remedies: tuple[str, ...] = ()

    @property
    def stale(self) -> tuple[str, ...]:
        """Ids of the requirements with a stale verdict on a design, in their order."""
        return tuple(dict.fromkeys(requirement for one in self.standings for requirement in one.stale))

    def count(self, feasibility: Feasibility) -> int:
        """Number of designs with this conclusion."""
        return sum(one.feasibility is feasibility for one in self.standings)

    @property
    def open_by(self) -> tuple[str, ...]:
        """Ids of the requirements that leave designs open, those of the most designs first."""
        counted = Counter(
            requirement
            for one in self.standings
            if one.feasibility is Feasibility.OPEN
            for requirement in one.undecided
        )
        return tuple(sorted(counted, key=lambda requirement: (-counted[requirement], requirement)))


def conclusion_of(
    project: Project,
    measured: Sequence[VariantMeasures],
    chosen: int | None,
    failed: FailedVerifications = _NONE_FAILED,
) -> Conclusion:
    """The verdicts on every design, counted.

    Args:
        project: The project, under the suppositions if there are any.
        measured: Every variant with its estimates.
        chosen: Id of the chosen variant; None if nothing is chosen.
        failed: Requirements that tests or verification records show are not met.
    """
    decided = {one.id for one in requirements_with_criteria(project)}
    unmeasured = tuple(one.id for one in project.requirements.system if one.id not in decided)
    standings = tuple(_standing(project, entry, unmeasured, failed.requirements) for entry in measured)
    return Conclusion(
        standings=standings,
        chosen=next((one for one in standings if one.variant == chosen), None),
        unmeasured=unmeasured,
        failed=failed,
        remedies=_remedies(project, measured),
    )


def _remedies(project: Project, measured: Sequence[VariantMeasures]) -> tuple[str, ...]:
    remedies = stale_remedies(project, measured)
    return (f"'{project.command('measure')}' says what changed.", *remedies) if remedies else ()


def _standing(
    project: Project, entry: VariantMeasures, unmeasured: tuple[str, ...], failed: tuple[str, ...]
) -> DesignStanding:
    found: dict[Verdict, list[str]] = {verdict: [] for verdict in Verdict}
    for requirement in requirements_with_criteria(project):
        if requirement.criterion is None:
            continue
        # Computed again, since suppositions change thresholds and estimates.
        stale = entry.verdicts.get(requirement.id) is Verdict.STALE
        verdict = judge(requirement.criterion, entry.estimates[requirement.criterion.measure], stale=stale)
        if verdict is Verdict.NOT_RUN and entry.records:
            verdict = Verdict.INCONCLUSIVE
        if requirement.id in failed:
            verdict = Verdict.NOT_MET
        found[verdict].append(requirement.id)
    without = (*found[Verdict.NOT_RUN], *found[Verdict.STALE])
    return DesignStanding(
        variant=entry.variant.id,
        met=tuple(found[Verdict.MET]),
        open=tuple(found[Verdict.INCONCLUSIVE]),
        missed=(*found[Verdict.NOT_MET], *(one for one in unmeasured if one in failed)),
        not_run=(*without, *(one for one in unmeasured if one not in failed)),
        undecided=(*found[Verdict.INCONCLUSIVE], *without),
        stale=tuple(found[Verdict.STALE]),
    )
