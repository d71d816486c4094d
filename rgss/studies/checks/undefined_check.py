"""Findings about measures whose expression has no value for the designs."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.designs import sources
from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.measures import undefined_measures
from rgss.studies.project import Project
from rgss.studies.project_folders import measures_of

_NAMED = 4
_HINT = "look for a division by zero or the root of a negative number"


def undefined_findings(project: Project) -> Iterator[Finding]:
    """Report measures that are undefined for a design, and warn of those of trials that are for every design.

    A measure that follows from the design is needed of every design: every page refuses the study without it. One of
    trials may be undefined for some, such as a property of grippers with three fingers.
    """
    variants = project.designs.expand()
    lacking: dict[str, list[int]] = {}
    for variant in variants:
        for name in undefined_measures(project.measures, fixed=sources(variant)):
            lacking.setdefault(name, []).append(variant.id)
    label = measures_of(project.study.requirements)
    for index, measure in enumerate(project.measures.measures):
        ids = lacking.get(measure.id, [])
        is_everywhere = len(ids) == len(variants)
        if not ids or (measure.from_trials and not is_everywhere):
            continue
        named = f"{', '.join(map(str, ids[:_NAMED]))}{' …' if len(ids) > _NAMED else ''}"
        which = "any design" if is_everywhere else f"{len(ids)} of {len(variants)} designs ({named})"
        yield read_document(project.folder / label, label=label).finding(
            "measures.undefined",
            f"measure {measure.id!r} is not defined for {which}: {measure.expression.text}",
            ("measures", index, "expression"),
            severity=Severity.WARNING if measure.from_trials else Severity.ERROR,
            hint=_HINT,
        )
