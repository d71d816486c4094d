"""A study: which designs, in which scene, how often, how simulated, how compared."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path, PurePath

from rgss.documents import Document, FilePlace, load_document, place_of
from rgss.errors import DocumentError
from rgss.evidence import PLANNED_PHASES, Fidelity
from rgss.findings import Finding, shown
from rgss.measures import MeasureSet
from rgss.physics import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ
from rgss.requirements import RequirementSet, load_requirements
from rgss.studies.document import StudyDocument
from rgss.studies.promotion import Screening, read_screening
from rgss.studies.regression_section import RegressionGuard, read_regression
from rgss.studies.trade_off import TradeOff, TradeOffPlaces, read_trade_off
from rgss.studies.until_section import read_until_decided
from rgss.tradeoff import Anchor
from rgss.tradeoff.sequential import SequentialRule
from rgss.trials import MoveKind


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningChoice:
    """How moves are planned.

    Attributes:
        counted: Whether planning time is counted in validity checks; a wall clock otherwise.
        charge_per_check_s: Planning time that a validity check is charged with.
        resolution_rad: Greatest joint step between two checked states.
        simplification_checks: Validity checks that may be spent on looking for shortcuts.
        simplification_limit_s: Longest time of simplifying a path by the planning clock.
        clearance_m: Distance that planned paths keep from everything.
        planner: The planner where no design sets it; empty if the file has none.
        time_limit_s: Longest planning time of one move where no design sets it; None if the file has none.
        moves: Kind of each of the moves of `PLANNED_PHASES`.
    """

    counted: bool
    charge_per_check_s: float
    resolution_rad: float
    simplification_checks: int
    simplification_limit_s: float
    clearance_m: float
    planner: str = ""
    time_limit_s: float | None = None
    moves: tuple[MoveKind, ...] = (MoveKind.PLANNED,) * len(PLANNED_PHASES)


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueAnchors:
    """Ends of a value function, in the measure's unit.

    Attributes:
        measure: The measure.
        weight: Its share of the value, in the whole.
        worst: The quantity worth 0; of a target, what is too low.
        best: The quantity worth 1.
    """

    measure: str
    weight: float
    worst: float
    best: float


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyDefinition:
    """A study as its file says.

    Attributes:
        id: Its name.
        label: Its file, relative to the project.
        design_space: The design-space file, relative to the project, as are the next two.
        catalogue: The catalogue file.
        scene: The scene file.
        seed: The master seed: replicate r of every variant has the seed ``seed + r``.
        replicates: Trials of each variant.
        fidelity: How much physics a trial has that decides.
        planning: How moves are planned.
        rate_hz: Physics steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        values: What each measure is worth, with requirements' thresholds put in.
        trade_off: How designs are compared.
        screening: The trials that come first, and which designs go on from them; None if all do.
        regression: Which metrics are guarded against a baseline; None if none are.
        until_decided: When replication until decided goes on, and when it stops.
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
    trade_off: TradeOff
    screening: Screening | None = None
    regression: RegressionGuard | None = None
    until_decided: SequentialRule = field(default_factory=SequentialRule)

    @property
    def seeds(self) -> tuple[int, ...]:
        """The seed of each replicate, the same for every variant."""
        return tuple(range(self.seed, self.seed + self.replicates))


