"""A project: the folder with requirements, designs, scenes and studies, read and checked as a whole."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

from rgss.designs import DesignSpace, DesignVariant, load_catalogue, load_design_space
from rgss.documents import read_document
from rgss.errors import DefinitionError, DocumentError
from rgss.evidence import Fidelity
from rgss.findings import Finding
from rgss.measures import MeasureSet, load_measures
from rgss.quantities import same_dimension
from rgss.requirements import RequirementSet, load_requirements
from rgss.scenes import GripperFile, Scene, load_gripper_file, load_scene
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN, ONE_WORKLOAD, Uncertainty, Workload
from rgss.studies.arms import ARM, scene_with_arm, scenes_by_arm
from rgss.studies.component_files import component_files
from rgss.studies.design_settings import GRIPPER, design_findings
from rgss.studies.finding_suppression import without_consequences
from rgss.studies.measure_sources import metric_ranges, source_findings
from rgss.studies.measure_traces import measure_traces
from rgss.studies.motion import motion_findings, neutral_findings
from rgss.studies.planning import resolution_findings
from rgss.studies.project_folders import REQUIREMENTS, measures_of, requirements_named, study_file, words_of_study
from rgss.studies.study import StudyDefinition, named_file, read_study
from rgss.studies.trial_choice import TrialChoice
from rgss.studies.uncertainty_findings import uncertainty_findings
from rgss.studies.value_symbols import symbol_findings
from rgss.tasks import default_task, task_findings
from rgss.trace import MeasureTrace, check_trace

EVIDENCE = ".rgss/evidence.sqlite"

_UNDECIDABLE = ("trace.unknown-measure", "trace.criterion-unit")

Loaded = TypeVar("Loaded")


@dataclass(frozen=True, slots=True, kw_only=True)
class Project:
    """Project: a study with all that it depends on.

    Attributes:
        folder: The project's folder.
        requirements: Needs, requirements, architecture of the set that the study verifies.
        measures: The measures.
        designs: The design space with its catalogue.
        scene: The scene with its own robot.
        grippers: The gripper file of each gripper component, by its name.
        study: The study.
        measure_traces: The measures as traceability sees them.
        arms: The scene with the robot of each manipulator that names a robot file, by its name.
        chosen: The trials that were chosen in place of those of the study's file, for the commands that are named.
    """

    folder: Path
    requirements: RequirementSet
    measures: MeasureSet
    designs: DesignSpace
    scene: Scene
    grippers: dict[str, GripperFile]
    study: StudyDefinition
    measure_traces: tuple[MeasureTrace, ...]
    arms: Mapping[str, Scene] = field(default_factory=dict)
    chosen: TrialChoice = field(default=TrialChoice(), compare=False)

    @property
    def evidence(self) -> Path:
        """The file of the evidence store."""
        return self.folder / EVIDENCE

    def command(self, verb: str) -> str:
        """The command of a verb on this study and its chosen trials: ``rgss sweep nominal_world --replicates 4``."""
        return " ".join([f"rgss {verb}{words_of_study(self.study.label)}", *self.chosen.words])

    def check(self) -> tuple[Finding, ...]:
        """Findings on traceability, without a simulation."""
        return check_trace(self.requirements, self.measure_traces)

    def scene_of(self, variant: DesignVariant) -> Scene:
        """The scene with the arm of a design at its base: of its manipulator's file, else the scene's own."""
        return scene_with_arm(variant, self.scene, self.arms)

    def by_arm(self) -> dict[str, Project]:
        """The project with each arm of its designs in its scene, by robot file; empty for the scene's own."""
        scenes = scenes_by_arm(self.designs, self.scene, self.arms)
        return {name: replace(self, scene=scene) for name, scene in scenes.items()}

    def with_fidelity(self, fidelity: str) -> Project:
        """The same project with another fidelity for every design, and so without screening.

        Raises:
            DefinitionError: The fidelity is unknown.
        """
        known = [choice.value for choice in Fidelity]
        if fidelity not in known:
            raise DefinitionError(f"unknown fidelity {fidelity!r}", hint=f"fidelities: {', '.join(known)}")
        study = replace(self.study, fidelity=Fidelity(fidelity), screening=None)
        return replace(self, study=study, chosen=replace(self.chosen, fidelity=fidelity))

    @property
    def uncertainty(self) -> Uncertainty:
        """Uncertainty from trial to trial: the study's, else the scene's; none in a nominal study."""
        if self.study.is_nominal:
            return NOTHING_UNCERTAIN
        return self.scene.uncertainty.overridden_by(self.study.uncertainty)

    @property
    def workload(self) -> Workload:
        """The objects that trials carry; the scene's alone in a nominal study."""
        return ONE_WORKLOAD if self.study.is_nominal else self.study.workload

    def nominal(self) -> Project:
        """The same project without uncertainty and workload: everything as the files say."""
        chosen = replace(self.chosen, is_nominal=True)
        return replace(self, study=replace(self.study, is_nominal=True), chosen=chosen)

    def with_replicates(self, replicates: int) -> Project:
        """The same project with a fixed number of replicates, the same for every variant."""
        study = replace(self.study, replicates=replicates, is_sequential=False)
        return replace(self, study=study, chosen=replace(self.chosen, replicates=replicates))


def load_project(folder: Path, study: str | None = None) -> Project:
    """Read a project and one of its studies, reporting the problems of all files at once.

    Args:
        folder: The project's folder.
        study: The study file, relative to the project or to the current folder, or its name alone; the reference
            study by default, or else the only one.

    Raises:
        DocumentError: Files are wrong; with every problem in all of them.
        DefinitionError: No study is named, and those of the project have other names than the default.
    """
    return _Reader(folder).read(study)


