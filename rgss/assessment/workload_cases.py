"""Trials of one case of a workload, and the success of each case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rgss.assessment.measuring import VariantMeasures
from rgss.designs import sources
from rgss.errors import DefinitionError
from rgss.findings import shown
from rgss.measures import Verdict, evaluate, judge
from rgss.requirements import Criterion
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class CaseSuccess:
    """Trials of a case, over all designs."""

    case: str
    trials: int
    successes: int

    @property
    def share(self) -> float:
        """Share of the trials that succeeded."""
        return self.successes / self.trials


def success_by_case(project: Project, measured: Sequence[VariantMeasures]) -> tuple[CaseSuccess, ...]:
    """The success of each case of the workload, in the order of the file; none without a workload.

    Args:
        project: The project with its study.
        measured: Every variant with its records.
    """
    found = []
    for case in project.workload.cases:
        records = [record for entry in measured for record in entry.records if record.workload == case.id]
        if records:
            successes = sum(record.success for record in records)
            found.append(CaseSuccess(case=case.id, trials=len(records), successes=successes))
    return tuple(found)


def measured_in_case(project: Project, measured: Sequence[VariantMeasures], case: str) -> tuple[VariantMeasures, ...]:
    """Every variant with estimates and verdicts from the trials of one case alone.

    Raises:
        DefinitionError: The study's workload has no such case.
    """
    known = [one.id for one in project.workload.cases]
    if case not in known:
        message = f"the workload has no case {shown(case)}" if known else "the study has no workload"
        raise DefinitionError(f"--case: {message}", hint=f"cases: {', '.join(known)}" if known else "")
    return tuple(_in_case(project, entry, case) for entry in measured)


def _in_case(project: Project, entry: VariantMeasures, case: str) -> VariantMeasures:
    pairs = [(key, record) for key, record in zip(entry.trials, entry.records, strict=True) if record.workload == case]
    records = tuple(record for _, record in pairs)
    estimates = evaluate(
        project.measures,
        fixed=sources(entry.variant),
        trials=[record.metrics for record in records],
        variant=entry.variant.id,
        over_looks=project.study.is_sequential,
    )
    criteria = {one.id: one.criterion for one in project.requirements.system if one.criterion is not None}

    def verdict(requirement: str, criterion: Criterion) -> Verdict:
        stale = entry.verdicts.get(requirement) is Verdict.STALE
        found = judge(criterion, estimates[criterion.measure], stale=stale)
        return Verdict.INCONCLUSIVE if found is Verdict.NOT_RUN and records else found

    return replace(
        entry,
        trials=tuple(key for key, _ in pairs),
        records=records,
        estimates=estimates,
        verdicts={name: verdict(name, criterion) for name, criterion in criteria.items()},
    )
