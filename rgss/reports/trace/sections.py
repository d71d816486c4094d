"""Sections of a traceability page, cell by cell, for its template."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rgss.counted import counted
from rgss.measures import Verdict
from rgss.reports.trace.report import MatrixPart, TraceReport
from rgss.reports.trace.tables import matrix_note, tally_in_words
from rgss.requirements import Behaviour, Block, LinkKind, common_attributes
from rgss.trace.evidence import VerificationRow
from rgss.trace.views import end_in_words, estimate_in_words, record_in_words, value_in_words, verdict_in_words

MOST_CELLS, WIDEST_GRID = 30_000, 160
"""Most cells or columns of a matrix that is shown as a grid, not as a list of links."""

WIDEST_WITH_TEXTS = 24
"""Most columns of a matrix with texts; a wider one shows ids, with the texts on hover and focus."""

WIDEST_PRINTED = 40
"""Most columns of a matrix that fits on paper; a wider one is printed as a list of links."""

MOST_DETAILED = 1_000
"""With more system requirements than this, rationale and links are only in the other formats."""

_MOST_MISSING = 60
_SIGNS: Mapping[Verdict | None, str] = {
    None: "–",
    Verdict.MET: "✔",
    Verdict.NOT_MET: "✘",
    Verdict.INCONCLUSIVE: "◐",
    Verdict.NOT_RUN: "○",
    Verdict.STALE: "↻",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Section of a page: anchor and title."""

    anchor: str
    title: str


def anchors_of(report: TraceReport, *, most: int, gaps_only: bool) -> dict[str, str]:
    """Anchor of each element in the page, by its id."""
    anchors = {row.requirement.id: f"r-{row.requirement.id}" for row in _kept(report, most, gaps_only=gaps_only)}
    if not gaps_only:
        for shown in (need_rows(report, most=most), element_rows(report, most=most)):
            anchors |= {row["id"]: row["anchor"] for row in shown}
    return anchors


def metric_rows(report: TraceReport) -> list[dict[str, Any]]:
    """The coverage metrics, with the first of the missing ids."""
    return [
        {
            "title": metric.title,
            "covered": metric.covered,
            "total": metric.total,
            "share": metric.share,
            "percent": f"{metric.percent:g} %",
            "required": metric.required,
            "gap": metric.required and bool(metric.missing),
            "missing": metric.missing[:_MOST_MISSING],
            "left_out": max(0, len(metric.missing) - _MOST_MISSING),
        }
        for metric in report.metrics
    ]


def matrix_section(part: MatrixPart, *, most_rows: int) -> dict[str, Any]:
    """Matrix as a grid, or as a list of links if the grid would not fit."""
    matrix = part.matrix
    grid = len(matrix.columns) <= WIDEST_GRID and len(matrix.rows) * len(matrix.columns) <= MOST_CELLS
    everything = list(zip(matrix.rows, matrix.linked, strict=True))
    kept, notice = everything, ""
    if len(everything) > most_rows:
        kept = [(row, indices) for row, indices in everything if not indices][:most_rows]
        notice = _left_out(len(everything), len(kept))
    idle = set(matrix.empty_columns)
    section = {
        "anchor": f"matrix-{part.name}",
        "title": part.title,
        "note": matrix_note(part),
        "notice": notice,
        "relation": part.relation,
        "rows_are": part.rows_are,
        "grid": grid,
        "printed_as_list": grid and len(matrix.columns) > WIDEST_PRINTED,
        "shows_texts": len(matrix.columns) <= WIDEST_WITH_TEXTS,
    }
    if grid:
        lack = "lacks" if part.columns_required else "idle"
        section["columns"] = [
            {
                "id": column,
                "title": f"{column}: {part.column_texts.get(column, '')}",
                "classes": _classes(edge=index == part.split_at, **{lack: column in idle}),
            }
            for index, column in enumerate(matrix.columns)
        ]
    section["rows"] = [
        {
            "id": row,
            "text": part.row_texts.get(row, ""),
            "gap": not indices,
            "linked": [matrix.columns[index] for index in indices],
            **({"cells": _cells(indices, len(matrix.columns), part.split_at)} if grid else {}),
        }
        for row, indices in kept
    ]
    return section


def verification_section(report: TraceReport, *, most_rows: int, gaps_only: bool) -> dict[str, Any]:
    """The verification matrix."""
    rows = _kept(report, most_rows, gaps_only=gaps_only)
    there = [row for row in report.verification if row.has_gap or not gaps_only]
    return {
        "note": (
            f"Evidence: {report.evidence.choice}. Evidence from simulation is analysis in the sense of the NASA and "
            "INCOSE handbooks; a test is one of this software."
        ),
        "notice": _left_out(len(there), len(rows)) if len(rows) < len(there) else "",
        "details": len(report.verification) <= MOST_DETAILED,
        "rows": [_verification_row(row) for row in rows],
    }


