"""Findings on a project's scene, at their places in the scene file."""

# long file: the problems of bodies and of hands become findings by one table of texts, places and severities.

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rgss.documents import Document, read_document
from rgss.engines import INSTALL
from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity
from rgss.scenes import half_extents_m, mesh_volume_findings
from rgss.studies.checks import (
    MISFITS,
    OF_ONE_GRIPPER,
    TOO_WIDE,
    Misfit,
    TooTall,
    check_step_findings,
    checked_mounting,
    closing_texts,
    held_load_findings,
    instability_texts,
    is_at_the_palm,
    is_of_fingers,
    lack_of_room,
    no_grasp_texts,
    objects_too_tall,
    remedy,
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
    places = _Places(project, document)
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
        clearance_m, task = project.study.planning.clearance_m, project.study.task
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


class _Places:
    """Positions of the bodies in the scene file."""

    def __init__(self, project: Project, document: Document) -> None:
        self.document = document
        self.at: dict[str, tuple[str | int, ...]] = {
            body.id: ("bodies", index, "foot") for index, body in enumerate(project.scene.bodies)
        }
        self._scene = project.scene
        self._workpiece = project.scene.workpiece.id
        self.at[self._workpiece] = ("workpiece", "at")
        self.at |= {one.workpiece.id: ("workpieces", index, "at") for index, one in enumerate(project.scene.others)}

    def finding(
        self, problem: SceneProblem, grippers: Sequence[str], *, serves: bool = False, room: str = ""
    ) -> Finding:
        """A problem at the place of its first body, with the place of the other in the message.

        Args:
            problem: The problem.
            grippers: The gripper files that have it, if others do not.
            serves: Whether a gripper has no problem of the kind with the body there.
            room: Reason why no candidate has room between the open fingers; empty if one has.
        """
        from rgss.trials import SceneProblemKind

        first, second = problem.first, self._named(problem.second)
        millimetres = f"{problem.distance_m * 1e3:.3g} mm"
        location: tuple[str | int, ...] = self.at.get(first, ("robot", "base"))
        severity = Severity.ERROR
        if problem.kind is SceneProblemKind.UNSERVED and problem.waypoint is not None:
            location = self._place_of(first, second=problem.second) if problem.is_at_place else self.at[first]
            pair = () if problem.reason is None or problem.reason.pair is None else problem.reason.pair
            named = [self._named(body) for body in pair if body in self.at]
            other = f" [{', '.join(named)}]" if named else ""
            of = f" with {', '.join(grippers)}" if grippers else ""
            message = f"no configuration of the arm{of} serves {problem.waypoint}: {problem.reason}{other}"
            hint = remedy(problem)
            of_hand = first in pair and not any(body in self.at for body in pair if body != first)
            if grippers and of_hand and serves:
                # The object does not fit between its fingers, but does between another's: a result, not a mistake.
                severity, hint = Severity.INFO, OF_ONE_GRIPPER
        elif problem.kind is SceneProblemKind.NO_GRASP:
            of = f" with {', '.join(grippers)}" if grippers else ""
            location = (*location[:-1], "id")
            message, hint = no_grasp_texts(problem, of, room)
            if grippers and serves and (room or problem.reason is None):
                severity, hint = Severity.INFO, OF_ONE_GRIPPER
        elif problem.kind is SceneProblemKind.CLOSING:
            message, hint = closing_texts(problem, grippers)
            severity = Severity.INFO if grippers else Severity.ERROR
        elif problem.kind is SceneProblemKind.HOME_COLLISION:
            message = f"at its home the robot is in collision: {first} with {second}, {millimetres} deep"
            hint = "change 'home' in the robot's file, or move the body or the robot's base"
        elif problem.kind in (SceneProblemKind.OVERLAP, SceneProblemKind.INSIDE):
            severity = Severity.WARNING
            inside = problem.kind is SceneProblemKind.INSIDE
            message = f"{first} is inside {second}" if inside else f"{first} and {second} overlap, {millimetres} deep"
            message += f", {millimetres} deep, and has no effect" if inside else ""
            hint = f"move {first} by {millimetres}, or take it out"
        elif problem.kind in (SceneProblemKind.OBJECT_UNSUPPORTED, SceneProblemKind.PLACE_UNSUPPORTED):
            at_place = problem.kind is SceneProblemKind.PLACE_UNSUPPORTED
            location = self._place_of(first) if at_place else self.at[first]
            where = "in its place" if at_place else "at the start"
            message = f"{where}, {first} does not rest on {second}: its centre of mass is {millimetres} beyond the edge"
            hint = "move 'at' over the body, or name another in 'stands_on'"
        elif problem.kind is SceneProblemKind.OBJECT_UNSTABLE:
            severity = Severity.WARNING
            message, hint = instability_texts(problem)
        else:
            at_place = problem.kind is SceneProblemKind.PLACE_OVERLAP
            location = self._place_of(first) if at_place else self.at[first]
            where = "in its place" if at_place else "at the start"
            message = f"{where}, {first} overlaps {second}, {millimetres} deep"
            hint = f"move 'at', or move {problem.second}"
        rule = f"scene.{problem.kind.value.replace('_', '-')}"
        return self.document.finding(rule, message, location, hint=hint, severity=severity)

    def too_tall(self, tall: TooTall, grippers: Sequence[str], *, serves: bool) -> Finding:
        """An object that is too tall for a hand, at its height.

        Args:
            tall: The heights.
            grippers: Files of the grippers for which it is.
            serves: Whether the designs have another gripper, for which it is not: then this is no mistake.
        """
        at, entry = self.at[tall.object][:-1], self.document.data
        for key in at:
            entry = entry[key]
        message = tall.message(", ".join(sorted(grippers)))
        hint = "designs with this gripper fail at the grasp, and the others do not" if serves else tall.hint
        severity = Severity.INFO if serves else Severity.ERROR
        location = (*at, "height" if "height" in entry else "id")
        return self.document.finding("scene.too-tall", message, location, hint=hint, severity=severity)

    def outgrown_regions(self) -> Iterator[Finding]:
        """Notes on objects that are wider than their place region."""
        for index, object_ in enumerate(self._scene.objects):
            above = ("workpieces", index - 1) if index else ()
            location: tuple[str | int, ...] = (*above, "place_region", "radius")
            half_m, radius_m = min(half_extents_m(object_.workpiece.shape)[:2]), object_.place.radius_m
            if half_m <= radius_m:
                continue
            message = (
                f"{object_.workpiece.id} does not fit its place region: half of its width is {half_m * 1e3:.4g} mm, "
                f"and the radius of the region is {radius_m * 1e3:.4g} mm"
            )
            hint = (
                f"make the radius at least {half_m * 1e3:.4g} mm, or take a smaller object; a trial compares the "
                "radius with the distance of the object's axis from the centre"
            )
            yield self.document.finding("scene.place-region", message, location, hint=hint, severity=Severity.INFO)

    def _place_of(self, name: str, *, second: str = "") -> tuple[str | int, ...]:
        """Position of a named place, else of the place region of an object."""
        named = [place.id for place in self._scene.places]
        if second in named:
            return ("places", named.index(second), "at")
        return ("place_region", "at") if name == self._workpiece else (*self.at[name][:-1], "place_region", "at")

    def _named(self, body: str) -> str:
        """A body with its place in the file, where it has one."""
        if body not in self.at:
            return body
        found = self.document.finding("", "", self.at[body])
        return f"{body} ({found.file}:{found.line}:{found.column})"
