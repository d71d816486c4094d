"""Findings about the payload bench: designs and scenes outside of the range in which it is validated."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rgss.documents import read_document
from rgss.evidence import Fidelity
from rgss.findings import Finding, Severity
from rgss.scenes import palm_fit
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project

if TYPE_CHECKING:
    from rgss.trials import TrialSpec

_BENCH_PAYLOAD = "trial.bench_payload_kg"


def bench_findings(project: Project) -> Iterator[Finding]:
    """Findings on the quantities of the study's designs that are outside the payload bench's validated range.

    An object too tall for the stated grasp has a finding of the scene. It is a warning where a measure takes the
    payload from the bench, and only noted where none does.
    """
    if project.study.fidelity is not Fidelity.CONTACT:
        return
    from rgss.trials.payload_bench import outside, payload_bench

    strange: dict[str, list[int]] = {}
    known: dict[object, tuple[str, ...]] = {}
    for spec in trial_specs(project, seeds=(project.study.seed,)):
        if _is_too_tall(spec):
            continue
        if spec.gripper not in known:
            known[spec.gripper] = outside(payload_bench(spec))
        for sentence in known[spec.gripper]:
            strange.setdefault(sentence, []).append(spec.variant)
    document = read_document(project.folder / project.study.label, label=project.study.label)
    is_measured = any(symbol.source == _BENCH_PAYLOAD for symbol in project.measures.inputs)
    for sentence, variants in strange.items():
        yield document.finding(
            "study.bench-range",
            f"the payload bench gives no answer for {variants_text(variants)}: {sentence}",
            ("design_space",),
            severity=Severity.WARNING if is_measured else Severity.INFO,
            hint="bench_payload_kg is then missing, and with it every measure that depends on it",
        )


def _is_too_tall(spec: TrialSpec) -> bool:
    fit = palm_fit(spec.gripper.geometry, spec.scene)
    return fit is not None and fit.top_m >= fit.palm_m


def variants_text(numbers: list[int]) -> str:
    """The variants of a finding as text."""
    if len(numbers) == 1:
        return f"variant {numbers[0]}"
    return f"{len(numbers)} variants, such as {numbers[0]}"
