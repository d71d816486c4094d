"""Compatibility rules for combinations of levels and components."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import prod
from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass as document_dataclass

from rgss.designs.components import Component
from rgss.designs.constraints import Constraint
from rgss.designs.design_values import COMPONENT_PREFIX, numbers
from rgss.designs.parameters import ParameterValue
from rgss.documents import STRICT, Identifier


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternative:
    """Joint values of parameters and components of roles, such as those of a factor's level.

    Attributes:
        parameters: Values in SI by parameter id.
        components: Component ids by role.
    """

    parameters: Mapping[str, ParameterValue] = field(default_factory=dict)
    components: Mapping[str, str] = field(default_factory=dict)

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it is satisfied by a combination."""
        return all(parameters.get(name) == value for name, value in self.parameters.items()) and all(
            role in components and components[role].id == component for role, component in self.components.items()
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """Condition: every named parameter has one of its values, and one alternative of every other name is satisfied.

    Attributes:
        choices: Values in SI by parameter id.
        alternatives: Alternatives of a factor or a role, by its name.
    """

    choices: Mapping[str, tuple[ParameterValue, ...]]
    alternatives: Mapping[str, tuple[Alternative, ...]] = field(default_factory=dict)

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it is satisfied by a combination."""
        return all(parameters.get(name) in allowed for name, allowed in self.choices.items()) and all(
            any(one.holds(parameters, components) for one in some) for some in self.alternatives.values()
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of its parameters and roles."""
        settings = [one for some in self.alternatives.values() for one in some]
        parameters = [name for one in settings for name in one.parameters]
        roles = [f"{COMPONENT_PREFIX}{role}" for one in settings for role in one.components]
        return tuple(dict.fromkeys((*self.choices, *parameters, *roles)))


@document_dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Limit:
    """Upper bound on a product of numbers of the design."""

    product_of: Annotated[tuple[Identifier, ...], Field(min_length=1)]
    at_most: Identifier

    @property
    def names(self) -> tuple[str, ...]:
        """Names of its numbers of the design."""
        return (*self.product_of, self.at_most)

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it is satisfied by a combination, or if a role has no component yet."""
        known = numbers(parameters, components)
        if not set(self.names) <= known.keys():
            return True
        return prod(known[name] for name in self.product_of) <= known[self.at_most]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """Condition on the combinations of designs.

    Attributes:
        id: Its id.
        rationale: The reason.
        when: Condition of the rule; always true if it has no choices.
        require: Required condition; None to exclude all combinations that satisfy `when`.
    """

    id: str
    rationale: str
    when: Condition
    require: Condition | Limit | Constraint | None

    @property
    def names(self) -> tuple[str, ...]:
        """Names of its parameters, roles and numbers of the design."""
        return (*self.when.names, *(self.require.names if self.require is not None else ()))

    def allows(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if a combination satisfies the rule."""
        if not self.when.holds(parameters, components):
            return True
        return self.require is not None and self.require.holds(parameters, components)
