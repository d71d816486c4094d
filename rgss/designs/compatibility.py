"""Rules that say which combinations of levels and components make a design."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
class Condition:
    """Holds when every named parameter has, and every named role is filled by, one of its values.

    Attributes:
        choices: Values in SI by parameter id, and component ids by ``component.<role>``.
    """

    choices: Mapping[str, tuple[ParameterValue, ...]]

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it holds for a combination."""
        for name, allowed in self.choices.items():
            if name.startswith(COMPONENT_PREFIX):
                component = components.get(name.removeprefix(COMPONENT_PREFIX))
                if component is None or component.id not in allowed:
                    return False
            elif parameters.get(name) not in allowed:
                return False
        return True

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters and roles that it names."""
        return tuple(self.choices)


@document_dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Limit:
    """A product of numbers of the design, and what it may not exceed."""

    product_of: Annotated[tuple[Identifier, ...], Field(min_length=1)]
    at_most: Identifier

    @property
    def names(self) -> tuple[str, ...]:
        """The numbers of the design that it names."""
        return (*self.product_of, self.at_most)

    def holds(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if it holds for a combination; it does where a role has no component yet."""
        known = numbers(parameters, components)
        if not set(self.names) <= known.keys():
            return True
        return prod(known[name] for name in self.product_of) <= known[self.at_most]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """Condition that a combination must satisfy to be a design.

    Attributes:
        id: Its id.
        rationale: The reason.
        when: Condition of the rule; always true if it has no choices.
        require: Condition that must hold there; None where nothing that it applies to is a design.
    """

    id: str
    rationale: str
    when: Condition
    require: Condition | Limit | Constraint | None

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters, roles and numbers of the design that it names."""
        return (*self.when.names, *(self.require.names if self.require is not None else ()))

    def allows(self, parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> bool:
        """True if a combination satisfies the rule."""
        if not self.when.holds(parameters, components):
            return True
        return self.require is not None and self.require.holds(parameters, components)
