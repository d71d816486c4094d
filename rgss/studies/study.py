"""A study: which designs, in which scene, how often, how simulated, how compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePath

from rgss.documents import Document, load_document
from rgss.errors import DocumentError, QuantityError, TradeoffError
from rgss.evidence import Fidelity
from rgss.findings import Finding, shown
from rgss.measures import MeasureSet
from rgss.quantities import parse_quantity
from rgss.studies.document import StudyDocument, ValueEntry
from rgss.tradeoff import ValueFunction, Weighting


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningChoice:
    """How moves are planned.

    Attributes:
        counted: Whether planning time is counted in validity checks; a wall clock otherwise.
        charge_per_check_s: Planning time that a validity check is charged with.
        resolution_rad: Greatest joint step between two checked states.
        simplification_checks: Validity checks that may be spent on shortening a path.
        clearance_m: Distance that planned paths keep from everything.
    """

    counted: bool
    charge_per_check_s: float
    resolution_rad: float
    simplification_checks: int
    clearance_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueAnchors:
    """What a measure is worth in the comparison, in the measure's unit.

    Attributes:
        measure: The measure.
        weight: Its share of the value.
        worst: The quantity worth 0.
        best: The quantity worth 1.
    """

    measure: str
    weight: float
    worst: float
    best: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Study:
    """A study as its file says.

    Attributes:
        id: Its name.
        label: Its file, relative to the project.
        design_space: The design-space file, relative to the project, as are the next two.
        catalogue: The catalogue file.
        scene: The scene file.
        seed: The master seed: replicate r of every variant has the seed ``seed + r``.
        replicates: Trials of each variant.
        fidelity: How much physics a trial has.
        planning: How moves are planned.
        rate_hz: Physics steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        values: What each measure is worth.
    """

    id: str
    label: str
    design_space: str
    catalogue: str
    scene: str
    seed: int
    replicates: int
    fidelity: Fidelity
    planning: PlanningChoice
    rate_hz: float
    solver_iterations: int
    values: tuple[ValueAnchors, ...]

    @property
    def seeds(self) -> tuple[int, ...]:
        """The seed of each replicate, the same for every variant."""
        return tuple(range(self.seed, self.seed + self.replicates))


def read_study(path: Path, measures: MeasureSet | None, *, project: Path, label: str) -> Study:
    """Read a study.

    Args:
        path: The file.
        measures: The project's measures, which the file names; None if they could not be read,
            and then what it says of them is not looked at.
        project: The project's folder, which the files that it names are relative to.
        label: The file's name in messages.

    Raises:
        DocumentError: The file is wrong; with every problem in it.
    """
    loaded = load_document(path, StudyDocument, label=label)
    entry, document = loaded.value, loaded.document
    findings = list(
        _file_findings(
            document, {"design_space": entry.design_space, "catalogue": entry.catalogue, "scene": entry.scene}, project
        )
    )
    for key, value in (
        ("charge_per_check", entry.planning.charge_per_check),
        ("resolution", entry.planning.resolution),
    ):
        if value <= 0:
            findings.append(_not_positive(document, ("planning", key)))
    if entry.planning.clearance < 0:
        findings.append(document.finding("study.negative", "clearance must not be negative", ("planning", "clearance")))
    if entry.physics.rate <= 0:
        findings.append(_not_positive(document, ("physics", "rate")))
    values: list[ValueAnchors] = []
    if measures is not None:
        units = {measure.id: measure.unit for measure in measures.measures}
        for index, valued in enumerate(entry.trade_off.values):
            values.extend(_anchors(document, index, valued, units, findings))
    findings.extend(_repeated(document, entry.trade_off.values))
    findings.extend(_weight_findings(document, entry.trade_off.values))
    if findings:
        raise DocumentError(sorted(findings))
    planning = entry.planning
    return Study(
        id=entry.study,
        label=label,
        design_space=entry.design_space,
        catalogue=entry.catalogue,
        scene=entry.scene,
        seed=entry.seed,
        replicates=entry.replicates,
        fidelity=Fidelity(entry.fidelity),
        planning=PlanningChoice(
            counted=planning.clock == "counted",
            charge_per_check_s=planning.charge_per_check,
            resolution_rad=planning.resolution,
            simplification_checks=planning.simplification_checks,
            clearance_m=planning.clearance,
        ),
        rate_hz=entry.physics.rate,
        solver_iterations=entry.physics.solver_iterations,
        values=tuple(values),
    )


def named_file(project: Path, name: str) -> Path | None:
    """The file of a name that is relative to a project; None if it is not there or lies outside.

    Args:
        project: The project's folder.
        name: The name, as a user wrote it.
    """
    try:
        target = (project / name).resolve()
        inside = target.is_relative_to(project.resolve())
        return target if inside and target.is_file() else None
    except (OSError, ValueError):  # a name that is too long, one with a null character
        return None


def _file_findings(document: Document, named: Mapping[str, str], project: Path) -> list[Finding]:
    findings = []
    for key, name in named.items():
        if PurePath(name).is_absolute() or ".." in PurePath(name).parts:
            findings.append(
                document.finding(
                    "study.outside", f"{shown(name)} lies outside the project", (key,), hint="name a file in it"
                )
            )
        elif named_file(project, name) is None:
            findings.append(
                document.finding(
                    "study.missing-file",
                    f"there is no file {shown(name)}",
                    (key,),
                    hint="file names are relative to the project",
                )
            )
    return findings


def _anchors(
    document: Document, index: int, entry: ValueEntry, units: Mapping[str, str], findings: list[Finding]
) -> list[ValueAnchors]:
    where = ("trade_off", "values", index)
    if entry.measure not in units:
        findings.append(
            document.finding(
                "study.unknown-measure",
                f"no measure {entry.measure!r} is defined",
                (*where, "measure"),
                hint=f"measures: {', '.join(units)}",
            )
        )
        return []
    ends = [
        _end(document, text, units[entry.measure], (*where, key), findings)
        for key, text in (("worst", entry.worst), ("best", entry.best))
    ]
    worst, best = ends
    if worst is None or best is None:
        return []
    try:
        ValueFunction(measure=entry.measure, worst=worst, best=best)
    except TradeoffError as error:
        findings.append(document.finding("study.value", error.message, (*where, "best"), hint=error.hint))
    return [ValueAnchors(measure=entry.measure, weight=entry.weight, worst=worst, best=best)]


def _end(
    document: Document,
    text: str | float,
    unit: str,
    where: tuple[str | int, ...],
    findings: list[Finding],
) -> float | None:
    try:
        return parse_quantity(str(text), unit)
    except QuantityError as error:
        findings.append(document.finding("study.quantity", error.message, where, hint=error.hint))
        return None


def _repeated(document: Document, entries: tuple[ValueEntry, ...]) -> list[Finding]:
    seen: set[str] = set()
    findings = []
    for index, entry in enumerate(entries):
        if entry.measure in seen:
            findings.append(
                document.finding(
                    "study.repeated",
                    f"measure {entry.measure!r} is valued twice",
                    ("trade_off", "values", index, "measure"),
                    hint="keep one",
                )
            )
        seen.add(entry.measure)
    return findings


def _weight_findings(document: Document, entries: tuple[ValueEntry, ...]) -> list[Finding]:
    """What is wrong with the weights; those of a measure that is valued twice are not summed."""
    weights = {entry.measure: entry.weight for entry in entries}
    if len(weights) < len(entries):
        return []
    try:
        Weighting(weights=weights)
    except TradeoffError as error:
        index = next((index for index, entry in enumerate(entries) if not entry.weight >= 0.0), None)
        at = ("trade_off", "values") if index is None else ("trade_off", "values", index, "weight")
        return [document.finding("study.weights", error.message, at, hint=error.hint)]
    return []


def _not_positive(document: Document, location: tuple[str, str]) -> Finding:
    return document.finding("study.not-positive", f"{location[1]} must be greater than zero", location)
