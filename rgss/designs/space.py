"""The design space: factors whose levels multiply into variants, or are sampled."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from rgss.designs.compatibility import Rule
from rgss.designs.components import Catalogue, Component
from rgss.designs.design_values import source_units
from rgss.designs.factors import Factor, Level
from rgss.designs.parameters import DesignParameter, ParameterValue
from rgss.designs.sampling import Sample
from rgss.designs.variants import DesignVariant
from rgss.errors import DefinitionError


@dataclass(frozen=True, slots=True, kw_only=True)
class ExcludedCombination:
    """A combination of levels that rules exclude.

    Attributes:
        id: The id that it would have as a variant.
        levels: The id of its level of each factor, by factor.
        rules: The ids of the rules that exclude it.
    """

    id: int
    levels: Mapping[str, str]
    rules: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignSpace:
    """Every design that is open to choice.

    Attributes:
        parameters: The design parameters.
        constants: The values of those that do not vary, in SI, by parameter id.
        factors: The factors, outermost first: the last factor varies fastest.
        rules: Rules for the combinations that make a design.
        catalogue: The components.
        selectors: The parameter values in SI that select each component, by component id.
        sample: The points that are tried; None if every combination of levels is.
    """

    parameters: tuple[DesignParameter, ...]
    constants: Mapping[str, ParameterValue]
    factors: tuple[Factor, ...]
    rules: tuple[Rule, ...]
    catalogue: Catalogue
    selectors: Mapping[str, Mapping[str, tuple[ParameterValue, ...]]]
    sample: Sample | None = None

    def expand(self) -> tuple[DesignVariant, ...]:
        """Every variant that the rules allow, by id."""
        return tuple(
            DesignVariant(
                id=number,
                parameters=parameters,
                components=self.components_of(parameters),
                levels=levels,
                definitions=self.parameters,
            )
            for number, levels, parameters in self.combinations()
            if not self.rules_against(parameters)
        )

    def excluded(self) -> tuple[ExcludedCombination, ...]:
        """Every combination that a rule excludes, by id."""
        found = []
        for number, levels, parameters in self.combinations():
            rules = self.rules_against(parameters)
            if rules:
                found.append(ExcludedCombination(id=number, levels=levels, rules=rules))
        return tuple(found)

    def variant(self, number: int) -> DesignVariant:
        """The variant with an id.

        Raises:
            DefinitionError: There is none.
        """
        variants = self.expand()
        for variant in variants:
            if variant.id == number:
                return variant
        known = f"from {variants[0].id} to {variants[-1].id}" if variants else "none"
        raise DefinitionError(f"unknown variant {number}", hint=f"ids of variants: {known}")

    def source_units(self) -> Mapping[str, str]:
        """The SI unit of everything that `rgss.designs.design_values` gives, by name; empty for names."""
        return source_units(self.parameters, self.catalogue)

    def combinations(self) -> Iterator[tuple[int, Mapping[str, str], Mapping[str, ParameterValue]]]:
        """Every enumerated combination of levels: its number, its levels by factor, and its parameters.

        They are the full product, numbered from 1; or the points of the sample that repeat no other.
        """
        for number, levels in self._points():
            values = dict(self.constants)
            for level in levels:
                values.update(level.values)
            ids = {factor.id: level.id for factor, level in zip(self.factors, levels, strict=True)}
            yield number, ids, {item.id: values[item.id] for item in self.parameters if item.id in values}

    def _points(self) -> Iterable[tuple[int, tuple[Level, ...]]]:
        if self.sample is not None:
            return self.sample.points.items()
        return enumerate(itertools.product(*(factor.levels for factor in self.factors)), start=1)

    def candidates(self, role: str, parameters: Mapping[str, ParameterValue]) -> tuple[Component, ...]:
        """The components of a role that parameter values select."""
        return tuple(
            component
            for component in self.catalogue.of_role(role)
            if all(parameters.get(name) in values for name, values in self.selectors[component.id].items())
        )

    def components_of(self, parameters: Mapping[str, ParameterValue]) -> Mapping[str, Component]:
        """The component of each role for which parameter values select exactly one."""
        found = {role.id: self.candidates(role.id, parameters) for role in self.catalogue.roles}
        return {role: candidates[0] for role, candidates in found.items() if len(candidates) == 1}

    def rules_against(self, parameters: Mapping[str, ParameterValue]) -> tuple[str, ...]:
        """The ids of the rules that exclude a combination; empty where it is a design."""
        components = self.components_of(parameters)
        return tuple(rule.id for rule in self.rules if not rule.allows(parameters, components))
