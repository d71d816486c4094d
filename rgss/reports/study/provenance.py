"""Provenance of a report: assumptions with their reasons, files, versions, the evidence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.assessment import VariantMeasures, sequential_seeds
from rgss.documents import load_document
from rgss.errors import DocumentError
from rgss.evidence import EvidenceStore, Fidelity
from rgss.evidence.records import file_digests
from rgss.figures import exact_figure
from rgss.motion import ClockKind
from rgss.reports.plain_numbers import Plain
from rgss.studies import FOLDERS, Project, StudyDocument, trial_specs
from rgss.trials.code import versions


def provenance_of(
    project: Project, measured: Sequence[VariantMeasures], store: EvidenceStore, *, evidence: str
) -> Plain:
    """Provenance of the figures; independent of time and machine.

    Args:
        project: The project with its study.
        measured: Every variant with its trials.
        store: The evidence.
        evidence: Its name in messages.

    Raises:
        EvidenceError: The store is damaged, or an input file cannot be read.
    """
    study = project.study
    keys = [key for entry in measured for key in entry.trials]
    first = store.get(min(keys)) if keys else None
    planning = study.planning.settings
    return {
        "study": [
            ["study", study.id],
            ["file", study.label],
            ["design space", study.design_space],
            ["catalogue", study.catalogue],
            ["scene", study.scene],
            ["fidelity", study.fidelity.value],
            *_control(project),
            ["seeds", _seeds(project, measured)],
            ["variants", str(len(measured))],
            ["trials", str(len(keys))],
            ["planning clock", "counted checks" if planning.clock.kind is ClockKind.COUNTED else "wall"],
            ["charge for a check", f"{planning.clock.charge_s * 1e3:g} ms"],
            ["simplification limit", f"{planning.simplification_limit_s:g} s"],
            ["clearance", f"{planning.clearance_m * 1e3:g} mm"],
            *([] if study.fidelity is Fidelity.KINEMATIC else [["physics steps", f"{study.rate_hz:g} Hz"]]),
            ["evidence", evidence],
        ],
        "files": sorted(file_digests(project.folder, FOLDERS).items()),
        "versions": sorted(versions().items()),
        "made_on": "" if first is None else first.provenance.machine,
        "made_by": "" if first is None else first.provenance.revision,
    }


def _control(project: Project) -> list[list[str]]:
    """The control of the joints if it is simulated, and the source of its calibration: each that a design has."""
    fidelity, in_contact = project.study.fidelity, project.study.motion.controller.in_contact
    if fidelity is not Fidelity.DYNAMIC and not (fidelity is Fidelity.CONTACT and in_contact):
        return []
    specs = trial_specs(project, seeds=[project.study.seed])
    return [["control of the joints", ", ".join(dict.fromkeys(spec.settings.controller.origin for spec in specs))]]


def _seeds(project: Project, measured: Sequence[VariantMeasures]) -> str:
    groups = sequential_seeds(project, measured)
    if groups:
        return "; ".join(f"{one.first} to {one.last} of {len(one.variants)} variants" for one in groups)
    seeds = project.study.seeds
    return ", ".join(map(str, seeds[:20])) + (" …" if len(seeds) > 20 else "")


def assumptions_of(project: Project) -> list[Plain]:
    """Every assumption of the project with its reason: of the study, the measures, the designs, the catalogue."""
    return [{"where": where, "about": about, "why": why} for where, about, why in _assumptions(project)]


def _assumptions(project: Project) -> Iterator[tuple[str, str, str]]:
    try:
        study = load_document(project.folder / project.study.label, StudyDocument, label=project.study.label).value
    except (DocumentError, OSError):
        # The project was read from it, so that it must have changed since then.
        study = None
    for entry in () if study is None else study.assumptions:
        yield project.study.label, entry.about, entry.rationale
    for one in project.measures.assumptions:
        yield "measures", f"{one.statement} ({', '.join(one.concerns)})", one.rationale
    for parameter in project.designs.parameters:
        if parameter.assumption:
            yield project.study.design_space, f"{parameter.id} {parameter.name}", parameter.assumption
    for component in project.designs.catalogue.components:
        for name, rationale in component.assumptions.items():
            value = component.cost if name == "cost" else component.properties[name]
            yield (
                project.study.catalogue,
                f"{component.id}.{name} = {exact_figure(value.value)} {value.unit}",
                rationale,
            )
