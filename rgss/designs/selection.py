"""Check that every design selects exactly one component for each role."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rgss.designs.components import Component
from rgss.designs.document import DesignSpaceModel
from rgss.designs.parameters import ParameterValue, format_value
from rgss.designs.space import DesignSpace
from rgss.documents import Document
from rgss.findings import Finding


def selection_findings(space: DesignSpace, document: Document, model: DesignSpaceModel) -> Iterator[Finding]:
    """Findings for combinations without a component or with several for a role, each once.

    Invalid values are not in the space and not checked here; with invalid rules nothing is checked, since they might
    exclude a combination without a component.

    Args:
        space: The valid part of a design space.
        document: Its file.
        model: The entry of the file.
    """
    if len(space.rules) < len(model.rules):
        return
    selecting = _selecting_parameters(space)
    seen: set[tuple[str, tuple[ParameterValue, ...]]] = set()
    allowed = 0
    exclusions: set[tuple[str, ...]] = set()
    for _, levels, parameters in space.combinations():
        excluding = space.rules_against(parameters)
        if excluding:
            exclusions.add(excluding)
            continue
        allowed += 1
        for role, names in selecting.items():
            if not all(name in parameters for name in names):
                continue
            values = tuple(parameters[name] for name in names)
            if (role, values) in seen:
                continue
            seen.add((role, values))
            candidates = space.candidates(role, parameters)
            if len(candidates) == 1:
                continue
            where = _Combination(space=space, role=role, values=dict(zip(names, values, strict=True)), levels=levels)
            yield where.several(candidates) if candidates else where.none(document, model)
    if not allowed:
        yield _nothing_left(document, model, exclusions)


def _nothing_left(document: Document, model: DesignSpaceModel, exclusions: Collection[tuple[str, ...]]) -> Finding:
    """Finding for rules that exclude every combination, at the last of the fewest that do.

    Args:
        document: The file of the design space.
        model: The entry of the file.
        exclusions: The sets of rules that exclude a combination.
    """
    ids = [rule.id for rule in model.rules]
    fewest = _fewest_excluding(ids, exclusions)
    if not fewest:
        hint = "loosen a rule, or add levels"
        return document.finding(
            "design.nothing-left", "the rules exclude every combination", ("rules",), hint=hint, at_key=True
        )
    names = [repr(one) for one in fewest]
    if len(names) == 1:
        message = f"the rule {names[0]} alone excludes every combination"
        hint = "loosen it, or add levels that it allows"
    else:
        message = f"the rules {', '.join(names[:-1])} and {names[-1]} together exclude every combination"
        hint = "loosen one of them, or add levels that they allow"
    return document.finding("design.nothing-left", message, ("rules", ids.index(fewest[-1])), hint=hint)


def _fewest_excluding(ids: Sequence[str], exclusions: Collection[tuple[str, ...]]) -> tuple[str, ...]:
    """The single rule, or the first pair, that excludes every combination; else rules of which none can be left out.

    Args:
        ids: The rules, in their order.
        exclusions: The sets of rules that exclude a combination.
    """
    for size in (1, 2):
        for some in itertools.combinations(ids, size):
            if all(not set(some).isdisjoint(rules) for rules in exclusions):
                return some
    needed = list(ids)
    for one in reversed(ids):
        others = set(needed) - {one}
        if all(not others.isdisjoint(rules) for rules in exclusions):
            needed.remove(one)
    return tuple(needed)


def _selecting_parameters(space: DesignSpace) -> Mapping[str, tuple[str, ...]]:
    """Parameters that select the components of each role with valid matches."""
    selecting = {}
    for role in space.catalogue.roles:
        components = space.catalogue.of_role(role.id)
        selectors = [space.selectors[component.id] for component in components]
        written = [component.matches for component in components]
        if all(
            len(read[name]) == len(values)
            for read, match in zip(selectors, written, strict=True)
            for name, values in match.items()
        ):
            selecting[role.id] = tuple(dict.fromkeys(name for read in selectors for name in read))
    return selecting


@dataclass(frozen=True, slots=True, kw_only=True)
class _Combination:
    """Values of the parameters that select the component of a role, and their origin."""

    space: DesignSpace
    role: str
    values: Mapping[str, ParameterValue]
    levels: Mapping[str, str]

    def none(self, document: Document, model: DesignSpaceModel) -> Finding:
        message = f"no {self.role} in the catalogue matches {self._words()}"
        hint = "add a component, or a rule that excludes the combination"
        return document.finding("design.no-component", message, self._location(model), hint=hint)

    def several(self, candidates: tuple[Component, ...]) -> Finding:
        catalogue = self.space.catalogue
        index = catalogue.components.index(candidates[1])
        ids = ", ".join(component.id for component in candidates)
        where = f" where {self._words()}" if self.values else " in every design"
        message = f"{len(candidates)} components fill the role {self.role!r}{where}: {ids}"
        hint = "make their 'matches' distinct"
        location = ("components", index, "matches" if candidates[1].matches else "id")
        return catalogue.document.finding("design.several-components", message, location, hint=hint)

    def _words(self) -> str:
        units = {parameter.id: parameter.unit for parameter in self.space.parameters}
        return ", ".join(f"{name} = {format_value(value, units[name])}" for name, value in self.values.items())

    def _location(self, model: DesignSpaceModel) -> tuple[str | int, ...]:
        """Location where the innermost factor sets one of the values; else that of a constant."""
        for index, factor in reversed(list(enumerate(model.factors))):
            if factor.parameter in self.values:
                return ("factors", index, "range")
            for number, level in enumerate(factor.levels or ()):
                for name in self.values:
                    if self.levels.get(factor.id) == level.id and name in level.sets:
                        return ("factors", index, "levels", number, "sets", name)
        return ("constants", *list(self.values)[:1])
