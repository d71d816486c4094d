"""Content of a traceability report: matrices, verification, coverage, gaps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rgss.measures import MeasureSet
from rgss.requirements import Behaviour, Block
from rgss.trace.evidence import TraceEvidence, VerificationRow, verification_matrix
from rgss.trace.model import TraceModel
from rgss.trace.views import CoverageMetric, TraceMatrix, coverage_metrics, trace_matrices


@dataclass(frozen=True, slots=True, kw_only=True)
class MatrixPart:
    """Matrix of links with its titles and texts.

    Attributes:
        name: Its name in file names and options, such as ``system-stakeholder``.
        title: Its title.
        rows_are: Kind of its rows, in the plural.
        columns_are: Kind of its columns, in the plural.
        relation: Relation of a row to a linked column.
        matrix: The links.
        row_texts: Text of each row, by its id.
        column_texts: Text of each column, by its id.
        columns_required: True if a column without a link is a gap.
        split_at: Index of the column at which a second kind of columns begins; None if there is one kind.
    """

    name: str
    title: str
    rows_are: str
    columns_are: str
    relation: str
    matrix: TraceMatrix
    row_texts: Mapping[str, str]
    column_texts: Mapping[str, str]
    columns_required: bool
    split_at: int | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Gap:
    """Gap: an element that lacks a link, evidence or a met verdict."""

    id: str
    text: str
    metrics: tuple[CoverageMetric, ...]

    @property
    def lacks(self) -> tuple[str, ...]:
        """The missing coverage; "not met" is omitted if there is no evidence."""
        names = [metric.id for metric in self.metrics]
        return tuple(
            metric.lack for metric in self.metrics if metric.id != "system-met" or "system-evidence" not in names
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceReport:
    """Content of a traceability report.

    Attributes:
        title: The title of the report.
        model: The project's requirements, architecture and measures.
        definitions: The definitions of the measures; None if only their links are known.
        evidence: The evidence.
        matrices: The three matrices of links.
        verification: The verification matrix.
        metrics: The coverage of the project.
        gaps: The gaps, element by element.
    """

    title: str
    model: TraceModel
    definitions: MeasureSet | None
    evidence: TraceEvidence
    matrices: tuple[MatrixPart, ...]
    verification: tuple[VerificationRow, ...]
    metrics: tuple[CoverageMetric, ...]
    gaps: tuple[Gap, ...]

    @property
    def is_complete(self) -> bool:
        """True if there are no gaps."""
        return not any(metric.required and metric.missing for metric in self.metrics)


def trace_report(
    model: TraceModel, evidence: TraceEvidence, *, title: str, definitions: MeasureSet | None = None
) -> TraceReport:
    """Gather the content of a traceability report.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: The evidence.
        title: The title of the report.
        definitions: The definitions of the measures, for their names.
    """
    matrices = trace_matrices(model)
    metrics = coverage_metrics(model, matrices, evidence)
    texts = element_texts(model, definitions)
    needs = {need.id: need.text for need in model.requirements.stakeholder}
    return TraceReport(
        title=title,
        model=model,
        definitions=definitions,
        evidence=evidence,
        matrices=(
            MatrixPart(
                name="stakeholder-moe",
                title="Stakeholder requirements × measures of effectiveness",
                rows_are="stakeholder requirements",
                columns_are="measures of effectiveness",
                relation="is answered by",
                matrix=matrices.stakeholder_by_effectiveness,
                row_texts=needs,
                column_texts=texts,
                columns_required=True,
            ),
            MatrixPart(
                name="system-stakeholder",
                title="System requirements × stakeholder requirements",
                rows_are="system requirements",
                columns_are="stakeholder requirements",
                relation="derives from",
                matrix=matrices.system_by_stakeholder,
                row_texts=texts,
                column_texts=needs,
                columns_required=True,
            ),
            MatrixPart(
                name="system-architecture",
                title="System requirements × architecture",
                rows_are="system requirements",
                columns_are="blocks and behaviours",
                relation="is satisfied by",
                matrix=matrices.system_by_architecture,
                row_texts=texts,
                column_texts=texts,
                columns_required=False,
                split_at=len(model.requirements.architecture.blocks) or None,
            ),
        ),
        verification=verification_matrix(model, evidence),
        metrics=metrics,
        gaps=_gaps(metrics, texts),
    )


def element_texts(model: TraceModel, definitions: MeasureSet | None) -> Mapping[str, str]:
    """Text of each element, or its name, by its id."""
    texts = {measure.id: measure.id for measure in model.measures}
    if definitions is not None:
        texts |= {measure.id: measure.name for measure in definitions.measures}
    for element in model.requirements.elements:
        named = isinstance(element, (Block, Behaviour))
        texts[element.id] = f"{element.name}: {element.text}" if named else element.text  # type: ignore[union-attr]
    return texts


def _gaps(metrics: Sequence[CoverageMetric], texts: Mapping[str, str]) -> tuple[Gap, ...]:
    lacking: dict[str, list[CoverageMetric]] = {}
    for metric in metrics:
        for name in metric.missing if metric.required else ():
            lacking.setdefault(name, []).append(metric)
    return tuple(Gap(id=name, text=texts.get(name, ""), metrics=tuple(found)) for name, found in lacking.items())
