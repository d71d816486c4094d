"""Alternative readings of the source for what-ifs, such as ``reading.S=share_of_states``."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, replace

from rgss.decision.preference_model import deciding_measures
from rgss.errors import DefinitionError
from rgss.findings import shown
from rgss.measures import with_alternative
from rgss.studies import Project

READING = "reading"


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """Alternative reading of a measure's source.

    Attributes:
        measure: The measure.
        alternative: Id of the alternative.
        rationale: Reason for this reading of the source.
    """

    measure: str
    alternative: str
    rationale: str

    @property
    def id(self) -> str:
        """The name for ``--what-if``, such as ``reading.S``."""
        return f"{READING}.{self.measure}"

    @property
    def supposition(self) -> str:
        """The text that supposes it, such as ``reading.S=share_of_states``."""
        return f"{self.id}={self.alternative}"


def readings_of(project: Project) -> tuple[Reading, ...]:
    """Every alternative of the project's measures, in the order of the file."""
    return tuple(
        Reading(measure=measure.id, alternative=one.id, rationale=one.rationale)
        for measure in project.measures.measures
        for one in measure.alternatives
    )


def deciding_readings(project: Project) -> tuple[Reading, ...]:
    """The alternatives of measures that the choice reads, and of those that these use.

    Raises:
        TradeoffError: As for `deciding_measures`.
        DefinitionError: As for `deciding_measures`.
    """
    deciding = frozenset(deciding_measures(project))
    used = deciding.union(*(project.measures.used[measure] for measure in deciding))
    return tuple(reading for reading in readings_of(project) if reading.measure in used)


def with_reading(project: Project, name: str, alternative: str) -> tuple[Reading, Project]:
    """A reading by its name, and the project with it.

    Args:
        project: The project.
        name: Name of the measure with its kind, such as ``reading.S``.
        alternative: Id of the alternative.

    Raises:
        DefinitionError: There is no such reading.
    """
    readings = {one.supposition: one for one in readings_of(project)}
    supposition = f"{name}={alternative}"
    if supposition not in readings:
        near = difflib.get_close_matches(supposition, readings, n=3) or list(readings)[:4]
        hint = f"such as {', '.join(near)}" if near else "give a measure 'alternatives' in the measures file"
        raise DefinitionError(f"--what-if: unknown reading {shown(supposition)}", hint=hint)
    found = readings[supposition]
    return found, replace(project, measures=with_alternative(project.measures, found.measure, found.alternative))