def _undecidable(project: Project) -> tuple[Finding, ...]:
    """Criteria that no evidence can decide, because their measure is not there or has another dimension."""
    units = {measure.id: measure.unit for measure in project.measures.measures}
    criteria = [item.criterion for item in project.requirements.system if item.criterion is not None]
    if all(one.measure in units and same_dimension(one.unit, units[one.measure]) for one in criteria):
        return ()
    return tuple(finding for finding in project.check() if finding.rule in _UNDECIDABLE)


class _Reader:
    """Reads file by file and goes on after a problem, so that the user sees all of them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._findings: list[Finding] = []

    # long function: one check after the other of files that name each other, each with its own findings.
    def read(self, study_name: str | None) -> Project:
        folder = self._folder
        path, label = study_file(folder, study_name)
        try:
            named_set = requirements_named(folder, read_document(path, label=label).data)
        except DocumentError:
            named_set = REQUIREMENTS  # so that findings on those are reported, too
        requirements, measures = None, None
        if named_set is not None:
            requirements = self._try(lambda: load_requirements(folder / named_set, label_root=named_set))
            measures = self._try(lambda: load_measures(folder / measures_of(named_set), label=measures_of(named_set)))
            measures = None if measures is None else replace(measures, metric_ranges=metric_ranges())
        study = self._try(lambda: read_study(path, measures, project=folder, label=label))
        # What the study names is read even if something else in the study is wrong.
        named = self._named_files(path, label)
        designs = self._designs(named)
        scene = (
            self._try(lambda: load_scene(folder / named["scene"], label=named["scene"], project=folder))
            if "scene" in named
            else None
        )
        grippers = self._grippers(designs) if designs is not None else {}
        arms = {} if designs is None or scene is None else self._arms(designs, named["scene"])
        scenes = () if designs is None or scene is None else tuple(scenes_by_arm(designs, scene, arms).values())
        robots = tuple(one.robot for one in scenes)
        if designs is not None:
            document = read_document(folder / named["design_space"], label=named["design_space"])
            if scene is not None and study is not None:
                written = read_document(path, label=label)
                if study.task_file is not None:
                    self._findings += task_findings(study.task_file, *scenes)
                    self._findings += neutral_findings(study.task_file, grippers)
                self._findings += uncertainty_findings(scene, study, written, grippers)
                self._findings += resolution_findings(study.planning, robots, written)
                self._findings += design_findings(designs, document, grippers, robots, study.planning)
                self._findings += motion_findings(study.motion, study.rate_hz, written, designs, document, robots)
            if measures is not None and named_set is not None:
                document = read_document(folder / measures_of(named_set), label=measures_of(named_set))
                planned = len((default_task() if study is None else study.task).planned)
                joints = sorted({len(robot.joints) for robot in robots})
                self._findings.extend(
                    source_findings(measures.inputs, designs.source_units(), document, planned=planned, joints=joints)
                )
        if requirements is not None and measures is not None:
            self._findings += symbol_findings(requirements, measures)
        if (
            named_set is None
            or requirements is None
            or measures is None
            or study is None
            or designs is None
            or scene is None
            or self._findings
        ):
            raise DocumentError(without_consequences(self._findings))
        project = Project(
            folder=folder,
            requirements=requirements,
            measures=measures,
            designs=designs,
            scene=scene,
            grippers=grippers,
            study=study,
            measure_traces=measure_traces(
                measures, read_document(folder / measures_of(named_set), label=measures_of(named_set))
            ),
            arms=arms,
        )
        undecidable = _undecidable(project)
        if undecidable:
            raise DocumentError(undecidable)
        return project

    def _try(self, load: Callable[[], Loaded]) -> Loaded | None:
        try:
            return load()
        except DocumentError as error:
            self._findings.extend(error.findings)
            return None

    def _named_files(self, path: Path, label: str) -> dict[str, str]:
        """The files that a study names, by key; without those that are not there or lie outside the project."""
        try:
            data = read_document(path, label=label).data
        except DocumentError:
            return {}
        return {
            key: name
            for key in ("design_space", "catalogue", "scene")
            if isinstance(data, dict) and isinstance(name := data.get(key), str)
            if named_file(self._folder, name) is not None
        }

    def _designs(self, named: Mapping[str, str]) -> DesignSpace | None:
        if "catalogue" not in named:
            return None
        catalogue = self._try(lambda: load_catalogue(self._folder / named["catalogue"], label=named["catalogue"]))
        if catalogue is None or "design_space" not in named:
            return None
        space = named["design_space"]
        return self._try(lambda: load_design_space(self._folder / space, catalogue, label=space))

    def _grippers(self, designs: DesignSpace) -> dict[str, GripperFile]:
        """The file of every gripper component, by its name."""

        def load(name: str) -> GripperFile:
            return load_gripper_file(self._folder / name, label=name, project=self._folder)

        return component_files(designs.catalogue, GRIPPER, load, self._findings, project=self._folder)

    def _arms(self, designs: DesignSpace, label: str) -> dict[str, Scene]:
        """The scene with the robot of every manipulator that names a robot file, by its name."""

        def load(name: str) -> Scene:
            return load_scene(self._folder / label, label=label, project=self._folder, arm=name)

        return component_files(designs.catalogue, ARM, load, self._findings, project=self._folder)
