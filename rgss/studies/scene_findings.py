"""Findings on a project's scene, at their places in the scene file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from rgss.designs import DesignVariant
from rgss.documents import read_document
from rgss.engines import INSTALL
from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.scenes import Scene, mesh_volume_findings
from rgss.studies.arms import PlacedArm, scenes_by_placed_arm
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

_MOST_HANDS = 24
"""Greatest number of hands that are checked, which takes seconds for each."""

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

        of_hands, every_hand = _HandProblems(), _hands(project)
        hands = _sampled(every_hand)
        of_bodies = list(dict.fromkeys(found for scene in _placed(project, hands) for found in scene_problems(scene)))
        of_checks = check_step_problems(project.scene, project.study.task)
        skipped = _NOT_SEARCHED if _refuses_search(project, of_bodies) else ""
        for hand in hands:
            of_hands.add(hand, is_searched=not skipped)
        label = project.study.scene
        document = read_document(project.folder / label, label=label)
        held = () if skipped else tuple(held_load_findings(project, document))
    except ImportError as error:
        missing = f"{error.name or error} is not installed"
        return SceneCheck(findings=(), skipped=f"the scene is not checked: {missing} ({INSTALL})")
    except DefinitionError as error:
        return SceneCheck(findings=(), skipped=f"the scene is not checked: {error}")
    has_arms = len({(hand.project.scene.robot.id, hand.project.scene.robot.base) for hand in hands}) > 1
    places = ScenePlaces(project, document, has_arms=has_arms)
    found = [places.finding(problem, ()) for problem in of_bodies]
    every, grippers = len(hands), len({hand.gripper for hand in hands})
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
        misfit.finding(document, (*places.at[name][:-1], "id"), reason, files, serves=of_hands.serves(name, grippers))
        for (misfit, name, reason), files in of_hands.misfits.items()
    ]
    found += [places.too_tall(tall, files, serves=len(files) < grippers) for tall, files in of_hands.too_tall.items()]
    if not skipped and len(hands) < len(every_hand):
        skipped = f"the scene is checked with {len(hands)} of the {len(every_hand)} grippers on arms at their bases"
    return SceneCheck(findings=tuple(sorted(found)), skipped=skipped)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Hand:
    """Gripper on an arm, as a design has it.

    Attributes:
        project: The project with that arm in its scene.
        gripper: Its gripper file.
        designs: The designs that have it.
        name: Its name in messages: the gripper file, and the arm's if the designs have several.
    """

    project: Project
    gripper: str
    designs: tuple[DesignVariant, ...]
    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class _HandProblems:
    """Problems of the hands of the designs, each with the names of the hands that have it."""

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

    def add(self, hand: _Hand, *, is_searched: bool) -> None:
        """Check one hand; where it is not searched, the sizes of hand and objects alone."""
        from rgss.trials import SceneProblemKind, hand_step_problems, reach_problems

        project, file = hand.project, hand.name
        scene, friction = project.scene, _pad_friction(hand)
        geometry = checked_mounting(project, hand.gripper, friction)
        tall = objects_too_tall(geometry, project)
        misfits = [(misfit, *found) for misfit in MISFITS for found in misfit.objects(geometry, project)]
        # Sizes of hand and object are the same on every arm.
        of_sizes = [self.too_tall.setdefault(one, []) for one in tall]
        of_sizes += [self.misfits.setdefault(unfit, []) for unfit in misfits]
        for grippers in of_sizes:
            if hand.gripper not in grippers:
                grippers.append(hand.gripper)
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


def _sampled(hands: tuple[_Hand, ...]) -> tuple[_Hand, ...]:
    """As many hands as are checked, evenly among all."""
    if len(hands) <= _MOST_HANDS:
        return hands
    return tuple(hands[index * len(hands) // _MOST_HANDS] for index in range(_MOST_HANDS))


def _placed(project: Project, hands: Sequence[_Hand]) -> tuple[Scene, ...]:
    """The scene, with its bodies where designs place those that move with the robot."""
    if not any(body.moves_with_robot for body in project.scene.bodies):
        return (project.scene,)
    return tuple({hand.project.scene.robot.base: hand.project.scene for hand in hands}.values())


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


def _hands(project: Project) -> tuple[_Hand, ...]:
    """Every gripper on every arm at every base, as designs have them."""
    placed = scenes_by_placed_arm(project.designs, project.scene, project.arms)
    hands = []
    for arm, (scene, designs) in placed.items():
        on_arm = "" if len(placed) == 1 else f" on {_arm_name(project, arm, is_moved=_is_moved(arm, placed))}"
        having: dict[str, list[DesignVariant]] = {}
        for variant in designs:
            having.setdefault(variant.components[GRIPPER].geometry, []).append(variant)
        hands += [
            _Hand(
                project=replace(project, scene=scene),
                gripper=gripper,
                designs=tuple(having[gripper]),
                name=f"{gripper}{on_arm}",
            )
            for gripper in project.grippers
            if gripper in having
        ]
    return tuple(hands)


def _is_moved(arm: PlacedArm, placed: Iterable[PlacedArm]) -> bool:
    """True if designs have an arm at several bases."""
    return any(one.file == arm.file and one.base != arm.base for one in placed)


def _arm_name(project: Project, arm: PlacedArm, *, is_moved: bool) -> str:
    """Name of an arm in messages, with its base where designs have several of them."""
    name = arm.file or f"the robot of {PurePosixPath(project.study.scene).name}"
    if not is_moved:
        return name
    yaw = math.degrees(arm.base.roll_pitch_yaw_rad()[2])
    position = ", ".join(f"{value:g}" for value in arm.base.position_m)
    return f"{name} at ({position}) m, yaw {yaw:.4g} deg"


def _pad_friction(hand: _Hand) -> float:
    """The least friction of the pads of a design with a hand, on which its grasp candidates depend."""
    project = hand.project
    if project.scene.task.candidates is None:
        return 0.0
    specs = trial_specs(project, variants=hand.designs, seeds=[project.study.seed])
    return min(spec.gripper.grip_coefficient(1.0) for spec in specs)
