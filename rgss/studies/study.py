"""A study: which designs, in which scene, how often, how simulated, how compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path, PurePath

from rgss.documents import Document, FilePlace, load_document, place_of
from rgss.errors import DocumentError
from rgss.evidence import Fidelity
from rgss.findings import Finding, shown
from rgss.measures import MeasureSet
from rgss.physics import PhysicsSettings
from rgss.requirements import RequirementSet, load_requirements
from rgss.scenes.uncertainty import (
    NOTHING_UNCERTAIN,
    ONE_WORKLOAD,
    Uncertainty,
    Workload,
    read_uncertainty,
    read_workload,
)
from rgss.studies.assumptions_section import StudyAssumption, read_assumptions
from rgss.studies.document import StudyDocument
from rgss.studies.motion import (
    MotionChoice,
    PadCompliance,
    pads_of,
    physics_findings,
    read_motion,
    step_control_findings,
)
from rgss.studies.planning import PlanningChoice, read_moves, read_planning
from rgss.studies.project_folders import folder_problem, normal_folder
from rgss.studies.promotion import Screening, read_screening
from rgss.studies.regression import RegressionGuard, read_regression
from rgss.studies.scene_task import task_of_scene
from rgss.studies.trade_off import TradeOff, TradeOffPlaces, read_trade_off
from rgss.studies.until_section import read_until_decided
from rgss.tasks import LoadedTask, TaskProgram, default_task, load_task
from rgss.tradeoff import Anchor
from rgss.tradeoff.sequential import SequentialRule


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueAnchors:
    """Ends of a value function, in the measure's unit.

    Attributes:
        measure: The measure.
        weight: Its share of the value, in the whole.
        worst: The quantity worth 0; of a target, what is too low.
        best: The quantity worth 1.
        too_high: Of a target, what is worth 0 above it; None for other values.
    """

    measure: str
    weight: float
    worst: float
    best: float
    too_high: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyDefinition:
    """Definition of a study.

    Attributes:
        id: Its name.
        label: Its file, relative to the project.
        requirements: The folder of the requirements that it verifies, relative to the project.
        design_space: The design-space file, relative to the project, as are the next two.
        catalogue: The catalogue file.
        scene: The scene file.
        seed: The master seed: replicate r of every variant has the seed ``seed + r``.
        replicates: Trials of each variant.
        fidelity: Fidelity of the trials that decide.
        planning: Planning of moves.
        rate_hz: Physics steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        pads: Compliance of the fingers' pads.
        values: Value function of each measure, with requirements' thresholds put in.
        trade_off: Comparison of designs.
        screening: The trials that come first, and which designs go on from them; None if all do.
        regression: Metrics that are guarded against a baseline; None if none are.
        until_decided: Stopping rule of replication until decided.
        is_sequential: Whether the file states that rule, so that variants may have more replicates than `replicates`.
        uncertainty: Uncertainty from trial to trial; replaces that of the scene for the same quantities.
        workload: The objects that the trials carry.
        is_nominal: Whether neither is applied, nor the scene's uncertainty.
        assumptions: Assumptions that are questioned, with what they could be taken as instead.
        physics: Other physics settings than rate and iterations of the file, for a confirmation; None for the file's.
        motion: Timing of moves and control of joints.
    """

    id: str
    label: str
    requirements: str
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
    is_sequential: bool = False
    uncertainty: Uncertainty = NOTHING_UNCERTAIN
    workload: Workload = ONE_WORKLOAD
    is_nominal: bool = False
    physics: PhysicsSettings | None = None
    pads: PadCompliance = field(default_factory=PadCompliance)
    assumptions: tuple[StudyAssumption, ...] = ()
    motion: MotionChoice = field(default_factory=MotionChoice)
    task: TaskProgram = field(default_factory=default_task)
    task_file: LoadedTask | None = None

    @property
    def seeds(self) -> tuple[int, ...]:
        """The seed of each replicate, the same for every variant."""
        return tuple(range(self.seed, self.seed + self.replicates))

    @property
    def sweeps_until_decided(self) -> bool:
        """True if a sweep goes on until decided of itself: the rule is stated, and so is what it may spend."""
        return self.is_sequential and self.until_decided.budget is not None


# long function: one section of the file after the other, in its order.
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
            and then its use of them is not checked.
        project: The project's folder, which the files that it names are relative to.
        label: The file's name in messages.
        requirements: The requirements that it verifies; read from their folder if the file names one and
            they are not given.

    Raises:
        DocumentError: The file is wrong; with every problem in it.
    """
    loaded = load_document(path, StudyDocument, label=label)
    entry, document = loaded.value, loaded.document
    findings = _file_findings(document, entry, project)
    findings.extend(physics_findings(entry.physics, document, fidelities=entry.fidelity))
    motion = read_motion(entry.timing, entry.control, document, findings, rate_hz=entry.physics.rate)
    screening = read_screening(entry.fidelity, entry.promotion, document, findings, clock=entry.planning.clock)
    loaded_task = _task(project, entry, findings)
    if loaded_task is not None:
        findings.extend(step_control_findings(loaded_task, motion.controller, rate_hz=entry.physics.rate))
    program = default_task() if loaded_task is None else loaded_task.program
    moves = read_moves(entry.moves, program, document, findings)
    planning = read_planning(entry.planning, document, findings, moves=moves)
    regression = read_regression(entry.regression, document, findings, phases=program.phases)
    until_decided = read_until_decided(entry.until_decided, document, findings, replicates=entry.replicates)
    uncertainty = read_uncertainty(entry.uncertainty, entry.correlations, document, findings)
    workload = read_workload(entry.workload, document, findings)
    places = TradeOffPlaces(
        document,
        measures,
        lambda: _requirements(project / entry.requirements) if requirements is None else requirements,
    )
    trade_off = read_trade_off(entry.trade_off, places)
    findings.extend(places.findings)
    if findings or trade_off is None or planning is None:
        raise DocumentError(sorted(findings))
    return StudyDefinition(
        id=entry.study,
        label=label,
        requirements=normal_folder(entry.requirements),
        design_space=entry.design_space,
        catalogue=entry.catalogue,
        scene=entry.scene,
        seed=entry.seed,
        replicates=entry.replicates,
        fidelity=Fidelity(entry.fidelity[-1]),
        planning=planning,
        task=program,
        task_file=loaded_task,
        motion=motion,
        rate_hz=entry.physics.rate,
        solver_iterations=entry.physics.solver_iterations,
        pads=pads_of(entry.physics),
        values=value_anchors(trade_off, places.quantity_of),
        trade_off=trade_off,
        screening=screening,
        regression=regression,
        until_decided=until_decided,
        is_sequential=entry.until_decided is not None,
        uncertainty=uncertainty,
        workload=workload,
        is_nominal=entry.nominal,
        assumptions=read_assumptions(entry.assumptions, document),
    )


