"""Design space: variants by the full factorial of the factors' levels, or by sampling."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

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
    """Combination of levels excluded by rules.

    Attributes:
        id: The id that it would have as a variant.
        levels: The id of its level of each factor, by factor.
        rules: The ids of the rules that exclude it.
    """

    id: int
    levels: Mapping[str, str]
    rules: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class DesignSpace:
    """Design space.

    Attributes:
        parameters: The design parameters.
        constants: Values of the constant parameters, in SI, by parameter id.
        factors: The factors, outermost first: the last factor varies fastest.
        rules: Compatibility rules.
        catalogue: The components.
        selectors: The parameter values in SI that select each component, by component id.
        sample: The sample; None for the full factorial.
    """

    parameters: tuple[DesignParameter, ...]
    constants: Mapping[str, ParameterValue]
    factors: tuple[Factor, ...]
    rules: tuple[Rule, ...]
    catalogue: Catalogue
    selectors: Mapping[str, Mapping[str, tuple[ParameterValue, ...]]]
    sample: Sample | None = None

    def expand(self) -> tuple[DesignVariant, ...]:
        """Variants allowed by the rules, by id."""
        return self._variants

    def excluded(self) -> tuple[ExcludedCombination, ...]:
        """Combinations excluded by a rule, by id."""
        return self._excluded

    @cached_property
    def _excluded(self) -> tuple[ExcludedCombination, ...]:
        found = []
        for number, levels, parameters in self.combinations():
            rules = self.rules_against(parameters)
            if rules:
                found.append(ExcludedCombination(id=number, levels=levels, rules=rules))
        return tuple(found)

    def variant(self, number: int) -> DesignVariant:
        """Variant by id.

        Raises:
            DefinitionError: The id is unknown.
        """
        found = self._by_id.get(number)
        if found is not None:
            return found
        variants = self.expand()
        known = f"from {variants[0].id} to {variants[-1].id}" if variants else "none"
        raise DefinitionError(f"unknown variant {number}", hint=f"ids of variants: {known}")

    def source_units(self) -> Mapping[str, str]:
        """SI unit of each value of `rgss.designs.design_values`, by name; empty for names."""
        return source_units(self.parameters, self.catalogue)

    def combinations(self) -> Iterator[tuple[int, Mapping[str, str], Mapping[str, ParameterValue]]]:
        """Enumerated combinations of levels: number, levels by factor, and parameters.

        They are the full factorial, numbered from 1, or the distinct points of the sample.
        """
        for number, levels in self._points():
            values = dict(self.constants)
            for level in levels:
                values.update(level.values)
            ids = {factor.id: level.id for factor, level in zip(self.factors, levels, strict=True)}
            yield number, ids, {item.id: values[item.id] for item in self.parameters if item.id in values}

    @cached_property
    def _variants(self) -> tuple[DesignVariant, ...]:
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

    @cached_property
    def _by_id(self) -> Mapping[int, DesignVariant]:
        return {variant.id: variant for variant in self._variants}

    def _points(self) -> Iterable[tuple[int, tuple[Level, ...]]]:
        if self.sample is not None:
            return self.sample.points.items()
        return enumerate(itertools.product(*(factor.levels for factor in self.factors)), start=1)

    def candidates(self, role: str, parameters: Mapping[str, ParameterValue]) -> tuple[Component, ...]:
        """Components of a role selected by parameter values."""
        return tuple(
            component
            for component in self.catalogue.of_role(role)
            if all(parameters.get(name) in values for name, values in self.selectors[component.id].items())
        )

    def components_of(self, parameters: Mapping[str, ParameterValue]) -> Mapping[str, Component]:
        """Component of each role for which parameter values select exactly one."""
        found = {role.id: self.candidates(role.id, parameters) for role in self.catalogue.roles}
        return {role: candidates[0] for role, candidates in found.items() if len(candidates) == 1}

    def rules_against(self, parameters: Mapping[str, ParameterValue]) -> tuple[str, ...]:
        """Ids of the rules that exclude a combination; empty for a design."""
        components = self.components_of(parameters)
        return tuple(rule.id for rule in self.rules if not rule.allows(parameters, components))
