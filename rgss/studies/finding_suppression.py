"""Suppression of findings that only follow from another one, until that one is resolved."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rgss.findings import Finding

_CONSEQUENCES: Mapping[str, tuple[str, ...]] = {
    # Of two things with one id, one may be what others look for in vain under its own.
    "requirements.duplicate-id": ("requirements.dangling-id",),
    "scene.duplicate-id": ("scene.unknown-body",),
    "design.duplicate-id": ("design.unknown-parameter", "design.unknown-role", "design.never-set", "design.unit"),
    "measures.duplicate-id": (
        "measures.unknown-symbol",
        "measures.unit",
        "measures.assumption",
        "measures.unsourced",
        "measures.equation",
        "measures.contribution",
        "measures.estimate",
        "measures.summary",
        "measures.cycle",
    ),
    "design.no-levels": ("design.never-set",),
    "design.sets": ("measures.source-unit",),
}
"""For each rule, those that may be broken only because it is."""


def without_consequences(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """The findings, each once and in order, without those that may only follow from another."""
    found = sorted(set(findings))
    rules = {finding.rule for finding in found}
    hidden = {rule for cause in rules for rule in _CONSEQUENCES.get(cause, ())}
    return tuple(finding for finding in found if finding.rule not in hidden)