def named_file(project: Path, name: str) -> Path | None:
    """The file of a name that is relative to a project; None if it is not there or lies outside.

    Args:
        project: The project's folder.
        name: The name, as a user wrote it.
    """
    return (project / name).resolve() if place_of(project / name, project) is FilePlace.INSIDE else None


def _file_findings(document: Document, entry: StudyDocument, project: Path) -> list[Finding]:
    findings = []
    problem = folder_problem(project, entry.requirements)
    if problem is not None:
        findings.append(document.finding("study.requirements", problem[0], ("requirements",), hint=problem[1]))
    named = {"design_space": entry.design_space, "catalogue": entry.catalogue, "scene": entry.scene}
    if entry.task is not None:
        named["task"] = entry.task
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


def _requirements(folder: Path) -> RequirementSet | None:
    """The requirements of a folder; None if they cannot be read, which has its own finding."""
    try:
        return load_requirements(folder)
    except DocumentError:
        return None


def _task(project: Path, entry: StudyDocument, findings: list[Finding]) -> LoadedTask | None:
    """The task that a study names, or else its scene; None if neither does, or with what is wrong noted."""
    name = entry.task or task_of_scene(project, entry.scene, findings)
    path = None if name is None else named_file(project, name)
    if path is None:
        return None
    try:
        return load_task(path, label=name)
    except DocumentError as error:
        findings.extend(error.findings)
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
            too_high=quantity_of(valued.anchors["too_high"], valued.measure) if "too_high" in valued.anchors else None,
        )
        for valued in trade_off.valued
    )
