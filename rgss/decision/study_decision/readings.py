"""Decisions under each reading of the source."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.decision.assumptions import AssumptionOutcome
from rgss.decision.choosing import choose
from rgss.decision.what_if import Reading, deciding_readings, measured_in, suppose
from rgss.errors import RgssError
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadingOutcome:
    """Choice under one reading of the source.

    Attributes:
        reading: The reading.
        chosen: The variant that is then chosen; None if none is.
        feasible: Number of variants that then meet every requirement.
        reason: Reason for a missing answer; empty if there is one.
    """

    reading: Reading
    chosen: int | None
    feasible: int
    reason: str = ""


def reading_outcomes(project: Project, measured: Sequence[VariantMeasures]) -> tuple[ReadingOutcome, ...]:
    """The choice under each alternative of each measure that decides something, one at a time, from the stored trials.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records.
    """
    return tuple(_outcome(project, measured, reading) for reading in deciding_readings(project))


def readings_among(project: Project, outcomes: Sequence[AssumptionOutcome]) -> tuple[ReadingOutcome, ...]:
    """The readings of the source, all of which are among the questioned assumptions.

    Args:
        project: The project with its study.
        outcomes: The choice under each alternative of each assumption.
    """
    by_name = {one.question.supposition: one for one in outcomes}
    pairs = ((reading, by_name[reading.supposition]) for reading in deciding_readings(project))
    return tuple(
        ReadingOutcome(reading=reading, chosen=one.chosen, feasible=one.feasible, reason=one.reason)
        for reading, one in pairs
    )


def _outcome(project: Project, measured: Sequence[VariantMeasures], reading: Reading) -> ReadingOutcome:
    try:
        scenario = suppose(project, [reading.supposition])
        decision = choose(scenario.project, measured_in(scenario, measured))
    except RgssError as error:
        return ReadingOutcome(reading=reading, chosen=None, feasible=0, reason=error.message)
    return ReadingOutcome(reading=reading, chosen=decision.chosen, feasible=decision.counts.feasible)
