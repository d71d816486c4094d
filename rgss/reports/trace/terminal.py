"""Traceability report as tables that fit a terminal: ids, marks and numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from rgss.counted import counted
from rgss.findings import printable
from rgss.reports.plain_text import aligned_table
from rgss.reports.tables import Cell, Table, cell_text, chosen_table
from rgss.reports.trace.report import MatrixPart, TraceReport
from rgss.reports.trace.tables import LINKED, matrix_note
from rgss.trace.evidence import KEY_DIGITS, VerificationRow
from rgss.trace.views import Chain, ChainStep, Impact, ThingKind, end_in_words, estimate_in_words, verdict_in_words

_WIDEST_GRID = 12
_LONGEST = 76
_MOST_NAMED = 6


def terminal_tables(report: TraceReport, *, gaps_only: bool = False, table: str = "") -> tuple[Table, ...]:
    """Every table of a report, short enough to be read in a terminal.

    Args:
        report: The report.
        gaps_only: True to omit the matrices of links, and met requirements in the verification matrix.
        table: Name of the only table; empty for all, where the table of gaps is included only with
            `gaps_only`, since the coverage names the gaps.

    Raises:
        DefinitionError: There is no such table.
    """
    coverage = Table(
        name="coverage",
        title="Coverage",
        heads=("of the …", "covered", "of", "not covered"),
        rows=[(metric.title, metric.covered, metric.total, _named(metric.missing)) for metric in report.metrics],
        note=f"Evidence: {report.evidence.choice}.",
    )
    gaps = Table(
        name="gaps",
        title="Gaps",
        heads=("id", "has", "text"),
        rows=[(gap.id, ", ".join(gap.lacks), _short(gap.text)) for gap in report.gaps],
        note="" if report.gaps else "There is none.",
    )
    rows = [row for row in report.verification if row.has_gap or not gaps_only]
    verification = Table(
        name="verification",
        title="Verification matrix",
        heads=("requirement", "method", "success criterion", "evidence", "verdict"),
        rows=[
            (
                row.requirement.id,
                "" if row.requirement.verification is None else row.requirement.verification.value,
                _short(row.success),
                _evidence(row),
                verdict_in_words(row.verdict, row.causes),
            )
            for row in rows
        ],
    )
    matrices = [] if gaps_only else [_matrix(part) for part in report.matrices]
    whole = (coverage, gaps, *matrices, verification)
    if table:
        return chosen_table(whole, table)
    return whole if gaps_only else (coverage, *matrices, verification)


def report_lines(report: TraceReport, *, gaps_only: bool = False, table: str = "") -> list[str]:
    """A report as lines of text.

    Args:
        report: The report.
        gaps_only: As of `terminal_tables`.
        table: As of `terminal_tables`.

    Raises:
        DefinitionError: There is no such table.
    """
    return [report.title, "", *table_lines(terminal_tables(report, gaps_only=gaps_only, table=table))]


def found_lines(found: Chain | Impact) -> list[str]:
    """A chain or an impact as lines of text."""
    return chain_lines(found) if isinstance(found, Chain) else impact_lines(found)


def table_lines(tables: Sequence[Table]) -> list[str]:
    """Tables as aligned lines of text, each under its title; control characters are replaced."""
    lines: list[str] = []
    for table in tables:
        if lines:
            lines.append("")
        lines.append(table.title)
        lines += [printable(" ".join(table.note.split()))]
        if table.rows:
            cells = [[printable(cell_text(cell)) for cell in row] for row in (table.heads, *table.rows)]
            lines += aligned_table(cells[0], cells[1:])
    return lines


def chain_lines(chain: Chain) -> list[str]:
    """Chain as indented lines: the id, the elements above it, the elements below it."""
    note = f" [{chain.note}]" if chain.note else ""
    lines = [printable(f"{chain.id} ({chain.kind.value}){note}")]
    lines += [f"  {printable(' '.join(chain.text.split()))}"] if chain.text.strip() else []
    for title, steps in (("Up, towards the need", chain.up), ("Down, towards the evidence", chain.down)):
        lines += ["", f"{title}:"]
        lines += [line for step in steps for line in _step_lines(step)] or ["  nothing"]
    return lines


def impact_lines(impact: Impact) -> list[str]:
    """Impact of a change as lines, one for each kind of element, with their number and ids."""
    verdicts = [
        f"{one.requirement} ({verdict_in_words(one.verdict)}{f', {one.variants} variants' if one.variants else ''})"
        for one in impact.verdicts
    ]
    groups = (
        ("Stakeholder requirements to compare with", impact.needs),
        ("System requirements", impact.requirements),
        ("Blocks and behaviours", impact.elements),
        ("Measures", impact.measures),
        ("Verdicts to renew", verdicts),
        ("Trials of the shown variant that they depend on", [key[:KEY_DIGITS] for key in impact.trials]),
        ("Tests to run again", impact.tests),
        ("Verification records to renew", impact.records),
        ("Reviews to renew", impact.reviews),
    )
    lines = [printable(f"Impact of a change to {impact.id} ({impact.kind.value})")]
    for title, names in groups:
        lines += ["", f"{title} ({len(names)})"]
        separator = "\n" if title.startswith("Tests") else ", "
        lines += [f"  {printable(' '.join(part.split()))}" for part in separator.join(names).splitlines()]
    return lines


def _step_lines(step: ChainStep) -> list[str]:
    indent = "  " * step.depth
    note = f" [{_short(step.note)}]" if step.note else ""
    name = step.id[:KEY_DIGITS] if step.kind is ThingKind.TRIAL else step.id
    again = " (its links are listed above)" if step.repeated else ""
    text = f": {_short(step.text)}" if step.text else ""
    return [printable(f"{indent}{step.relation.value} {name}{text}{note}{again}")]


def _matrix(part: MatrixPart) -> Table:
    matrix = part.matrix
    if len(matrix.columns) > _WIDEST_GRID:
        rows: Sequence[tuple[Cell, ...]] = [(row, " ".join(matrix.linked_to_row(row))) for row in matrix.rows]
        heads: tuple[str, ...] = (part.rows_are, part.relation)
    else:
        rows = [
            (row, *(LINKED if index in indices else "" for index in range(len(matrix.columns))))
            for row, indices in zip(matrix.rows, matrix.linked, strict=True)
        ]
        heads = (part.rows_are, *matrix.columns)
    return Table(name=part.name, title=part.title, heads=heads, rows=rows, note=matrix_note(part))


def _evidence(row: VerificationRow) -> str:
    parts = [] if row.estimate is None or row.estimate.value is None else [estimate_in_words(row.estimate)]
    counts = Counter(end_in_words(test) for test in row.tests)
    parts += [f"{counted(count, 'test')} {end}" for end, count in counts.items()]
    parts += [] if row.record is None else [f"record of {row.record.record.date}"]
    if row.estimate is None and row.tally:
        # Without a choice no variant is shown, and all are judged.
        parts.insert(0, f"trials of {sum(count for _, count in row.tally)} variants")
    return "; ".join(parts) or "none"


def _named(names: Sequence[str]) -> str:
    more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
    return " ".join(names[:_MOST_NAMED]) + more


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST else f"{line[: _LONGEST - 1].rstrip()}…"
