"""Tables of a traceability report, for Markdown, CSV, Excel and the terminal."""

from __future__ import annotations

from rgss.reports.tables import Cell, Table
from rgss.reports.trace.report import MatrixPart, TraceReport
from rgss.trace.evidence import KEY_DIGITS, TestEvidence, TrialEvidence, VerificationRow
from rgss.trace.views import Chain, Impact, end_in_words, estimate_in_words, record_in_words, verdict_in_words

LINKED = "x"
"""Cell of a matrix whose row and column are linked."""


def report_tables(report: TraceReport, *, widest_grid: int, gaps_only: bool = False) -> tuple[Table, ...]:
    """Every table of a report.

    Args:
        report: The report.
        widest_grid: Most columns of a matrix that is written as a grid, not as a list of links.
        gaps_only: True to omit the matrices of links, and met requirements in the verification matrix.
    """
    matrices = () if gaps_only else tuple(matrix_table(part, widest_grid=widest_grid) for part in report.matrices)
    return (
        coverage_table(report),
        gap_table(report),
        *matrices,
        verification_table(report, gaps_only=gaps_only),
    )


def coverage_table(report: TraceReport) -> Table:
    """Table of the coverage, with the uncovered elements."""
    return Table(
        name="coverage",
        title="Coverage",
        heads=("metric", "what is counted", "covered", "of", "share", "must be complete", "not covered"),
        rows=[
            (
                metric.id,
                metric.title,
                metric.covered,
                metric.total,
                f"{metric.percent:.1f}%",
                "yes" if metric.required else "no",
                " ".join(metric.missing),
            )
            for metric in report.metrics
        ],
        note=f"Evidence: {report.evidence.choice}.",
    )


def gap_table(report: TraceReport) -> Table:
    """Table of the gaps, one row for each element."""
    return Table(
        name="gaps",
        title="Gaps",
        heads=("id", "has", "text"),
        rows=[(gap.id, ", ".join(gap.lacks), gap.text) for gap in report.gaps],
        note="" if report.gaps else "There is none.",
    )


def matrix_table(part: MatrixPart, *, widest_grid: int) -> Table:
    """Matrix as a grid of marks, or as a list of links if the grid would be too wide.

    Args:
        part: The matrix.
        widest_grid: The greatest number of columns of a grid.
    """
    matrix = part.matrix
    pairs = zip(matrix.rows, matrix.linked, strict=True)
    is_grid = len(matrix.columns) <= widest_grid
    rows: list[tuple[Cell, ...]] = []
    for row, indices in pairs:
        text = part.row_texts.get(row, "")
        if is_grid:
            marks: list[Cell] = [None] * len(matrix.columns)
            for index in indices:
                marks[index] = LINKED
            rows.append((row, text, *marks))
        else:
            rows.append((row, text, len(indices), " ".join(matrix.columns[index] for index in indices)))
    return Table(
        name=part.name,
        title=part.title,
        heads=("id", "text", *matrix.columns) if is_grid else ("id", "text", "links", part.relation),
        rows=rows,
        note=matrix_note(part),
        marks_from=2 if is_grid else None,
    )


def matrix_note(part: MatrixPart) -> str:
    """Number of links of a matrix, with the rows and columns without a link."""
    matrix = part.matrix
    note = f"{len(matrix.rows)} {part.rows_are}, {len(matrix.columns)} {part.columns_are}, {matrix.link_count} links."
    if matrix.empty_rows:
        note += f" Rows without a link: {_first(matrix.empty_rows)}."
    if matrix.empty_columns:
        verb = "lack a link" if part.columns_required else "have no link, which is allowed"
        note += f" {len(matrix.empty_columns)} columns {verb}: {_first(matrix.empty_columns)}."
    return note


