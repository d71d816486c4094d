"""Suppositions on weights, thresholds, anchors of values and numbers of the model."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from rgss.decision.moved_thresholds import with_thresholds
from rgss.decision.preference_model import quantity_of
from rgss.decision.what_if.absent import absent_input
from rgss.decision.what_if.demands import THRESHOLD, demand_numbers, share_checked
from rgss.decision.what_if.modelling import model_settings, with_setting
from rgss.decision.what_if.numbers import CATALOGUE, COST, MEASURES, assumed_numbers, model_numbers, with_number
from rgss.decision.what_if.readings import READING, Reading, with_reading
from rgss.decision.what_if.scenario import Change, Scenario
from rgss.decision.what_if.setting import SettingChange, quantity_from
from rgss.decision.what_if.shapes import SHAPE, curvature_names, with_curvature
from rgss.decision.what_if.simulated import simulated_numbers
from rgss.decision.what_if.unknown_input import UnknownSuppositionError, unknown_input
from rgss.decision.what_if.weights import with_weights
from rgss.errors import DefinitionError, EvidenceError
from rgss.findings import shown
from rgss.studies import Project, value_anchors
from rgss.tradeoff import weights_of_criteria
from rgss.tradeoff.problem import EVIDENCE_PREFIX

WEIGHT, VALUE = "weight", "value"
PRICES = "prices"
"""A factor on every assumed price of the catalogue."""

EXAMPLE = 'weight.t_p=0.4, "SYS-012.threshold=0.8 kg" or "catalogue.kg-2-light.cost=4500 USD"'


def suppose(project: Project, suppositions: Sequence[str]) -> Scenario:
    """Read suppositions and apply them to a project, without a simulation.

    Args:
        project: The project with its study.
        suppositions: Texts such as ``weight.t_p=0.4`` or ``SYS-012.threshold=0.8 kg``.

    Raises:
        DefinitionError: A text is malformed, has an unknown name or a value of another unit,
            or a supposition is given twice.
        TradeoffError: The weights that follow contradict each other or what was elicited.
    """
    supposing = _Supposing(project)
    for text in suppositions:
        supposing.add(text)
    return supposing.scenario()


class _Supposing:
    """Suppositions that are applied to a project one after another."""

    def __init__(self, project: Project) -> None:
        self._project = self._changed = project
        self._changes: list[Change] = []
        self._weights: dict[str, float] = {}
        self._readings: list[Reading] = []
        self._settings: list[SettingChange] = []
        self._named: set[str] = set()

    def add(self, text: str) -> None:
        """Apply a supposition."""
        name, value = _split(text)
        name = _full_name(self._project, name)
        if name in {*self._named, *(change.id for change in self._changes)}:
            raise DefinitionError(f"--what-if: {name} is supposed twice", hint="suppose it once")
        self._named.add(name)
        if name.partition(".")[0] == READING:
            reading, self._changed = with_reading(self._changed, name, value)
            self._readings.append(reading)
        elif name in model_settings(self._changed):
            setting, self._changed = with_setting(self._changed, name, value)
            self._settings.append(setting)
        elif name == PRICES:
            prices, self._changed = _prices(self._changed, value)
            self._changes += prices
        else:
            change, self._changed = self._number(name, value)
            self._changes.append(change)

    def _number(self, name: str, value: str) -> tuple[Change, Project]:
        """The change of one number, and the project with it; weights are changed together at the end."""
        changed = self._changed
        kind, _, rest = name.partition(".")
        demand, _, field = name.rpartition(".")
        if kind == WEIGHT:
            change = _weight(self._project, name, rest, value)
            self._weights[rest] = change.after
            return change, changed
        if kind == VALUE:
            return _anchor(changed, name, rest, value)
        if kind == SHAPE:
            return _curvature(changed, name, value)
        if kind in (CATALOGUE, MEASURES):
            return _number(changed, name, value)
        if name in demand_numbers(changed):
            return _demand(changed, name, value)
        if field == THRESHOLD:
            return _threshold(changed, name, demand, value)
        raise absent_input(changed, name) or _no_input(self._project, name)

    def scenario(self) -> Scenario:
        """The project under all suppositions, with what they change."""
        project, changed = self._project, self._changed
        rescaled: tuple[Change, ...] = ()
        if self._weights:
            changed, rescaled = _reweighted(changed, self._weights)
        anchors = value_anchors(changed.study.trade_off, partial(quantity_of, changed))
        changed = replace(changed, study=replace(changed.study, values=anchors))
        return Scenario(
            project=changed,
            changes=tuple(self._changes),
            rescaled=rescaled,
            dropped=_dropped(project, changed),
            simulated=_simulated(project, self._changes),
            readings=tuple(self._readings),
            settings=tuple(self._settings),
        )


def _reweighted(project: Project, weights: Mapping[str, float]) -> tuple[Project, tuple[Change, ...]]:
    """The project with some weights changed, and the resulting changes of the others."""
    before = dict(project.study.trade_off.weighting.weights)
    trade_off = with_weights(project.study.trade_off, weights)
    after = trade_off.weighting.weights
    rescaled = tuple(
        Change(id=f"{WEIGHT}.{measure}", before=before[measure], after=after[measure], unit="1")
        for measure in after
        if measure not in weights and not math.isclose(before[measure], after[measure], abs_tol=1e-12)
    )
    return replace(project, study=replace(project.study, trade_off=trade_off)), rescaled


def _dropped(before: Project, after: Project) -> tuple[int, ...]:
    """The variants that the rules of the design space no longer allow.

    Raises:
        EvidenceError: They allow variants that they did not allow before.
        DefinitionError: They allow no variant.
    """
    there = {variant.id for variant in after.designs.expand()}
    was_there = {variant.id for variant in before.designs.expand()}
    if there - was_there:
        raise EvidenceError(
            f"--what-if: variants {', '.join(map(str, sorted(there - was_there)))} would become possible, "
            "and no trial was run with them",
            hint="change the catalogue and run 'rgss sweep'",
        )
    if not there:
        raise DefinitionError(
            "--what-if: the rules of the design space would then allow no variant", hint="suppose a smaller change"
        )
    return tuple(sorted(was_there - there))


def _simulated(project: Project, changes: Sequence[Change]) -> tuple[str, ...]:
    named = {change.id for change in changes}
    numbers = [number for number in model_numbers(project) if number.component and number.id in named]
    found = simulated_numbers(project, project.designs.expand(), numbers) if numbers else frozenset()
    return tuple(number.id for number in numbers if number.id in found)


def _split(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    name, value = name.strip(), value.strip()
    if not equals or not name or not value:
        raise DefinitionError(f"--what-if: supposition must be NAME=VALUE, got {shown(text)}", hint=f"write {EXAMPLE}")
    return name, value


def _full_name(project: Project, name: str) -> str:
    """Full name of a number, which pages may print without its kind: ``t_e`` of a weight, ``SYS-012`` of a threshold.

    Raises:
        DefinitionError: It is the name of a condition without a number.
    """
    if name.startswith(EVIDENCE_PREFIX):
        raise DefinitionError(
            f"--what-if: {shown(name)} requires that a measure is known, and has no threshold to suppose",
            hint="run trials that show it, or suppose another threshold",
        )
    trade_off = project.study.trade_off
    threshold = f"{name}.{THRESHOLD}"
    if threshold in _requirements(project) or threshold in demand_numbers(project):
        return threshold
    if name in trade_off.weighting.weights or name in weights_of_criteria(trade_off.criteria):
        return f"{WEIGHT}.{name}"
    return name


def _demand(project: Project, name: str, text: str) -> tuple[Change, Project]:
    number = demand_numbers(project)[name]
    after = quantity_from(name, text, number.unit)
    if not name.endswith(f".{THRESHOLD}"):
        share_checked(name, after)
    study = replace(project.study, trade_off=number.changed(project.study.trade_off, after))
    return Change(id=name, before=number.value, after=after, unit=number.unit), replace(project, study=study)


def _weight(project: Project, name: str, criterion: str, text: str) -> Change:
    trade_off = project.study.trade_off
    known = {**trade_off.weighting.weights, **weights_of_criteria(trade_off.criteria)}
    if criterion not in known:
        raise unknown_input(name, [f"{WEIGHT}.{other}" for other in known], criterion)
    after = quantity_from(name, text, "1")
    if not 0.0 <= after <= 1.0:
        raise DefinitionError(f"--what-if: {name} must be from 0 to 1, got {after:g}", hint="give a share of the whole")
    return Change(id=name, before=known[criterion], after=after, unit="1")


def _threshold(project: Project, name: str, requirement_id: str, text: str) -> tuple[Change, Project]:
    known = [*_requirements(project), *demand_numbers(project)]
    if f"{requirement_id}.{THRESHOLD}" not in known:
        raise unknown_input(name, known, requirement_id)
    requirement = project.requirements.requirement(requirement_id)
    criterion = requirement.criterion
    if criterion is None:
        raise unknown_input(name, known, requirement_id)
    unit = project.measures.measure(criterion.measure).unit
    after = quantity_from(name, text, unit)
    change = Change(id=name, before=criterion.threshold_in(unit), after=after, unit=unit)
    return change, with_thresholds(project, {requirement_id: after})


def _anchor(project: Project, name: str, rest: str, text: str) -> tuple[Change, Project]:
    trade_off = project.study.trade_off
    known = {
        f"{VALUE}.{valued.measure}.{anchor}": (valued, anchor)
        for valued in trade_off.valued
        for anchor in valued.anchors
    }
    if name not in known:
        raise unknown_input(name, known, rest)
    valued, anchor = known[name]
    unit = project.measures.measure(valued.measure).unit
    after = quantity_from(name, text, unit)
    before = quantity_of(project, valued.anchors[anchor], valued.measure)
    moved = tuple(one.with_anchor(anchor, after) if one is valued else one for one in trade_off.valued)
    change = Change(id=name, before=before, after=after, unit=unit)
    return change, replace(project, study=replace(project.study, trade_off=replace(trade_off, valued=moved)))


def _curvature(project: Project, name: str, text: str) -> tuple[Change, Project]:
    known = curvature_names(project)
    if name not in known:
        raise unknown_input(name, known, name.partition(".")[2])
    after = quantity_from(name, text, "1")
    return Change(id=name, before=0.0, after=after, unit="1"), with_curvature(project, name, after)


def _number(project: Project, name: str, text: str) -> tuple[Change, Project]:
    known = {number.id: number for number in model_numbers(project)}
    if name not in known:
        raise unknown_input(name, known, name)
    number = known[name]
    after = quantity_from(name, text, number.unit)
    if after < 0.0 <= number.value:
        raise DefinitionError(f"--what-if: {name} must be at least 0, got {after:g}", hint="give a number such as 0")
    return Change(id=name, before=number.value, after=after, unit=number.unit), with_number(project, number, after)


def _prices(project: Project, text: str) -> tuple[list[Change], Project]:
    """Every assumed price of the catalogue times a factor."""
    factor = quantity_from(PRICES, text, "1")
    if factor < 0.0:
        raise DefinitionError(f"--what-if: {PRICES} must be a factor of at least 0, got {factor:g}")
    changes = []
    for number in assumed_numbers(project):
        if number.name == COST:
            after = factor * number.value
            changes.append(Change(id=number.id, before=number.value, after=after, unit=number.unit))
            project = with_number(project, number, after)
    if not changes:
        raise DefinitionError(f"--what-if: no price is assumed, so that {PRICES} changes nothing")
    return changes, project


def _requirements(project: Project) -> list[str]:
    return [f"{one.id}.{THRESHOLD}" for one in project.requirements.system if one.criterion is not None]


def _no_input(project: Project, name: str) -> UnknownSuppositionError:
    kinds = [WEIGHT, VALUE, CATALOGUE, MEASURES, SHAPE, READING, PRICES, *model_settings(project)]
    return unknown_input(name, [*kinds, *_requirements(project), *demand_numbers(project)], name)
