"""A project: the folder with requirements, designs, scenes and studies, read and checked as a whole."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from rgss.designs import DesignSpace, load_catalogue, load_design_space
from rgss.documents import read_document
from rgss.errors import DefinitionError, DocumentError
from rgss.findings import Finding, Severity
from rgss.measures import MeasureKind as Kind
from rgss.measures import MeasureSet, load_measures
from rgss.requirements import RequirementSet, load_requirements
from rgss.scenes import GripperGeometry, Scene, load_gripper, load_scene
from rgss.studies.study import Study, read_study
from rgss.trace import MeasureKind, MeasureTrace, check_trace

FOLDERS = ("requirements", "designs", "scenes", "studies")
DEFAULT_STUDY = "studies/pick_place.yaml"
MEASURES = "requirements/measures.yaml"
EVIDENCE = ".rgss/evidence.sqlite"

Loaded = TypeVar("Loaded")


@dataclass(frozen=True, slots=True, kw_only=True)
class Project:
    """Everything that a study stands on.

    Attributes:
        folder: The project's folder.
        requirements: Needs, requirements, architecture.
        measures: The measures.
        designs: The design space with its catalogue.
        scene: The scene.
        grippers: The shape of each gripper component, by its geometry file.
        study: The study.
        measure_traces: The measures as traceability sees them.
    """

    folder: Path
    requirements: RequirementSet
    measures: MeasureSet
    designs: DesignSpace
    scene: Scene
    grippers: dict[str, GripperGeometry]
    study: Study
    measure_traces: tuple[MeasureTrace, ...]

    @property
    def evidence(self) -> Path:
        """The file of the evidence store."""
        return self.folder / EVIDENCE

    def check(self) -> tuple[Finding, ...]:
        """What traceability finds wrong, without a simulation."""
        return check_trace(self.requirements, self.measure_traces)

    def with_replicates(self, replicates: int) -> Project:
        """The same project with another number of replicates."""
        return replace(self, study=replace(self.study, replicates=replicates))


def find_project(folder: Path | None) -> Path:
    """The project's folder: the one given, or the nearest above this one that looks like a project.

    Raises:
        DefinitionError: There is none.
    """
    if folder is not None:
        missing = [name for name in FOLDERS if not (folder / name).is_dir()]
        if missing:
            raise DefinitionError(
                f"{folder} is not a project: it has no folder {missing[0]}/",
                hint=f"a project has {', '.join(f'{name}/' for name in FOLDERS)}",
            )
        return folder
    here = Path.cwd()
    for candidate in (here, *here.parents):
        if all((candidate / name).is_dir() for name in FOLDERS):
            return candidate
    raise DefinitionError("no project here or above", hint="go into a project or name it with --project DIR")


def load_project(folder: Path, study: str | None = None) -> Project:
    """Read a project and one of its studies, reporting the problems of all files at once.

    Args:
        folder: The project's folder.
        study: The study file, relative to the project or to the current folder; the reference
            study by default.

    Raises:
        DocumentError: Files are wrong; with every problem in all of them.
    """
    return _Reader(folder).read(study if study is not None else DEFAULT_STUDY)


class _Reader:
    """Reads file by file and goes on after a problem, so that the user sees all of them."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._findings: list[Finding] = []

    def read(self, study_name: str) -> Project:
        folder = self._folder
        requirements = self._try(lambda: load_requirements(folder / "requirements"))
        measures = self._try(lambda: load_measures(folder / MEASURES, label=MEASURES))
        path, label = self._study_file(study_name)
        study = self._try(lambda: read_study(path, measures, label=label))
        if study is None:
            raise DocumentError(sorted(self._findings))
        catalogue = self._try(lambda: load_catalogue(folder / study.catalogue, label=study.catalogue))
        designs: DesignSpace | None = None
        if catalogue is not None:
            designs = self._try(
                lambda: load_design_space(folder / study.design_space, catalogue, label=study.design_space)
            )
        scene = self._try(lambda: load_scene(folder / study.scene, label=study.scene))
        grippers = self._grippers(designs) if designs is not None else {}
        if requirements is None or measures is None or designs is None or scene is None or self._findings:
            raise DocumentError(sorted(set(self._findings)))
        self._check_sources(measures, designs)
        if self._findings:
            raise DocumentError(sorted(set(self._findings)))
        return Project(
            folder=folder,
            requirements=requirements,
            measures=measures,
            designs=designs,
            scene=scene,
            grippers=grippers,
            study=study,
            measure_traces=self._measure_traces(measures),
        )

    def _try(self, load: Callable[[], Loaded]) -> Loaded | None:
        try:
            return load()
        except DocumentError as error:
            self._findings.extend(error.findings)
            return None

    def _study_file(self, name: str) -> tuple[Path, str]:
        path = self._folder / name
        if not path.is_file() and Path(name).is_file():
            path = Path(name)
        try:
            label = path.resolve().relative_to(self._folder.resolve()).as_posix()
        except ValueError:
            label = name
        return path, label

    def _grippers(self, designs: DesignSpace) -> dict[str, GripperGeometry]:
        """The shape of every gripper that a variant uses, by the name of its file."""
        shapes: dict[str, GripperGeometry] = {}
        for component in designs.catalogue.of_role("gripper"):
            name = component.geometry
            if name and name not in shapes:
                shape = self._try(lambda name=name: load_gripper(self._folder / name, label=name))  # type: ignore[misc]
                if shape is not None:
                    shapes[name] = shape
        return shapes

    def _check_sources(self, measures: MeasureSet, designs: DesignSpace) -> None:
        """Every value that a measure takes from the design must be one that the designs have."""
        known = designs.source_units()
        document = read_document(self._folder / MEASURES, label=MEASURES)
        for index, symbol in enumerate(measures.inputs):
            if symbol.source.startswith("trial."):
                continue
            if symbol.source not in known:
                self._findings.append(
                    document.finding(
                        "measure.unknown-source",
                        f"{symbol.id}: the designs have no {symbol.source!r}",
                        ("inputs", index, "source"),
                        hint=f"sources: {', '.join(known)}",
                    )
                )

    def _measure_traces(self, measures: MeasureSet) -> tuple[MeasureTrace, ...]:
        document = read_document(self._folder / MEASURES, label=MEASURES)
        traces = []
        for index, measure in enumerate(measures.measures):
            place = document.finding("", "", ("measures", index, "id"), severity=Severity.INFO)
            traces.append(
                MeasureTrace(
                    id=measure.id,
                    kind=MeasureKind(measure.kind.value),
                    unit=measure.unit,
                    traces=measure.traces,
                    contributes_to=measure.contributes_to,
                    observed=measure.from_trials
                    and not any(
                        measures.measure(other).kind is Kind.PERFORMANCE for other in measures.dependencies(measure.id)
                    ),
                    file=place.file,
                    line=place.line,
                    column=place.column,
                )
            )
        return tuple(traces)
