"""Findings on a project's scene, at their places in the scene file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rgss.documents import read_document
from rgss.engines import INSTALL
from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.scenes import mesh_volume_findings
from rgss.studies.checks import (
    MISFITS,
    TOO_WIDE,
    Misfit,
    ScenePlaces,
    TooTall,
    check_step_findings,
    checked_mounting,
    held_load_findings,
    is_at_the_palm,
    is_of_fingers,
    lack_of_room,
    objects_too_tall,
    step_findings,
)
from rgss.studies.design_settings import GRIPPER
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project

if TYPE_CHECKING:
    from rgss.trials import HandStepProblem, SceneProblem

_NOT_SEARCHED = "grasps are not searched before the objects of the scene neither overlap nor lack support"


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneCheck:
    """Result of a check of the scene.

    Attributes:
        findings: The findings.
        skipped: Reason that the scene, or the grasps in it, were not checked; empty if they were.
    """

    findings: tuple[Finding, ...]
    skipped: str = ""


def check_scene(project: Project) -> SceneCheck:
    """Check the bodies of the scene, and the arm with every gripper shape of the designs, before anything is run."""
    try:
        from rgss.trials import check_step_problems, scene_problems

        of_bodies = scene_problems(project.scene)
        of_checks = check_step_problems(project.scene, project.study.task)
        skipped = _NOT_SEARCHED if _refuses_search(project, of_bodies) else ""
        of_hands = _HandProblems()
        for file in _gripper_files(project):
            of_hands.add(project, file, is_searched=not skipped)
        label = project.study.scene
        document = read_document(project.folder / label, label=label)
        held = () if skipped else tuple(held_load_findings(project, document))
    except ImportError as error:
        missing = f"{error.name or error} is not installed"
        return SceneCheck(findings=(), skipped=f"the scene is not checked: {missing} ({INSTALL})")
    except DefinitionError as error:
        return SceneCheck(findings=(), skipped=f"the scene is not checked: {error}")
    places = ScenePlaces(project, document)
    found = [places.finding(problem, ()) for problem in of_bodies]
    every = len(_gripper_files(project))
    found += [
        places.finding(
            problem,
            files if len(files) < every else (),
            serves=of_hands.reaches(problem, every),
            room=of_hands.room.get(problem, ""),
        )
        for problem, files in of_hands.reach.items()
    ]
    found += held
    found += step_findings(project, of_hands.steps, grippers=every)
    found += check_step_findings(project, of_checks)
    found += places.outgrown_regions()
    found += mesh_volume_findings(project.folder / label, label=label)
    found += [
        misfit.finding(document, (*places.at[name][:-1], "id"), reason, files, serves=of_hands.serves(name, every))
        for (misfit, name, reason), files in of_hands.misfits.items()
    ]
    found += [places.too_tall(tall, files, serves=len(files) < every) for tall, files in of_hands.too_tall.items()]
    return SceneCheck(findings=tuple(sorted(found)), skipped=skipped)


@dataclass(frozen=True, slots=True, kw_only=True)
class _HandProblems:
    """Problems of the hands of the designs, each with the gripper files that have it."""

    reach: dict[SceneProblem, list[str]] = field(default_factory=dict)
    room: dict[SceneProblem, str] = field(default_factory=dict)
    steps: dict[HandStepProblem, list[str]] = field(default_factory=dict)
    too_tall: dict[TooTall, list[str]] = field(default_factory=dict)
    misfits: dict[tuple[Misfit, str, str], list[str]] = field(default_factory=dict)

    def serves(self, name: str, every: int) -> bool:
        """True if an object fits a gripper of the designs: between its fingers, or a cup that seals on it."""
        unfit = (files for (_, of, _), files in self.misfits.items() if of == name)
        return len({file for files in unfit for file in files}) < every

    def reaches(self, problem: SceneProblem, every: int) -> bool:
        """True if a gripper of the designs has no such problem with the same object there."""
        alike = (
            files
            for one, files in self.reach.items()
            if (one.kind, one.first, one.waypoint) == (problem.kind, problem.first, problem.waypoint)
        )
        return len({file for files in alike for file in files}) < every

    def add(self, project: Project, file: str, *, is_searched: bool) -> None:
        """Check one gripper file; where it is not searched, the sizes of hand and objects alone."""
        from rgss.trials import SceneProblemKind, hand_step_problems, reach_problems

        scene, friction = project.scene, _pad_friction(project, file)
        geometry = checked_mounting(project, file, friction)
        tall = objects_too_tall(geometry, project)
        misfits = [(misfit, *found) for misfit in MISFITS for found in misfit.objects(geometry, project)]
        for one in tall:
            self.too_tall.setdefault(one, []).append(file)
        for unfit in misfits:
            self.misfits.setdefault(unfit, []).append(file)
        if not is_searched:
            return
        wide = [name for misfit, name, _ in misfits if misfit is TOO_WIDE]
        clearance_m, task = project.study.planning.settings.clearance_m, project.study.task
        for step in hand_step_problems(scene, geometry, clearance_m=clearance_m, task=task, friction=friction):
            self.steps.setdefault(step, []).append(file)
        for problem in reach_problems(scene, geometry, clearance_m=clearance_m, task=task, friction=friction):
            at_palm = any(is_at_the_palm(problem, one.object) for one in tall)
            if not at_palm and not any(is_of_fingers(problem, name) for name in wide):
                self.reach.setdefault(problem, []).append(file)
                if problem.kind is SceneProblemKind.NO_GRASP:
                    self.room[problem] = lack_of_room(project, geometry, problem.first, friction)


def _refuses_search(project: Project, of_bodies: Sequence[SceneProblem]) -> bool:
    """True if grasps would be searched, for minutes, among objects that cannot be where the scene has them."""
    from rgss.trials import SceneProblemKind

    refusing = (
        SceneProblemKind.OBJECT_OVERLAP,
        SceneProblemKind.PLACE_OVERLAP,
        SceneProblemKind.OBJECT_UNSUPPORTED,
        SceneProblemKind.PLACE_UNSUPPORTED,
    )
    return project.scene.task.candidates is not None and any(problem.kind in refusing for problem in of_bodies)


def _gripper_files(project: Project) -> tuple[str, ...]:
    """The geometry file of every gripper that a design has."""
    used = {variant.components[GRIPPER].geometry for variant in project.designs.expand()}
    return tuple(file for file in project.grippers if file in used)


def _pad_friction(project: Project, file: str) -> float:
    """The least friction of the pads of a design with a gripper, on which its grasp candidates depend."""
    if project.scene.task.candidates is None:
        return 0.0
    specs = trial_specs(project, seeds=[project.study.seed])
    files = {variant.id: variant.components[GRIPPER].geometry for variant in project.designs.expand()}
    return min(spec.gripper.grip_coefficient(1.0) for spec in specs if files[spec.variant] == file)
