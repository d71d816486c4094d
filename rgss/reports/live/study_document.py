"""JSON document of a study while its sweep runs: progress, decision so far, verdicts, failures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.decision import ScreeningResult, screening_summary
from rgss.decision.study_decision import StudyDecision
from rgss.evidence import TrialRecord
from rgss.measures import Verdict
from rgss.reports.decision import (
    cautions,
    certificate_sentence,
    headline,
    model_cautions,
    reasons,
    rule_sentence,
    stale_sentence,
    standing_sentence,
)
from rgss.studies import Project

MOST_VARIANTS = 400
"""Most variants that the page lists; of more, it shows counts."""

MOST_FAILURES = 200
"""Most failed trials that the page lists; of more, it shows counts of the kinds."""


def live_study_document(
    project: Project,
    measured: Sequence[VariantMeasures],
    made: StudyDecision | None,
    *,
    problem: str,
    screened: ScreeningResult | None = None,
    replayable: bool = False,
) -> dict[str, Any]:
    """State of the study by the evidence so far.

    Args:
        project: The project with its study.
        measured: Every variant with its verdicts.
        made: The decision among the variants with all their trials; None if there is none.
        problem: Why there is no decision; empty if there is one.
        screened: The outcome of screening; None without.
        replayable: Whether the server replays trials.
    """
    requirements = requirements_with_criteria(project)
    return {
        "progress": _progress(project, measured, screened),
        "decision": _decision(project, measured, made, problem),
        "requirements": [
            {"id": one.id, "text": one.text, "counts": _counts(entry.verdicts[one.id] for entry in measured)}
            for one in requirements
        ],
        "variants": [_variant(entry) for entry in measured[:MOST_VARIANTS]],
        "more_variants": max(0, len(measured) - MOST_VARIANTS),
        **_failures((record for entry in measured for record in entry.records), replayable=replayable),
    }


def _progress(
    project: Project, measured: Sequence[VariantMeasures], screened: ScreeningResult | None
) -> dict[str, Any]:
    done = sum(len(entry.records) for entry in measured)
    planned = done + sum(entry.missing for entry in measured)
    failed = sum(not record.success for entry in measured for record in entry.records)
    notes = [] if screened is None else [screening_summary(screened)]
    if project.study.is_sequential:
        notes.append("A sweep until decided may add trials.")
    outdated = sum(entry.outdated for entry in measured)
    if outdated:
        notes.append(f"{outdated} of the missing trials have evidence of an earlier model, code or engine.")
    return {
        "done": done,
        "planned": planned,
        "failed": failed,
        "sentence": f"{done} of {planned} trials have evidence; in {failed} of them the task failed.",
        "notes": notes,
    }


def _decision(
    project: Project, measured: Sequence[VariantMeasures], made: StudyDecision | None, problem: str
) -> dict[str, Any]:
    missing = sum(entry.missing for entry in measured)
    whole = sum(not entry.missing for entry in measured)
    done = sum(len(entry.records) for entry in measured)
    among = f"As of {done} trials, decided among {whole} of {len(measured)} variants."
    if made is None:
        standing = f"{whole} of {len(measured)} variants have all their trials."
    elif missing:
        standing = f"Not final. {among}"
    elif project.study.is_sequential:
        standing = f"{among} A sweep until decided may add trials where the choice is open."
    else:
        standing = f"{among} Every trial has evidence. 'rgss trade' and 'rgss report' analyse how sure the decision is."
    found: dict[str, Any] = {"standing": standing, "problem": problem, "is_complete": made is not None and not missing}
    if made is None:
        return found | {"headline": "There is no decision yet.", "lines": [], "why": [], "cautions": []}
    lines = (
        standing_sentence(made),
        stale_sentence(made),
        rule_sentence(made),
        certificate_sentence(made.decision.certificate),
    )
    return found | {
        "headline": headline(made),
        "lines": [line for line in lines if line],
        "why": [one.text for one in reasons(made)] if made.comparison is not None else [],
        "cautions": list(model_cautions(made) if made.decision.chosen is None else cautions(made)),
    }


def _counts(verdicts: Iterable[Verdict]) -> dict[str, int]:
    counts = Counter(verdicts)
    return {verdict.value: counts[verdict] for verdict in Verdict}


def _variant(entry: VariantMeasures) -> dict[str, Any]:
    return {
        "id": entry.variant.id,
        "done": len(entry.records),
        "failed": sum(not record.success for record in entry.records),
        "missing": entry.missing,
        "verdicts": _counts(entry.verdicts.values()),
        "not_met": [name for name, verdict in entry.verdicts.items() if verdict is Verdict.NOT_MET],
    }


def _failures(records: Iterable[TrialRecord], *, replayable: bool) -> dict[str, Any]:
    failed = [record for record in records if not record.success]
    return {
        "failures": list(_named(failed[:MOST_FAILURES])),
        "more_failures": max(0, len(failed) - MOST_FAILURES),
        "replayable": replayable,
    }


def _named(failed: Iterable[TrialRecord]) -> Iterator[dict[str, Any]]:
    for record in failed:
        yield {
            "trial": f"{record.variant}/{record.seed}",
            "failure": _words(record.failure.value if record.failure else ""),
            "phase": _words(str(record.failed_phase or "")),
            "detail": record.failure_detail,
        }


def _words(name: str) -> str:
    return name.replace("_", " ").lower()
