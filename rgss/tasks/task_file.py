"""Reader of task files: expansion of repetitions, unique names, and findings that do not depend on the scene."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from rgss.documents import Document, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.scenes import Pose, Waypoint
from rgss.tasks.check_step import CheckStep, Nearness
from rgss.tasks.document import (
    CheckEntry,
    GripEntry,
    MoveEntry,
    NearEntry,
    ReleaseEntry,
    StepControlEntry,
    StepEntry,
    TargetEntry,
    TaskDocument,
    WaitEntry,
)
from rgss.tasks.grip_step import GripStep
from rgss.tasks.hand_states import hand_findings
from rgss.tasks.move_kinds import MoveKind
from rgss.tasks.move_step import MoveStep, Target
from rgss.tasks.program import Step, TaskProgram
from rgss.tasks.release_step import ReleaseStep
from rgss.tasks.step_settings import StepControl
from rgss.tasks.wait_step import WaitStep

Location = tuple[str | int, ...]
MOST_STEPS = 10_000
_TOOL_DOWN_ROLL_RAD = 3.141592653589793
_KINDS = tuple(StepEntry.model_fields)


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadedTask:
    """Task with the positions of its steps in the file.

    Attributes:
        program: The task.
        document: Its file.
        places: Location of each step in the file.
    """

    program: TaskProgram
    document: Document
    places: tuple[Location, ...]


def load_task(path: Path, *, label: str | None = None) -> LoadedTask:
    """Read a task.

    Args:
        path: The file.
        label: The file's name in messages; the path by default.

    Raises:
        DocumentError: The file is invalid; with every problem in it.
    """
    loaded = load_document(path, TaskDocument, label=label)
    entry, document = loaded.value, loaded.document
    compiler = _Compiler(entry, document)
    placed = list(compiler.steps(entry.steps, ("steps",), prefix="", bound=""))
    start = None if entry.start is None else compiler.target(entry.start, ("start",), "")
    findings = compiler.findings
    if not findings and not (placed and isinstance(placed[0][0], MoveStep)):
        hint = "begin with a move"
        findings.append(document.finding("task.empty", "the first step must be a move", ("steps",), hint=hint))
    if not findings:
        findings += _name_findings(document, placed)
        findings += hand_findings(document, placed)
    if findings:
        raise DocumentError(sorted(set(findings)))
    steps = tuple(step for step, _ in placed)
    program = TaskProgram(id=entry.task, start=start, steps=steps, time_limit_s=entry.time_limit)
    return LoadedTask(program=program, document=document, places=tuple(place for _, place in placed))


class _Compiler:
    """Compiler of the steps of a file."""

    def __init__(self, entry: TaskDocument, document: Document) -> None:
        self.findings: list[Finding] = []
        self._document = document
        self._configurations: Mapping[str, tuple[float, ...]] = {
            name: tuple(joint.value for joint in joints) for name, joints in entry.configurations.items()
        }
        self._thresholds = entry.reached_within
        for key in ("joints", "gripper"):
            self._refuse_not_positive(key, getattr(entry.reached_within, key), ("reached_within",))
        self._refuse_not_positive("time_limit", entry.time_limit, ())
        self._count = 0

    def steps(
        self, entries: Iterable[StepEntry], at: Location, *, prefix: str, bound: str
    ) -> Iterator[tuple[Step, Location]]:
        """Steps of entries, with repetitions expanded."""
        for index, entry in enumerate(entries):
            here = (*at, index)
            kinds = [kind for kind in _KINDS if getattr(entry, kind) is not None]
            if len(kinds) != 1:
                said = " and ".join(kinds) or "none"
                self._report("task.kind", f"a step has exactly one kind, got {said}", here, ", ".join(_KINDS))
                continue
            within = (*here, kinds[0])
            if entry.repeat is not None:
                if entry.repeat.times == 0 or not entry.repeat.steps:
                    self._report(
                        "task.empty", "the loop has no steps to repeat", within, "add steps, or remove the loop"
                    )
                for turn in range(1, entry.repeat.times + 1):
                    if self._is_too_long(within):
                        return
                    inner = f"{prefix}{entry.repeat.name}_{turn}."
                    yield from self.steps(entry.repeat.steps, (*within, "steps"), prefix=inner, bound=bound)
            elif entry.for_each is not None:
                if not entry.for_each.objects or not entry.for_each.steps:
                    self._report("task.empty", "the loop has no steps to repeat", within, "add objects and steps")
                for one in entry.for_each.objects:
                    if self._is_too_long(within):
                        return
                    yield from self.steps(entry.for_each.steps, (*within, "steps"), prefix=f"{prefix}{one}.", bound=one)
            else:
                self._count += 1
                if self._is_too_long(within):
                    return
                yield self._step(entry, within, prefix, bound), within

    def target(self, entry: TargetEntry, at: Location, bound: str) -> Target:
        """Target of a move."""
        given = [key for key in ("to", "configuration", "pose") if getattr(entry, key) is not None]
        if len(given) != 1:
            said = " and ".join(given) or "none"
            self._report("task.target", f"a move needs one of to, configuration and pose, got {said}", at, "name one")
            return Target(name="")
        if entry.configuration is not None:
            joints = self._configurations.get(entry.configuration)
            if joints is None:
                known = ", ".join(self._configurations) or "none is given"
                message = f"there is no configuration {entry.configuration!r}"
                self._report("task.unknown-configuration", message, (*at, "configuration"), f"configurations: {known}")
            return Target(name=entry.configuration, configuration_rad=joints or ())
        if entry.pose is not None:
            roll = _TOOL_DOWN_ROLL_RAD if entry.pose.roll is None else entry.pose.roll
            angles = (roll, entry.pose.pitch, entry.pose.yaw)
            pose = Pose.from_roll_pitch_yaw(entry.pose.position, angles)
            return Target(name="pose", pose=pose.raised(entry.raised))
        name = entry.to or ""
        if name not in [one.value for one in Waypoint]:
            known = ", ".join(one.value for one in Waypoint)
            self._report("task.unknown-waypoint", f"there is no waypoint {name!r}", (*at, "to"), f"waypoints: {known}")
        return Target(
            name=name, waypoint=name, raised_m=entry.raised, object=entry.object or bound, place=entry.place or ""
        )

    def _step(self, entry: StepEntry, at: Location, prefix: str, bound: str) -> Step:
        if entry.move is not None:
            return self._move(entry.move, at, prefix, bound)
        if entry.grip is not None:
            return self._grip(entry.grip, at, prefix, bound)
        if entry.release is not None:
            return self._release(entry.release, at, prefix)
        if entry.wait is not None:
            return self._wait(entry.wait, at, prefix)
        if entry.check is None:
            raise AssertionError("checked before: a step has a kind")
        return self._check(entry.check, at, prefix, bound)

    def _move(self, entry: MoveEntry, at: Location, prefix: str, bound: str) -> MoveStep:
        if not 0.0 < entry.speed <= 1.0:
            message = f"speed must be a share in (0, 1], got {entry.speed:g}"
            self._report("task.share", message, (*at, "speed"), "write 0.5, or 50 %")
        for key in ("time_limit", "resolution", "reached_within"):
            self._refuse_not_positive(key, getattr(entry, key), at)
        target = self.target(entry, at, bound)
        mode = MoveKind(entry.mode)
        if mode is MoveKind.STRAIGHT and target.configuration_rad:
            message = "a straight line of the tool ends at a waypoint or a pose, not at a configuration"
            self._report("task.target", message, (*at, "mode"), "write mode: joint")
        if mode is not MoveKind.PLANNED and entry.time_limit is not None:
            message = "only a planned move has a planning limit"
            self._report("task.limit", message, (*at, "time_limit"), "leave it out, or write mode: planned")
        return MoveStep(
            name=prefix + (entry.name or f"move_to_{target.name}"),
            target=target,
            mode=mode,
            speed_share=entry.speed,
            limit_s=entry.time_limit,
            resolution_rad=entry.resolution,
            reached_rad=self._thresholds.joints if entry.reached_within is None else entry.reached_within,
            control=self._control(entry.control, at),
        )

    def _grip(self, entry: GripEntry, at: Location, prefix: str, bound: str) -> GripStep:
        for key in ("firm_above", "firm_for"):
            self._refuse_not_positive(key, getattr(entry, key), at)
        return GripStep(
            name=prefix + (entry.name or "grip"),
            object=entry.object or bound,
            firm_above_n=entry.firm_above,
            firm_s=entry.firm_for,
            control=self._control(entry.control, at),
        )

    def _release(self, entry: ReleaseEntry, at: Location, prefix: str) -> ReleaseStep:
        self._refuse_not_positive("reached_within", entry.reached_within, at)
        return ReleaseStep(
            name=prefix + (entry.name or "release"),
            place=entry.place or "",
            opened_m=self._thresholds.gripper if entry.reached_within is None else entry.reached_within,
            control=self._control(entry.control, at),
        )

    def _wait(self, entry: WaitEntry, at: Location, prefix: str) -> WaitStep:
        self._refuse_not_positive("duration", entry.duration, at)
        return WaitStep(
            name=prefix + (entry.name or "wait"),
            duration_s=entry.duration,
            control=self._control(entry.control, at),
        )

    def _check(self, entry: CheckEntry, at: Location, prefix: str, bound: str) -> CheckStep:
        if not (entry.at or entry.upright or entry.at_rest or entry.held is not None or entry.near):
            hint = "write at, near, upright, at_rest or held"
            self._report("task.empty", "the check states no condition", at, hint)
        return CheckStep(
            name=prefix + (entry.name or "check"),
            object=entry.object or bound,
            at=entry.at or "",
            is_upright=entry.upright,
            is_at_rest=entry.at_rest,
            held=entry.held,
            near=None if entry.near is None else self._near(entry.near, (*at, "near")),
        )

    def _near(self, entry: NearEntry, at: Location) -> Nearness:
        given = [key for key in ("place", "object", "point") if getattr(entry, key) is not None]
        if len(given) != 1:
            said = " and ".join(given) or "none"
            self._report("task.near", f"near needs one of place, object and point, got {said}", at, "name one")
        self._refuse_not_positive("within", entry.within, at)
        return Nearness(within_m=entry.within, place=entry.place or "", object=entry.object or "", point_m=entry.point)

    def _control(self, entry: StepControlEntry | None, at: Location) -> StepControl | None:
        if entry is not None:
            for key in ("natural_frequency", "damping_ratio", "velocity_gain"):
                self._refuse_not_positive(key, getattr(entry, key), (*at, "control"))
            if entry.position_gain is not None and entry.position_gain < 0.0:
                message = "position_gain must not be negative"
                self._report("task.negative", message, (*at, "control", "position_gain"))
        return _step_control(entry)

    def _refuse_not_positive(self, key: str, value: float | None, at: Location) -> None:
        if value is not None and value <= 0.0:
            self._report("task.not-positive", f"{key} must be greater than zero", (*at, key))

    def _is_too_long(self, at: Location) -> bool:
        if self._count <= MOST_STEPS:
            return False
        self._report("task.long", f"the task has more than {MOST_STEPS} steps", at, "repeat less often")
        return True

    def _report(self, rule: str, message: str, at: Location, hint: str = "") -> None:
        self.findings.append(self._document.finding(rule, message, at, hint=hint))


def _name_findings(document: Document, placed: list[tuple[Step, Location]]) -> Iterator[Finding]:
    seen: set[str] = set()
    for step, at in placed:
        if step.name in seen:
            hint = "give each step its own name"
            yield document.finding("task.duplicate-name", f"there are two steps {step.name!r}", at, hint=hint)
        seen.add(step.name)


def _step_control(entry: StepControlEntry | None) -> StepControl | None:
    """Joint control of a step; None for that of the study.

    Args:
        entry: Its entry in the file.
    """
    if entry is None:
        return None
    return StepControl(
        mode=entry.mode,
        natural_frequency_rad_s=entry.natural_frequency,
        damping_ratio=entry.damping_ratio,
        position_gain_1_s=entry.position_gain,
        velocity_gain_1_s=entry.velocity_gain,
    )