def verification_table(report: TraceReport, *, gaps_only: bool = False) -> Table:
    """The verification matrix with the columns of the NASA handbook's table D-1, and the evidence of each verdict."""
    rows = [row for row in report.verification if row.has_gap or not gaps_only]
    return Table(
        name="verification",
        title="Verification matrix",
        heads=(
            "requirement",
            "text",
            "success criterion",
            "method",
            "facility",
            "phase",
            "evidence",
            "verdict",
            "measured",
            "variants",
            "document",
            "responsible",
        ),
        rows=[_verification_cells(row) for row in rows],
        note=f"Evidence: {report.evidence.choice}.",
    )


def chain_table(chain: Chain) -> Table:
    """A chain, one row for each step; depths above the id are negative."""
    here: tuple[Cell, ...] = (0, "", chain.id, chain.kind.value, chain.text, chain.note)
    up = [(-step.depth, step.relation.value, step.id, step.kind.value, step.text, step.note) for step in chain.up]
    down = [(step.depth, step.relation.value, step.id, step.kind.value, step.text, step.note) for step in chain.down]
    return Table(
        name="chain",
        title=f"Chain of {chain.id}",
        heads=("depth", "relation", "id", "kind", "text", "evidence"),
        rows=[*up, here, *down],
    )


def impact_table(impact: Impact) -> Table:
    """Impact of a change, one row for each element."""
    groups: tuple[tuple[str, tuple[str, ...]], ...] = (
        ("stakeholder requirement to compare with", impact.needs),
        ("system requirement", impact.requirements),
        ("block or behaviour", impact.elements),
        ("measure", impact.measures),
        ("verdict to renew", tuple(verdict.requirement for verdict in impact.verdicts)),
        ("trial that a verdict depends on", impact.trials),
        ("test to run again", impact.tests),
        ("verification record to renew", impact.records),
        ("review to renew", impact.reviews),
    )
    notes = {
        verdict.requirement: verdict_in_words(verdict.verdict)
        + (f"; {verdict.variants} variants" if verdict.variants else "")
        for verdict in impact.verdicts
    }
    return Table(
        name="impact",
        title=f"Impact of a change to {impact.id}",
        heads=("what", "id", "note"),
        rows=[
            (what, name, notes.get(name, "") if what.startswith("verdict") else "")
            for what, names in groups
            for name in names
        ],
    )


def evidence_in_words(row: VerificationRow) -> str:
    """Evidence of a verdict: trials by key with their command, tests by id, the verification record."""
    parts = [_trial_in_words(trial) for trial in row.trials]
    if not parts and row.estimate is not None and row.estimate.n == 0 and row.estimate.value is not None:
        parts.append(f"computed from the design of variant {row.variant}")
    parts += [_test_in_words(test) for test in row.tests]
    parts += [] if row.record is None else [f"record: {record_in_words(row.record)}"]
    return "; ".join(parts)


def tally_in_words(row: VerificationRow) -> str:
    """Numbers of variants by verdict."""
    return ", ".join(f"{count} {verdict_in_words(verdict)}" for verdict, count in row.tally)


def _verification_cells(row: VerificationRow) -> tuple[Cell, ...]:
    requirement = row.requirement
    return (
        requirement.id,
        requirement.text,
        row.success,
        "" if requirement.verification is None else requirement.verification.value,
        requirement.facility or "",
        "" if requirement.phase is None else requirement.phase.value,
        evidence_in_words(row),
        verdict_in_words(row.verdict, row.causes),
        "" if row.estimate is None else estimate_in_words(row.estimate),
        tally_in_words(row),
        row.document,
        requirement.owner,
    )


def _trial_in_words(trial: TrialEvidence) -> str:
    return f"trial {trial.key[:KEY_DIGITS]} (variant {trial.variant}, seed {trial.seed}): {trial.replay_command}"


def _test_in_words(test: TestEvidence) -> str:
    return f"{test.test}: {end_in_words(test)}"


def _first(names: tuple[str, ...], most: int = 12) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
