"""Section ``planning`` of a study's file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import Document, DocumentModel, Identifier, Metres, Radians, Seconds, Text
from rgss.findings import Finding
from rgss.motion import OnUnverified, PlannerSettings
from rgss.scenes import Robot
from rgss.studies.planning.declared_planners import PlannerField, planner_problem, read_planners
from rgss.tasks import MoveKind


class PlanningEntry(DocumentModel):
    """Planning of moves."""

    clock: Literal["counted", "wall"] = "counted"
    charge_per_check: Seconds
    resolution: Radians
    verification_resolution: Radians | None = None
    on_unverified: Literal["fail", "repair"] = "fail"
    simplification_checks: Annotated[int, Field(ge=0, le=1_000_000)]
    simplification_limit: Seconds = 2.0
    clearance: Metres
    planner: Text | None = None
    time_limit: Seconds | None = None
    planners: dict[Identifier, PlannerField] = Field(default_factory=dict)
    references: tuple[Text, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningChoice:
    """Planning of moves.

    Attributes:
        counted: Whether planning time is counted in validity checks; a wall clock otherwise.
        charge_per_check_s: Planning time that a validity check is charged with.
        resolution_rad: Greatest joint step between two states of a motion that a search checks.
        verification_resolution_rad: Greatest joint step between two checked states of the path that will run; as
            the search if None.
        on_unverified: Handling of a path that is not valid at that resolution.
        simplification_checks: Validity checks that may be spent on looking for shortcuts.
        simplification_limit_s: Longest time of simplifying a path by the planning clock.
        clearance_m: Distance that the checked states of planned paths keep; the path that runs keeps a quarter of it.
        planner: The planner where no design sets it; empty if the file has none.
        time_limit_s: Longest planning time of one move where no design sets it; None if the file has none.
        planners: The planners that the file declares, by their names there.
        references: Names of planners that are compared with those of the designs.
        moves: Kind of each of the planned moves of the task, in their order; all are planned if it is empty.
    """

    counted: bool
    charge_per_check_s: float
    resolution_rad: float
    simplification_checks: int
    simplification_limit_s: float
    clearance_m: float
    planner: str = ""
    time_limit_s: float | None = None
    verification_resolution_rad: float | None = None
    on_unverified: OnUnverified = OnUnverified.FAIL
    planners: Mapping[str, PlannerSettings] = field(default_factory=dict)
    references: tuple[str, ...] = ()
    moves: tuple[MoveKind, ...] = ()

    def planner_settings(self, name: str) -> PlannerSettings:
        """The planner of a name: one that the file declares, else that of OMPL."""
        return self.planners.get(name) or PlannerSettings(algorithm=name)


def read_planning(planning: PlanningEntry, document: Document, findings: list[Finding]) -> PlanningChoice:
    """Planning of moves.

    Args:
        planning: The section.
        document: The file, for positions.
        findings: Collects the problems.
    """
    findings.extend(_value_findings(planning, document))
    findings.extend(_planning_findings(planning, document))
    planners = read_planners(planning.planners, document, findings)
    return PlanningChoice(
        counted=planning.clock == "counted",
        charge_per_check_s=planning.charge_per_check,
        resolution_rad=planning.resolution,
        simplification_checks=planning.simplification_checks,
        simplification_limit_s=planning.simplification_limit,
        clearance_m=planning.clearance,
        planner=planning.planner or "",
        time_limit_s=planning.time_limit,
        verification_resolution_rad=planning.verification_resolution,
        on_unverified=OnUnverified(planning.on_unverified),
        planners=planners,
        references=planning.references,
    )


def resolution_findings(planning: PlanningChoice, robot: Robot, document: Document) -> Iterator[Finding]:
    """A finding for a resolution at which a search would check nothing between two configurations.

    Args:
        planning: The section.
        robot: The arm.
        document: The study's file, for positions.
    """
    extent_rad = math.sqrt(math.fsum((joint.upper_rad - joint.lower_rad) ** 2 for joint in robot.joints))
    if planning.resolution_rad >= extent_rad:
        message = (
            f"resolution of {planning.resolution_rad:g} rad is not below the diagonal of the joints' ranges, "
            f"{extent_rad:.3g} rad"
        )
        hint = "such as 0.05 rad; a search checks the states of a motion that far apart"
        yield document.finding("study.coarse-resolution", message, ("planning", "resolution"), hint=hint)


def _value_findings(planning: PlanningEntry, document: Document) -> Iterator[Finding]:
    for key, value in (
        ("charge_per_check", planning.charge_per_check),
        ("resolution", planning.resolution),
        ("verification_resolution", planning.verification_resolution),
        ("time_limit", planning.time_limit),
    ):
        if value is not None and value <= 0:
            yield document.finding("study.not-positive", f"{key} must be greater than zero", ("planning", key))
    for key, value in (("clearance", planning.clearance), ("simplification_limit", planning.simplification_limit)):
        if value < 0:
            yield document.finding("study.negative", f"{key} must not be negative", ("planning", key))


def _planning_findings(planning: PlanningEntry, document: Document) -> Iterator[Finding]:
    """Planners that are named but not there, and a resolution at which nothing would be verified."""
    named: list[tuple[str, tuple[str | int, ...]]] = [
        (name, ("planning", "references", index)) for index, name in enumerate(planning.references)
    ]
    if planning.planner is not None:
        named.append((planning.planner, ("planning", "planner")))
    for name, place in named:
        if problem := planner_problem(name, planning.planners):
            message, hint = problem
            yield document.finding("study.planner", message, place, hint=hint)
    verification, key = planning.verification_resolution, ("planning", "verification_resolution")
    if verification is not None and verification > planning.resolution > 0:
        message = "a path cannot be verified more coarsely than it is searched for"
        yield document.finding("study.coarse-verification", message, key, hint="make it at most 'resolution'")
