"""Findings about decisions that the replicates of a study do not support, before any trial is run."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.choosing import demanded_criteria
from rgss.decision.preference_model import program_of, risks_of, value_function_of
from rgss.documents import read_document
from rgss.errors import TradeoffError
from rgss.findings import Finding, Severity
from rgss.requirements import Statistic
from rgss.studies import Project
from rgss.tradeoff.sequential import unsupported_reason


def replication_findings(project: Project) -> Iterator[Finding]:
    """Errors of decisions that would be refused after the trials.

    They are demands on more replicates than a study with a fixed number has, and replication until decided of a
    trade-off that has no sequential rule (a warning if `rgss sweep` does not replicate until decided by itself).
    """
    if any(criterion.comparison.is_strict for criterion in demanded_criteria(project).values()):
        return  # no trade-off can hold it, which is a finding of its own
    study = project.study
    document = read_document(project.folder / study.label, label=study.label)
    refused = _unsupported(project) if study.is_sequential else None
    if refused is not None:
        message, hint = refused
        severity = Severity.ERROR if study.sweeps_until_decided else Severity.WARNING
        yield document.finding("study.until-decided", message, ("until_decided",), severity=severity, hint=hint)
    if study.is_sequential:
        return
    for risk in risks_of(project):
        if study.replicates < risk.replicates_needed:
            message = f"{risk.requirement} needs {risk.replicates_needed} replicates, the study has {study.replicates}"
            hint = f"write 'replicates: {risk.replicates_needed}', or ask for less: {risk.demand}"
            place = ("replicates",) if "replicates" in document.data else ("trade_off", risk.requirement.split(":")[0])
            yield document.finding("study.replicates", message, place, hint=hint)


def require_sequential_rule(project: Project) -> None:
    """Refuse a trade-off that has no sequential rule.

    Raises:
        TradeoffError: It has none, or its program contradicts itself.
        DefinitionError: Its program is anchored on a requirement that has no criterion on the measure.
    """
    refused = _unsupported(project)
    if refused is not None:
        raise TradeoffError(refused[0], hint=refused[1])


def _unsupported(project: Project) -> tuple[str, str] | None:
    trade_off = project.study.trade_off
    program = program_of(project, tuple(value_function_of(project, valued) for valued in trade_off.valued))
    ends = [
        (requirement, criterion.measure)
        for requirement, criterion in demanded_criteria(project).items()
        if criterion.statistic is not Statistic.VALUE
    ]
    return unsupported_reason(program.name, [risk.id for risk in trade_off.risks], ends)
