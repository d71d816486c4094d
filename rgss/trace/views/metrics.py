"""Coverage metrics: shares of the elements that are linked, decided and verified."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rgss.measures import Verdict
from rgss.requirements import LinkKind
from rgss.trace.evidence import TraceEvidence
from rgss.trace.model import MeasureKind, TraceModel
from rgss.trace.views.matrices import (
    TraceMatrix,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class CoverageMetric:
    """Coverage metric: a share of covered elements.

    Attributes:
        id: Its id, such as ``needs-derived``.
        title: Description of the count.
        lack: Deficiency of an uncovered element, such as ``no success criterion``.
        covered: Number of covered elements.
        missing: Ids of the uncovered elements, in the order of their file.
        required: True if completeness of a project requires full coverage.
    """

    id: str
    title: str
    lack: str
    covered: int
    missing: tuple[str, ...]
    required: bool = True

    @property
    def total(self) -> int:
        """Number of them."""
        return self.covered + len(self.missing)

    @property
    def share(self) -> float:
        """The covered share, from 0 to 1; 1 where there is nothing to cover."""
        return self.covered / self.total if self.total else 1.0

    @property
    def percent(self) -> float:
        """The share in per cent, rounded down to a tenth, so that only complete coverage reads 100 %."""
        return self.covered * 1000 // self.total / 10 if self.total else 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceMatrices:
    """The three matrices of links of one model.

    Attributes:
        stakeholder_by_effectiveness: Stakeholder requirements against measures of effectiveness.
        system_by_stakeholder: System requirements against stakeholder requirements.
        system_by_architecture: System requirements against blocks and behaviours.
    """

    stakeholder_by_effectiveness: TraceMatrix
    system_by_stakeholder: TraceMatrix
    system_by_architecture: TraceMatrix


def trace_matrices(model: TraceModel) -> TraceMatrices:
    """Every matrix of links of a model."""
    return TraceMatrices(
        stakeholder_by_effectiveness=stakeholder_by_effectiveness(model),
        system_by_stakeholder=system_by_stakeholder(model),
        system_by_architecture=system_by_architecture(model),
    )


def coverage_metrics(model: TraceModel, matrices: TraceMatrices, evidence: TraceEvidence) -> tuple[CoverageMetric, ...]:
    """Completeness of a project: its links, its verification, its evidence.

    Args:
        model: The project's requirements, architecture and measures.
        matrices: The matrices of the model.
        evidence: Evidence of the project.
    """
    return (*_of_links(model, matrices), *_of_verification(model), *_of_evidence(model, evidence))


def _of_links(model: TraceModel, matrices: TraceMatrices) -> Iterable[CoverageMetric]:
    needs, system = matrices.stakeholder_by_effectiveness.rows, matrices.system_by_stakeholder.rows
    derived = {parent for requirement in model.requirements.system for parent in requirement.derived_from}
    yield _metric(
        "needs-derived",
        "no system requirement",
        "stakeholder requirements that a system requirement derives from",
        ((need, need in derived) for need in needs),
    )
    unmeasured = set(matrices.stakeholder_by_effectiveness.empty_rows)
    yield _metric(
        "needs-measured",
        "no measure of effectiveness",
        "stakeholder requirements that a measure of effectiveness answers",
        ((need, need not in unmeasured) for need in needs),
    )
    effectiveness = [measure for measure in model.measures if measure.kind is MeasureKind.MOE]
    contributed = {target for measure in model.measures for target in measure.contributes_to}
    yield _metric(
        "moes-computed",
        "no measure that it is computed from",
        "measures of effectiveness that other measures, or the trials themselves, give a value",
        ((measure.id, measure.observed or measure.id in contributed) for measure in effectiveness),
    )
    orphans = set(matrices.system_by_stakeholder.empty_rows)
    yield _metric(
        "system-derived",
        "no stakeholder requirement",
        "system requirements that derive from a stakeholder requirement",
        ((name, name not in orphans) for name in system),
    )
    unallocated = set(matrices.system_by_architecture.empty_rows)
    yield _metric(
        "system-allocated",
        "no allocation",
        "system requirements that a block or a behaviour satisfies",
        ((name, name not in unallocated) for name in system),
    )
    satisfying = {link.source for link in model.links if link.kind is LinkKind.SATISFY}
    yield _metric(
        "elements-satisfying",
        "no requirement to satisfy",
        "blocks and behaviours that satisfy a system requirement",
        ((element.id, element.id in satisfying) for element in model.requirements.architecture.elements),
        required=False,
    )


def _of_verification(model: TraceModel) -> Iterable[CoverageMetric]:
    system = model.requirements.system
    yield _metric(
        "system-method",
        "no verification method",
        "system requirements with a verification method",
        ((item.id, item.verification is not None) for item in system),
    )
    yield _metric(
        "system-success",
        "no success criterion",
        "system requirements with a success criterion, or a reason for having none",
        ((item.id, bool(item.criterion or item.success or item.criterion_exemption)) for item in system),
    )
    yield _metric(
        "system-facility",
        "no facility",
        "system requirements with a facility for their verification",
        ((item.id, bool(item.facility)) for item in system),
        required=False,
    )
    yield _metric(
        "system-phase",
        "no phase",
        "system requirements with a phase for their verification",
        ((item.id, item.phase is not None) for item in system),
        required=False,
    )


def _of_evidence(model: TraceModel, evidence: TraceEvidence) -> Iterable[CoverageMetric]:
    system = model.requirements.system
    yield _metric(
        "system-evidence",
        "no evidence that holds now",
        "system requirements with evidence that holds now: trials, the design, or a test that was run",
        ((item.id, evidence.has_evidence(item)) for item in system),
    )
    yield _metric(
        "system-met",
        "no verdict that it is met",
        "system requirements that the evidence shows to be met",
        ((item.id, evidence.verdict(item) is Verdict.MET) for item in system),
    )


def _metric(
    metric_id: str, lack: str, title: str, items: Iterable[tuple[str, bool]], *, required: bool = True
) -> CoverageMetric:
    covered, missing = 0, []
    for name, is_covered in items:
        if is_covered:
            covered += 1
        else:
            missing.append(name)
    return CoverageMetric(
        id=metric_id, title=title, lack=lack, covered=covered, missing=tuple(missing), required=required
    )
