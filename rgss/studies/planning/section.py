"""Section ``planning`` of a study's file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import Field

from rgss.documents import Document, DocumentModel, Identifier, Metres, Radians, Seconds, Text
from rgss.findings import Finding
from rgss.motion import ClockKind, OnUnverified, PlannerSettings, PlanningClock
from rgss.scenes import Robot
from rgss.studies.planning.declared_planners import PlannerField, planner_problem, read_planners
from rgss.tasks import MoveKind
from rgss.trials import PlanningSettings


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
        settings: Settings of the planning of trials; `rgss.studies.trial_settings` extends the limit of its searches to
            the longest of any design.
        planner: The planner where no design sets it; empty if the file has none.
        time_limit_s: Longest planning time of one move where no design sets it; None if the file has none.
        planners: The planners that the file declares, by their names there.
        references: Names of planners that are compared with those of the designs.
    """

    settings: PlanningSettings
    planner: str = ""
    time_limit_s: float | None = None
    planners: Mapping[str, PlannerSettings] = field(default_factory=dict)
    references: tuple[str, ...] = ()

    def planner_settings(self, name: str) -> PlannerSettings:
        """The planner of a name: one that the file declares, else that of OMPL."""
        return self.planners.get(name) or PlannerSettings(algorithm=name)


def read_planning(
    planning: PlanningEntry, document: Document, findings: list[Finding], *, moves: tuple[MoveKind, ...]
) -> PlanningChoice | None:
    """Planning of moves; None if a quantity is out of its range.

    Args:
        planning: The section.
        document: The file, for positions.
        findings: Collects the problems.
        moves: Kind of each planned move of the task, in order.
    """
    out_of_range = list(_value_findings(planning, document))
    findings.extend(out_of_range)
    findings.extend(_planning_findings(planning, document))
    planners = read_planners(planning.planners, document, findings)
    if out_of_range:
        return None
    settings = PlanningSettings(
        clock=PlanningClock(kind=ClockKind(planning.clock), charge_s=planning.charge_per_check),
        search_limit_s=planning.time_limit or 0.0,
        resolution_rad=planning.resolution,
        verification_resolution_rad=planning.verification_resolution,
        on_unverified=OnUnverified(planning.on_unverified),
        simplification_checks=planning.simplification_checks,
        simplification_limit_s=planning.simplification_limit,
        clearance_m=planning.clearance,
        moves=moves,
    )
    return PlanningChoice(
        settings=settings,
        planner=planning.planner or "",
        time_limit_s=planning.time_limit,
        planners=planners,
        references=planning.references,
    )


def resolution_findings(planning: PlanningChoice, robots: Iterable[Robot], document: Document) -> Iterator[Finding]:
    """A finding for a resolution at which a search would check nothing between two configurations.

    Args:
        planning: The section.
        robots: The arms of the designs.
        document: The study's file, for positions.
    """
    extent_rad = min(
        math.sqrt(math.fsum((joint.upper_rad - joint.lower_rad) ** 2 for joint in robot.joints)) for robot in robots
    )
    resolution_rad = planning.settings.resolution_rad
    if resolution_rad >= extent_rad:
        message = (
            f"resolution of {resolution_rad:g} rad is not below the diagonal of the joints' ranges, "
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
