"""Names of filters and rules: parameters, factors with their levels, and roles with their components.

``gripper=three`` after ``--only`` and ``gripper: three`` in a rule select the same designs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rgss.designs.compatibility import Alternative
from rgss.designs.components import Catalogue
from rgss.designs.design_values import COMPONENT_PREFIX, DESIGN_PREFIX, set_names
from rgss.designs.factors import Factor
from rgss.designs.parameters import DesignParameter, ParameterKind, ParameterValue
from rgss.errors import QuantityError


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedValues:
    """Values of a factor or a role, each with its alternative settings.

    Attributes:
        own: Levels of the factor, or components of the role.
        choosing: Further levels that select the component of the role, such as its number of fingers.
    """

    own: Mapping[str, tuple[Alternative, ...]]
    choosing: Mapping[str, tuple[Alternative, ...]]

    def alternatives(self, value: str) -> tuple[Alternative, ...]:
        """Settings of a value, case-insensitive; empty if it is unknown."""
        for known in (self.own, self.choosing):
            spelt = respelt(value, known)
            if spelt in known:
                return known[spelt]
        return ()


@dataclass(frozen=True, slots=True, kw_only=True)
class FilterNames:
    """Names of one design space.

    Attributes:
        parameters: The design parameters.
        factors: The factors.
        catalogue: The components.
        selectors: The parameter values that select each component, by component id.
    """

    parameters: Sequence[DesignParameter]
    factors: Sequence[Factor]
    catalogue: Catalogue
    selectors: Mapping[str, Mapping[str, tuple[ParameterValue, ...]]]

    def parameter(self, name: str) -> DesignParameter | None:
        """Parameter by id, by the quantity that it sets, or by its name if unique.

        The name of a factor with a range refers to its parameter. Case is ignored if the name is then unique.
        """
        ids = {one.id: one for one in self.parameters}
        by_name = {**{one.sets: one for one in self.parameters if one.sets}, **ids}
        bare = respelt(name, by_name)
        if bare not in by_name and name.startswith(DESIGN_PREFIX):
            bare = respelt(name.removeprefix(DESIGN_PREFIX), ids)
        if bare in by_name:
            return by_name[bare]
        ranged = {one.id: ids[one.span.parameter] for one in self.factors if one.span and one.span.parameter in ids}
        if respelt(name, ranged) in ranged:
            return ranged[respelt(name, ranged)]
        if self.values(name) is not None:
            return None
        named = {one.name: one for one in self.parameters}
        return named.get(respelt(name, named))

    def values(self, name: str) -> NamedValues | None:
        """Values of a factor or a role by name; None if there is neither."""
        factors = {one.id: one for one in self.factors if one.span is None}
        roles = [role.id for role in self.catalogue.roles]
        factor = factors.get(respelt(name, factors))
        role = respelt(name.removeprefix(COMPONENT_PREFIX), roles)
        if factor is None and role not in roles:
            return None
        own = {} if factor is None else {one.id: (Alternative(parameters=one.values),) for one in factor.levels}
        choosing: Mapping[str, tuple[Alternative, ...]] = {}
        if role in roles:
            for component in self.catalogue.of_role(role):
                own.setdefault(component.id, (Alternative(components={role: component.id}),))
            choosing = self._levels_that_choose(role)
        return NamedValues(own=own, choosing=choosing)

    def means_level(self, name: str, value: ParameterValue) -> bool:
        """True if a name is also that of a parameter, and a value is a level or a component but no value of it."""
        parameter, named = self.parameter(name), self.values(name)
        if parameter is None or named is None or not named.alternatives(str(value)):
            return False
        if parameter.kind is ParameterKind.NAME:
            set_to = {str(one.values.get(parameter.id)) for factor in self.factors for one in factor.levels}
            return respelt(str(value), set_to) not in set_to
        try:
            parameter.read(int(value) if isinstance(value, str) and value.isdecimal() else value)
        except QuantityError:
            return True
        return False

    def known(self) -> set[str]:
        """All names, without prefixes."""
        parameters = {one.id for one in self.parameters} | {one.name for one in self.parameters}
        roles = {role.id for role in self.catalogue.roles}
        return parameters | {one.id for one in self.factors} | set(set_names(self.parameters)) | roles

    def _levels_that_choose(self, role: str) -> Mapping[str, tuple[Alternative, ...]]:
        parameters = {name for one in self.catalogue.of_role(role) for name in self.selectors.get(one.id, {})}
        found: dict[str, tuple[Alternative, ...]] = {}
        for factor in self.factors:
            for level in factor.levels:
                if parameters & set(level.values):
                    found[level.id] = (*found.get(level.id, ()), Alternative(parameters=level.values))
        return found


def respelt(name: str, known: Iterable[str]) -> str:
    """Known name that differs only in case, if unique; else the name itself."""
    names = list(known)
    if name in names:
        return name
    alike = [one for one in names if one.lower() == name.lower()]
    return alike[0] if len(alike) == 1 else name
