"""A traceability report, a chain or an impact as one self-contained HTML page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from rgss.measures import Verdict
from rgss.reports.page import render_page
from rgss.reports.trace.report import TraceReport, element_texts
from rgss.reports.trace.sections import (
    Section,
    anchors_of,
    element_rows,
    matrix_section,
    metric_rows,
    need_rows,
    verification_section,
)
from rgss.trace.views import Chain, Impact, verdict_in_words

MOST_ROWS = 2_000
"""Most rows of a table on a page; of a longer one, the rows with gaps and a note on the others are shown."""


def report_to_html(
    report: TraceReport,
    *,
    gaps_only: bool = False,
    drawings: Sequence[Mapping[str, Any]] = (),
    drawings_notice: str = "",
) -> str:
    """Write a report as one HTML page.

    Args:
        report: The report.
        gaps_only: True to omit the matrices of links, and met requirements in the verification matrix.
        drawings: The diagrams, from `rgss.reports.diagrams.diagrams.drawings_for_page`.
        drawings_notice: A note on the diagrams, such as why some are missing.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    return render_page(
        "trace/trace.html.j2",
        title=report.title,
        lead=f"Evidence: {report.evidence.choice}.",
        **trace_context(report, gaps_only=gaps_only, drawings=drawings, drawings_notice=drawings_notice),
    )


def trace_context(
    report: TraceReport,
    *,
    gaps_only: bool = False,
    drawings: Sequence[Mapping[str, Any]] = (),
    drawings_notice: str = "",
) -> dict[str, Any]:
    """Variables of the template of the traceability sections, by name.

    Args:
        report: The report.
        gaps_only: As for `report_to_html`, as are the next two.
        drawings: The diagrams.
        drawings_notice: A note on them.
    """
    needs, elements = need_rows(report, most=MOST_ROWS), element_rows(report, most=MOST_ROWS)
    anchors = anchors_of(report, most=MOST_ROWS, gaps_only=gaps_only)
    matrices = [] if gaps_only else [matrix_section(part, most_rows=MOST_ROWS) for part in report.matrices]
    sections = [Section(anchor="coverage", title="Coverage")]
    sections += [Section(anchor="gaps", title="Gaps")] if gaps_only else []
    sections += [Section(anchor=matrix["anchor"], title=matrix["title"]) for matrix in matrices]
    sections += [Section(anchor="verification", title="Verification matrix")]
    if not gaps_only:
        sections += [Section(anchor="needs", title="Stakeholder requirements")] if needs else []
        sections += [Section(anchor="architecture", title="Blocks and behaviours")] if elements else []
        sections += [Section(anchor="diagrams", title="Diagrams")] if drawings or drawings_notice else []
    return {
        "summary": _summary(report),
        "sections": sections,
        "anchors": anchors,
        "metrics": metric_rows(report),
        "gaps": report.gaps[:MOST_ROWS] if gaps_only else None,
        "gaps_left_out": max(0, len(report.gaps) - MOST_ROWS),
        "matrices": matrices,
        "verification": verification_section(report, most_rows=MOST_ROWS, gaps_only=gaps_only),
        "needs": [] if gaps_only else needs,
        "elements": [] if gaps_only else elements,
        "drawings": [] if gaps_only else list(drawings),
        "drawings_notice": "" if gaps_only else drawings_notice,
        "drawing_style": _drawing_style(),
    }


def chain_to_html(chain: Chain) -> str:
    """Write a chain as one HTML page.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    return render_page("trace/chain.html.j2", title=f"Chain of {chain.id}", chain=chain)


def impact_to_html(impact: Impact, report: TraceReport) -> str:
    """Write the impact of a change as one HTML page.

    Args:
        impact: The impact.
        report: The report of the same project, for the texts.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    texts = element_texts(report.model, report.definitions)
    verdicts_by_id = {one.requirement: one for one in impact.verdicts}

    def group(title: str, names: Sequence[str], notes: Mapping[str, str] | None = None) -> dict[str, Any]:
        things = [{"id": name, "text": texts.get(name, ""), "note": (notes or {}).get(name, "")} for name in names]
        return {"title": f"{title} ({len(things)})", "things": things}

    verdicts = {
        name: verdict_in_words(one.verdict) + (f", {one.variants} variants" if one.variants else "")
        for name, one in verdicts_by_id.items()
    }
    return render_page(
        "trace/impact.html.j2",
        title=f"Impact of a change to {impact.id}",
        groups=[
            group("Stakeholder requirements to compare with", impact.needs),
            group("System requirements", impact.requirements),
            group("Blocks and behaviours", impact.elements),
            group("Measures", impact.measures),
            group("Verdicts to renew", list(verdicts_by_id), verdicts),
            group("Trials of the shown variant that they depend on", impact.trials),
            group("Tests to run again", impact.tests),
            group("Verification records to renew", impact.records),
            group("Reviews to renew", impact.reviews),
        ],
    )


def _summary(report: TraceReport) -> str:
    requirements = report.model.requirements
    counts = Counter(row.verdict for row in report.verification)
    order = (*Verdict, None)
    counted = ", ".join(f"{counts[verdict]} {verdict_in_words(verdict)}" for verdict in order if counts[verdict])
    return (
        f"{len(requirements.stakeholder)} stakeholder requirements, {len(requirements.system)} system requirements"
        f" ({counted}), {len(report.model.measures)} measures, {len(requirements.architecture.elements)} blocks and"
        f" behaviours, {len(report.model.links)} links, {len(report.gaps)} gaps."
    )


def _drawing_style() -> Any:
    from markupsafe import Markup

    from rgss.reports.diagrams import STYLE

    return Markup(STYLE)  # noqa: S704 - this package's own text
