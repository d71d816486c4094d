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
    """One matrix of links with what a reader needs to read it.

    Attributes:
        name: Its name in file names and options, such as ``system-stakeholder``.
        title: Its title.
        rows_are: What its rows are, in the plural.
        columns_are: What its columns are, in the plural.
        relation: How a row stands to a column that it is linked to.
        matrix: The links.
        row_texts: What each row says, by its id.
        column_texts: What each column says, by its id.
        columns_required: Whether a column without a link is a gap.
        split_at: Index of the column at which a second sort of columns begins; None if there is one sort.
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
    """Something that is open.

    Attributes:
        id: Id of the element.
        text: What the element says.
        metrics: The coverage that it lacks.
    """

    id: str
    text: str
    metrics: tuple[CoverageMetric, ...]

    @property
    def lacks(self) -> tuple[str, ...]:
        """List of what it lacks; that it is not met is left out where there is no evidence."""
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
        definitions: The measures as they are defined; None if only their links are known.
        evidence: What is known beyond the files.
        matrices: The three matrices of links.
        verification: The verification matrix.
        metrics: How complete the project is.
        gaps: What is open and must not be, element by element.
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
        """True if nothing is open that a project must have."""
        return not any(metric.required and metric.missing for metric in self.metrics)


def trace_report(
    model: TraceModel, evidence: TraceEvidence, *, title: str, definitions: MeasureSet | None = None
) -> TraceReport:
    """Gather everything that a traceability report shows.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: What is known beyond its files.
        title: The title of the report.
        definitions: The measures as they are defined, for their names.
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
