"""A traceability report, a chain and an impact as plain data for JSON.

Its schema is ``rgss/reports/schemas/trace.schema.json``; `SCHEMA` is the version in every document.
Unknown values are null; ids are those of the project's files.
"""

from __future__ import annotations

import json
from importlib import resources
from typing import Any

from rgss.measures import Estimate
from rgss.reports.trace.report import MatrixPart, TraceReport
from rgss.trace.evidence import RecordEvidence, TraceEvidence, TrialEvidence, VerificationRow
from rgss.trace.views import Chain, ChainStep, Impact

SCHEMA = "rgss-trace-1"
"""Name and version of the schema."""


def json_schema() -> dict[str, Any]:
    """The JSON Schema of every document of this module."""
    text = resources.files("rgss.reports").joinpath("schemas/trace.schema.json").read_text(encoding="utf-8")
    schema: dict[str, Any] = json.loads(text)
    return schema


def report_to_json(report: TraceReport, *, gaps_only: bool = False) -> dict[str, Any]:
    """A report as plain data.

    Args:
        report: The report.
        gaps_only: True to omit the matrices of links, and met requirements in the verification matrix.
    """
    return {
        "schema": SCHEMA,
        "document": "report",
        "title": report.title,
        "gaps_only": gaps_only,
        "evidence": _evidence(report.evidence),
        "coverage": [
            {
                "id": metric.id,
                "title": metric.title,
                "covered": metric.covered,
                "total": metric.total,
                "required": metric.required,
                "missing": list(metric.missing),
            }
            for metric in report.metrics
        ],
        "gaps": [
            {"id": gap.id, "lacks": list(gap.lacks), "metrics": [metric.id for metric in gap.metrics]}
            for gap in report.gaps
        ],
        "matrices": [] if gaps_only else [_matrix(part) for part in report.matrices],
        "verification": [_verification(row) for row in report.verification if row.has_gap or not gaps_only],
    }


def chain_to_json(chain: Chain) -> dict[str, Any]:
    """A chain as plain data."""
    return {
        "schema": SCHEMA,
        "document": "chain",
        "id": chain.id,
        "kind": chain.kind.value,
        "text": chain.text,
        "note": chain.note,
        "up": [_step(step) for step in chain.up],
        "down": [_step(step) for step in chain.down],
    }


def impact_to_json(impact: Impact) -> dict[str, Any]:
    """Impact of a change, as plain data."""
    return {
        "schema": SCHEMA,
        "document": "impact",
        "id": impact.id,
        "kind": impact.kind.value,
        "needs": list(impact.needs),
        "requirements": list(impact.requirements),
        "elements": list(impact.elements),
        "measures": list(impact.measures),
        "verdicts": [
            {
                "requirement": one.requirement,
                "verdict": None if one.verdict is None else one.verdict.value,
                "variants": one.variants,
            }
            for one in impact.verdicts
        ],
        "trials": list(impact.trials),
        "tests": list(impact.tests),
        "records": list(impact.records),
        "reviews": list(impact.reviews),
    }


def _evidence(evidence: TraceEvidence) -> dict[str, Any]:
    shown = evidence.shown
    return {
        "choice": evidence.choice,
        "variant": None if shown is None else shown.variant,
        "variants": evidence.variants,
        "missing_trials": None if shown is None else shown.missing,
        "trials": [] if shown is None else [_trial(trial) for trial in shown.trials],
    }


def _trial(trial: TrialEvidence) -> dict[str, Any]:
    return {
        "key": trial.key,
        "variant": trial.variant,
        "seed": trial.seed,
        "fidelity": trial.fidelity,
        "outcome": trial.outcome,
        "values": dict(trial.values),
        "metrics": {name: list(one) if isinstance(one, tuple) else one for name, one in trial.metrics.items()},
        "replay": trial.replay_command,
        "run": trial.run_command,
    }


def _matrix(part: MatrixPart) -> dict[str, Any]:
    matrix = part.matrix
    linked = zip(matrix.rows, matrix.linked, strict=True)
    return {
        "name": part.name,
        "title": part.title,
        "relation": part.relation,
        "rows": list(matrix.rows),
        "columns": list(matrix.columns),
        "columns_required": part.columns_required,
        "linked": {row: [matrix.columns[index] for index in indices] for row, indices in linked},
        "empty_rows": list(matrix.empty_rows),
        "empty_columns": list(matrix.empty_columns),
    }


def _verification(row: VerificationRow) -> dict[str, Any]:
    requirement = row.requirement
    return {
        "requirement": requirement.id,
        "text": requirement.text,
        "success_criterion": row.success,
        "method": None if requirement.verification is None else requirement.verification.value,
        "facility": requirement.facility or "",
        "phase": None if requirement.phase is None else requirement.phase.value,
        "document": row.document,
        "responsible": requirement.owner,
        "verdict": None if row.verdict is None else row.verdict.value,
        "stale_causes": [cause.value for cause in row.causes],
        "variant": row.variant,
        "measured": None if row.estimate is None else _estimate(row.estimate),
        "trials": [trial.key for trial in row.trials],
        "tests": [{"id": test.test, "end": None if test.end is None else test.end.value} for test in row.tests],
        "record": None if row.record is None else _record(row.record),
        "variants": {verdict.value: count for verdict, count in row.tally},
    }


def _record(found: RecordEvidence) -> dict[str, Any]:
    record = found.record
    return {
        "result": record.result.value,
        "by": record.by,
        "date": record.date,
        "note": record.note,
        "files": list(record.files),
        "stale_causes": [cause.value for cause in found.causes],
        "changed_files": list(found.changed),
    }


def _estimate(estimate: Estimate) -> dict[str, Any]:
    return {
        "value": estimate.value,
        "unit": estimate.unit,
        "low": estimate.low,
        "high": estimate.high,
        "n": estimate.n,
    }


def _step(step: ChainStep) -> dict[str, Any]:
    return {
        "depth": step.depth,
        "relation": step.relation.value,
        "id": step.id,
        "kind": step.kind.value,
        "text": step.text,
        "note": step.note,
        "repeated": step.repeated,
    }
