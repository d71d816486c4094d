"""Project under suppositions."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.decision.what_if.readings import Reading
from rgss.decision.what_if.setting import SettingChange
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Supposed change of a value.

    Attributes:
        id: Name of the value, such as ``weight.t_e``.
        before: Its value.
        after: The supposed value.
        unit: The unit of both.
    """

    id: str
    before: float
    after: float
    unit: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A project under suppositions.

    Attributes:
        project: The changed project.
        changes: The suppositions, in the order given.
        rescaled: The weights that follow from the supposed ones: the others keep their
            proportions so that all sum to 1.
        dropped: Variants that the rules of the design space would no longer allow.
        simulated: Ids of the numbers that the trials were simulated with: results of trials are
            held fixed, although another value would need other trials.
        readings: Supposed readings of the source.
        settings: Supposed modelling assumptions, which change the trials.
    """

    project: Project
    changes: tuple[Change, ...]
    rescaled: tuple[Change, ...]
    dropped: tuple[int, ...]
    simulated: tuple[str, ...]
    readings: tuple[Reading, ...] = ()
    settings: tuple[SettingChange, ...] = ()
