"""Findings on the bodies of a scene and the hands among them, at their places in the scene file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.documents import Document
from rgss.findings import Finding, Severity
from rgss.scenes import half_extents_m
from rgss.studies.checks.scene_texts import (
    OF_ONE_ARM,
    OF_ONE_GRIPPER,
    closing_texts,
    instability_texts,
    no_grasp_texts,
    remedy,
)
from rgss.studies.checks.too_tall import TooTall

if TYPE_CHECKING:
    from rgss.studies.project import Project
    from rgss.trials import SceneProblem

_Location = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class _Said:
    """Message, hint, location and severity of a finding."""

    message: str
    hint: str
    location: _Location
    severity: Severity = Severity.ERROR


class ScenePlaces:
    """Positions of the bodies in the scene file, and the findings there."""

    def __init__(self, project: Project, document: Document, *, has_arms: bool = False) -> None:
        self.document = document
        self.at: dict[str, _Location] = {
            body.id: ("bodies", index, "foot") for index, body in enumerate(project.scene.bodies)
        }
        self._scene = project.scene
        self._workpiece = project.scene.workpiece.id
        self._has_arms = has_arms
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
        said = self._said(problem, grippers, serves=serves, room=room)
        rule = f"scene.{problem.kind.value.replace('_', '-')}"
        return self.document.finding(rule, said.message, said.location, hint=said.hint, severity=said.severity)

    def _said(self, problem: SceneProblem, grippers: Sequence[str], *, serves: bool, room: str) -> _Said:
        from rgss.trials import SceneProblemKind

        kind, location = problem.kind, self._location(problem.first)
        if kind is SceneProblemKind.UNSERVED and problem.waypoint is not None:
            return self._unserved(problem, grippers, serves=serves)
        if kind is SceneProblemKind.NO_GRASP:
            return self._no_grasp(problem, grippers, serves=serves, room=room)
        if kind is SceneProblemKind.CLOSING:
            message, hint = closing_texts(problem, grippers)
            return _Said(message, hint, location, Severity.INFO if grippers else Severity.ERROR)
        if kind is SceneProblemKind.HOME_COLLISION:
            second, deep = self._named(problem.second), _millimetres(problem)
            message = (
                f"at its home the robot{_of(grippers)} is in collision: {problem.first} with {second}, {deep} deep"
            )
            return _Said(message, "change 'home' in the robot's file, or move the body or the robot's base", location)
        if kind in (SceneProblemKind.OVERLAP, SceneProblemKind.INSIDE):
            return self._overlap(problem, is_inside=kind is SceneProblemKind.INSIDE)
        if kind is SceneProblemKind.OBJECT_UNSTABLE:
            return _Said(*instability_texts(problem), location, Severity.WARNING)
        at_place = kind in (SceneProblemKind.PLACE_UNSUPPORTED, SceneProblemKind.PLACE_OVERLAP)
        is_unsupported = kind in (SceneProblemKind.OBJECT_UNSUPPORTED, SceneProblemKind.PLACE_UNSUPPORTED)
        return self._misplaced(problem, at_place=at_place, is_unsupported=is_unsupported)

    def _unserved(self, problem: SceneProblem, grippers: Sequence[str], *, serves: bool) -> _Said:
        """A waypoint that the arm does not serve."""
        first = problem.first
        pair = () if problem.reason is None or problem.reason.pair is None else problem.reason.pair
        named = [self._named(body) for body in pair if body in self.at]
        other = f" [{', '.join(named)}]" if named else ""
        message = f"no configuration of the arm{_of(grippers)} serves {problem.waypoint}: {problem.reason}{other}"
        location = self._place_of(first, second=problem.second) if problem.is_at_place else self.at[first]
        of_hand = first in pair and not any(body in self.at for body in pair if body != first)
        if grippers and serves and (of_hand or self._has_arms):
            # Another hand takes the object, or another arm reaches it: a result, not a mistake.
            return _Said(message, OF_ONE_GRIPPER if of_hand else OF_ONE_ARM, location, Severity.INFO)
        return _Said(message, remedy(problem), location)

    def _no_grasp(self, problem: SceneProblem, grippers: Sequence[str], *, serves: bool, room: str) -> _Said:
        """An object of which no grasp candidate can be carried out."""
        location = (*self._location(problem.first)[:-1], "id")
        message, hint = no_grasp_texts(problem, _of(grippers), room)
        if grippers and serves and (room or problem.reason is None):
            return _Said(message, OF_ONE_GRIPPER, location, Severity.INFO)
        if grippers and serves and self._has_arms:
            return _Said(message, OF_ONE_ARM, location, Severity.INFO)
        return _Said(message, hint, location)

    def _overlap(self, problem: SceneProblem, *, is_inside: bool) -> _Said:
        """Bodies of the scene that overlap, or one inside another."""
        first, second, deep = problem.first, self._named(problem.second), _millimetres(problem)
        message = f"{first} and {second} overlap, {deep} deep"
        if is_inside:
            message = f"{first} is inside {second}, {deep} deep, and has no effect"
        return _Said(message, f"move {first} by {deep}, or take it out", self._location(first), Severity.WARNING)

    def _misplaced(self, problem: SceneProblem, *, at_place: bool, is_unsupported: bool) -> _Said:
        """An object that overlaps a body, or does not rest on one, at the start or in its place."""
        first, second, far = problem.first, self._named(problem.second), _millimetres(problem)
        location = self._place_of(first) if at_place else self.at[first]
        where = "in its place" if at_place else "at the start"
        if is_unsupported:
            message = f"{where}, {first} does not rest on {second}: its centre of mass is {far} beyond the edge"
            return _Said(message, "move 'at' over the body, or name another in 'stands_on'", location)
        message = f"{where}, {first} overlaps {second}, {far} deep"
        return _Said(message, f"move 'at', or move {problem.second}", location)

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
            location: _Location = (*above, "place_region", "radius")
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

    def _location(self, body: str) -> _Location:
        """Position of a body; that of the robot's base for a link of the arm."""
        return self.at.get(body, ("robot", "base"))

    def _place_of(self, name: str, *, second: str = "") -> _Location:
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


def _of(grippers: Sequence[str]) -> str:
    return f" with {', '.join(grippers)}" if grippers else ""


def _millimetres(problem: SceneProblem) -> str:
    return f"{problem.distance_m * 1e3:.3g} mm"