def need_rows(report: TraceReport, *, most: int) -> list[dict[str, Any]]:
    """The stakeholder requirements; none if they are too many for a page."""
    needs = report.model.requirements.stakeholder
    if len(needs) > most:
        return []
    moe, system = (part.matrix for part in report.matrices[:2])
    derived: dict[str, list[str]] = {}
    for requirement, indices in zip(system.rows, system.linked, strict=True):
        for index in indices:
            derived.setdefault(system.columns[index], []).append(requirement)
    return [
        {
            "id": need.id,
            "anchor": f"n-{need.id}",
            "kind": need.kind.value,
            "text": need.text,
            **common_attributes(need),
            "links": _listed_links(
                ("Contained in", [need.parent] if need.parent else []),
                ("Answered by", moe.linked_to_row(need.id)),
                ("System requirements", derived.get(need.id, [])),
            ),
        }
        for need in needs
    ]


def element_rows(report: TraceReport, *, most: int) -> list[dict[str, Any]]:
    """Blocks and behaviours with the requirements they satisfy; none if they are too many for a page."""
    elements = report.model.requirements.architecture.elements
    if len(elements) > most:
        return []
    satisfies: dict[str, list[str]] = {}
    for link in report.model.links:
        if link.kind is LinkKind.SATISFY:
            satisfies.setdefault(link.source, []).append(link.target)
    return [
        {
            "id": element.id,
            "anchor": f"e-{element.id}",
            "kind": _kind(element),
            "text": f"{element.name}: {element.text}",
            "satisfies": satisfies.get(element.id, []),
        }
        for element in elements
    ]


def _kept(report: TraceReport, most: int, *, gaps_only: bool) -> list[VerificationRow]:
    """Rows of the verification matrix on a page: all, or those with gaps if there are too many."""
    rows = [row for row in report.verification if row.has_gap or not gaps_only]
    return rows if len(rows) <= most else [row for row in rows if row.has_gap][:most]


def _left_out(total: int, shown: int) -> str:
    gaps = f"the {shown} of them" if shown else "none of them, for none"
    return (
        f"These are {total} rows, too many for a page: it shows {gaps} with a gap. "
        "The formats csv, xlsx and json hold all."
    )


def _verification_row(row: VerificationRow) -> dict[str, Any]:
    requirement = row.requirement
    measure = "" if requirement.criterion is None else requirement.criterion.measure
    unit = "1" if row.estimate is None else row.estimate.unit
    counts: dict[str, int] = {}
    for test in row.tests:
        counts[end_in_words(test)] = counts.get(end_in_words(test), 0) + 1
    return {
        "anchor": f"r-{requirement.id}",
        "id": requirement.id,
        "document": row.document,
        "text": requirement.text,
        "success": row.success,
        "method": "" if requirement.verification is None else requirement.verification.value,
        "facility": requirement.facility or "",
        "phase": "" if requirement.phase is None else requirement.phase.value,
        "measured": "" if row.estimate is None else f"{measure} = {estimate_in_words(row.estimate)}",
        "variant": row.variant,
        "trials": [
            {
                "seed": trial.seed,
                "value": f"{measure} = {value_in_words(trial.values.get(measure), unit)}",
                "outcome": trial.outcome,
                "replay": trial.replay_command,
                "run": trial.run_command,
            }
            for trial in row.trials
        ],
        "tests": [{"id": test.test, "end": end_in_words(test)} for test in row.tests],
        "tests_summary": f"{counted(len(row.tests), 'test')}: "
        + ", ".join(f"{count} {end}" for end, count in counts.items()),
        "record": "" if row.record is None else record_in_words(row.record),
        "verdict": "differing" if row.verdict is None else row.verdict.value,
        "verdict_sign": _SIGNS[row.verdict],
        "verdict_words": verdict_in_words(row.verdict, row.causes),
        "tally": tally_in_words(row),
        "gap": row.has_gap,
        **common_attributes(requirement),
        "links": _listed_links(
            ("Contained in", [requirement.parent] if requirement.parent else []),
            ("Derived from", requirement.derived_from),
            ("Traces to", requirement.traces),
            ("Satisfied by", requirement.satisfied_by),
        ),
    }


def _listed_links(*links: tuple[str, Iterable[str]]) -> list[tuple[str, list[str]]]:
    return [(name, list(ids)) for name, ids in links if ids]


def _kind(element: Block | Behaviour) -> str:
    return f"block, {element.level.value}" if isinstance(element, Block) else element.kind.value.replace("_", " ")


def _cells(indices: Sequence[int], width: int, edge: int | None) -> list[dict[str, Any]]:
    cells = [{"linked": False, "classes": _classes(edge=column == edge)} for column in range(width)]
    for index in indices:
        cells[index] = {"linked": True, "classes": _classes(y=True, edge=index == edge)}
    return cells


def _classes(**classes: bool) -> str:
    return " ".join(name for name, applies in classes.items() if applies)