def read_study(
    path: Path,
    measures: MeasureSet | None,
    *,
    project: Path,
    label: str,
    requirements: RequirementSet | None = None,
) -> StudyDefinition:
    """Read a study.

    Args:
        path: The file.
        measures: The project's measures, which the file names; None if they could not be read,
            and then what it says of them is not looked at.
        project: The project's folder, which the files that it names are relative to.
        label: The file's name in messages.
        requirements: The project's requirements; read from its folder if the file names one and
            they are not given.

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
        ("time_limit", entry.planning.time_limit),
    ):
        if value is not None and value <= 0:
            findings.append(_not_positive(document, ("planning", key)))
    if entry.planning.clearance < 0:
        findings.append(document.finding("study.negative", "clearance must not be negative", ("planning", "clearance")))
    if entry.planning.simplification_limit < 0:
        message = "simplification_limit must not be negative"
        findings.append(document.finding("study.negative", message, ("planning", "simplification_limit")))
    if entry.physics.rate <= 0:
        findings.append(_not_positive(document, ("physics", "rate")))
    elif "contact" in entry.fidelity:
        findings.extend(_coarse_contact(entry, document))
    screening = read_screening(entry, document, findings)
    regression = read_regression(entry.regression, document, findings)
    until_decided = read_until_decided(entry.until_decided, document, findings)
    places = TradeOffPlaces(
        document, measures, lambda: _requirements(project) if requirements is None else requirements
    )
    trade_off = read_trade_off(entry.trade_off, places)
    findings.extend(places.findings)
    if findings or trade_off is None:
        raise DocumentError(sorted(findings))
    return StudyDefinition(
        id=entry.study,
        label=label,
        design_space=entry.design_space,
        catalogue=entry.catalogue,
        scene=entry.scene,
        seed=entry.seed,
        replicates=entry.replicates,
        fidelity=Fidelity(entry.fidelity[-1]),
        planning=_planning_choice(entry),
        rate_hz=entry.physics.rate,
        solver_iterations=entry.physics.solver_iterations,
        values=value_anchors(trade_off, places.quantity_of),
        trade_off=trade_off,
        screening=screening,
        regression=regression,
        until_decided=until_decided,
    )


def _planning_choice(entry: StudyDocument) -> PlanningChoice:
    planning = entry.planning
    return PlanningChoice(
        counted=planning.clock == "counted",
        charge_per_check_s=planning.charge_per_check,
        resolution_rad=planning.resolution,
        simplification_checks=planning.simplification_checks,
        simplification_limit_s=planning.simplification_limit,
        clearance_m=planning.clearance,
        planner=planning.planner or "",
        time_limit_s=planning.time_limit,
        moves=tuple(MoveKind(getattr(entry.moves, phase.value)) for phase in PLANNED_PHASES),
    )


def named_file(project: Path, name: str) -> Path | None:
    """The file of a name that is relative to a project; None if it is not there or lies outside.

    Args:
        project: The project's folder.
        name: The name, as a user wrote it.
    """
    return (project / name).resolve() if place_of(project / name, project) is FilePlace.INSIDE else None


def _file_findings(document: Document, named: Mapping[str, str], project: Path) -> list[Finding]:
    findings = []
    for key, name in named.items():
        place = place_of(project / name, project)
        if PurePath(name).is_absolute() or ".." in PurePath(name).parts or place is FilePlace.OUTSIDE:
            findings.append(
                document.finding(
                    "study.outside", f"{shown(name)} lies outside the project", (key,), hint="name a file in it"
                )
            )
        elif place is FilePlace.MISSING:
            findings.append(
                document.finding(
                    "study.missing-file",
                    f"there is no file {shown(name)}",
                    (key,),
                    hint="file names are relative to the project",
                )
            )
    return findings


def _requirements(project: Path) -> RequirementSet | None:
    """The project's requirements; None if they cannot be read, which is told where they are."""
    try:
        return load_requirements(project / "requirements")
    except DocumentError:
        return None


def value_anchors(trade_off: TradeOff, quantity_of: Callable[[Anchor, str], float]) -> tuple[ValueAnchors, ...]:
    """The ends of the value function of every measure, in the order of the file.

    Args:
        trade_off: The trade-off.
        quantity_of: Quantity of an anchor, in the unit of a measure.
    """
    weights = trade_off.weighting.weights
    return tuple(
        ValueAnchors(
            measure=valued.measure,
            weight=weights[valued.measure],
            worst=quantity_of(valued.worst_anchor, valued.measure),
            best=quantity_of(valued.best_anchor, valued.measure),
        )
        for valued in trade_off.valued
    )


def _coarse_contact(entry: StudyDocument, document: Document) -> list[Finding]:
    """What is too coarse of the physics for a grasp; docs/validation.md shows from where results converge."""
    rate_hz, iterations = entry.physics.rate, entry.physics.solver_iterations
    if rate_hz < LEAST_RATE_HZ:
        message = f"contact physics needs at least {LEAST_RATE_HZ:g} Hz, got {rate_hz:g} Hz"
        return [document.finding("study.coarse-physics", message, ("physics", "rate"), hint="240 Hz is validated")]
    if rate_hz * iterations < LEAST_ITERATIONS_HZ:
        least = math.ceil(LEAST_ITERATIONS_HZ / rate_hz)
        message = f"contact physics at {rate_hz:g} Hz needs at least {least} solver iterations, got {iterations}"
        hint = "20 are validated" if least <= 20 else f"give {least} or more"
        return [document.finding("study.coarse-physics", message, ("physics", "solver_iterations"), hint=hint)]
    return []


def _not_positive(document: Document, location: tuple[str, str]) -> Finding:
    return document.finding("study.not-positive", f"{location[1]} must be greater than zero", location)
