"""Findings about the impact of closing fingers: designs whose impact the physics' step does not resolve."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rgss.documents import read_document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.studies.checks.bench_check import variants_text
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project


def impact_findings(project: Project) -> Iterator[Finding]:
    """Warn of designs whose fingers strike for less than the step resolves, where damage depends on it."""
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.trials import ClosingImpact, closing_impact

    unresolved: dict[ClosingImpact, list[int]] = {}
    for spec in trial_specs(project, seeds=(project.study.seed,)):
        impact = closing_impact(spec)
        if not impact.is_resolved:
            unresolved.setdefault(impact, []).append(spec.variant)
    document = read_document(project.folder / project.study.label, label=project.study.label)
    for impact, variants in unresolved.items():
        yield document.finding(
            "study.coarse-impact",
            f"the impact of a finger lasts {impact.duration_s * 1e3:.1f} ms, {impact.duration_s * impact.rate_hz:.1f} "
            f"steps, for {variants_text(variants)}: whether its force of up to {impact.greatest_n:.0f} N exceeds the "
            f"{impact.limit_n:g} N that the object bears depends on the step",
            ("physics", "rate"),
            severity=Severity.WARNING,
            hint=f"step at {10 * math.ceil(impact.least_rate_hz / 10 - 1e-9)} Hz or more",
        )
