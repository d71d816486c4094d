"""Assumptions of a study that are varied: those of its file, else a list derived from the study."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from rgss.decision.assumptions.names import alternative_in_words, name_in_words
from rgss.decision.what_if import COST, PRICES, assumed_numbers, deciding_readings, model_settings
from rgss.evidence import Fidelity
from rgss.motion import ClockKind
from rgss.studies import Project

_CHARGE = "planning.charge_per_check"
_LIMIT = "planning.time_limit"
FIDELITY = "fidelity"
"""Name of the fidelity among the assumptions."""

_NOMINAL = "uncertainty.nominal"
_CHARGE_FACTORS = (0.5, 2.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """An assumption with an alternative value.

    Attributes:
        about: The assumption, by its name for ``--what-if``.
        alternative: The alternative value.
        title: The assumption in words.
    """

    about: str
    alternative: str
    title: str = ""

    @property
    def instead(self) -> str:
        """The alternative value in words."""
        return alternative_in_words(self.about, self.alternative)

    @property
    def supposition(self) -> str:
        """The text for ``--what-if``."""
        return f"{self.about}={self.alternative}"


def questions_of(project: Project) -> tuple[Question, ...]:
    """The questioned assumptions, each alternative by itself.

    They are those with alternatives in the study's file; if it has none, the charge of a check halved and
    doubled, each planning limit of a design for all designs, the world without uncertainty, kinematic trials, and
    assumed prices of 0. Readings of the source that decide something follow from the measures' file.
    """
    listed = [
        Question(about=one.about, alternative=alternative)
        for one in project.study.assumptions
        for alternative in one.alternatives
    ]
    readings = [Question(about=one.id, alternative=one.alternative) for one in deciding_readings(project)]
    found = dict.fromkeys((*(listed or _derived(project)), *readings))
    return tuple(replace(one, title=name_in_words(project, one.about)) for one in found)


def _derived(project: Project) -> Iterator[Question]:
    study, settings = project.study, model_settings(project)
    clock = study.planning.settings.clock
    if clock.kind is ClockKind.COUNTED:
        for factor in _CHARGE_FACTORS:
            charge_ms = 1e3 * factor * clock.charge_s
            yield Question(about=_CHARGE, alternative=f"{charge_ms:g} ms")
    setting = {parameter.id for parameter in project.designs.parameters if parameter.sets == _LIMIT}
    limits = {float(one.parameters[name]) for one in project.designs.expand() for name in setting}
    if len(limits) > 1 and _LIMIT in settings:
        for limit in sorted(limits):
            yield Question(about=_LIMIT, alternative=f"{limit:g} s")
    if project.uncertainty.values or project.workload.cases:
        yield Question(about=_NOMINAL, alternative="true")
    if study.fidelity is not Fidelity.KINEMATIC:
        yield Question(about=FIDELITY, alternative=Fidelity.KINEMATIC.value)
    if any(number.name == COST and number.value > 0.0 for number in assumed_numbers(project)):
        yield Question(about=PRICES, alternative="0")
