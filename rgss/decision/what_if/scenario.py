"""Project under suppositions."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.decision.what_if.readings import Reading
from rgss.decision.what_if.setting import SettingChange
from rgss.studies import Project


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One thing that is supposed to be another.

    Attributes:
        id: What it is, such as ``weight.t_e``.
        before: Its value.
        after: The value that is supposed.
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
        project: The project as it would be.
        changes: The suppositions, in the order given.
        rescaled: The weights that follow from the supposed ones: the others keep their
            proportions so that all sum to 1.
        dropped: Variants that the rules of the design space would no longer allow.
        simulated: The numbers that the trials were simulated with, by id: what trials showed is
            held, though another value needs other trials.
        readings: Other readings of the source that are supposed.
        settings: Modelling assumptions that are supposed, which trials are made with.
    """

    project: Project
    changes: tuple[Change, ...]
    rescaled: tuple[Change, ...]
    dropped: tuple[int, ...]
    simulated: tuple[str, ...]
    readings: tuple[Reading, ...] = ()
    settings: tuple[SettingChange, ...] = ()
