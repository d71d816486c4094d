"""Values of each factor and role as columns over variants, for filters outside of this package."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rgss.designs.choosing.filter_names import FilterNames, respelt
from rgss.designs.space import DesignSpace
from rgss.designs.variants import DesignVariant


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueColumn:
    """Some values of a factor or a role, of which each variant has at most one.

    Attributes:
        name: The factor or the role.
        values: The values.
        entries: The index of the value of each variant; -1 without one of them.
    """

    name: str
    values: tuple[str, ...]
    entries: tuple[int, ...]


def value_columns(space: DesignSpace, variants: Sequence[DesignVariant]) -> tuple[ValueColumn, ...]:
    """Values that filters accept of factors and roles, such as ``gripper=three``.

    Values that a variant has at the same time, such as a component and the level that selects it, are in different
    columns of the same name.
    """
    names = FilterNames(
        parameters=space.parameters, factors=space.factors, catalogue=space.catalogue, selectors=space.selectors
    )
    found: list[ValueColumn] = []
    for name in dict.fromkeys([*(one.id for one in space.factors), *(role.id for role in space.catalogue.roles)]):
        columns: list[tuple[list[str], list[int]]] = []
        for value, places in _places(names, name, variants):
            free = (one for one in columns if all(one[1][place] < 0 for place in places))
            values, entries = next(free, ([], [-1] * len(variants)))
            if not values:
                columns.append((values, entries))
            for place in places:
                entries[place] = len(values)
            values.append(value)
        found += [ValueColumn(name=name, values=tuple(one[0]), entries=tuple(one[1])) for one in columns]
    return tuple(found)


def _places(names: FilterNames, name: str, variants: Sequence[DesignVariant]) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Each value of a name with the places of the variants that have it."""
    values = names.values(name)
    if values is None:
        return
    for value in (*values.own, *(one for one in values.choosing if respelt(one, values.own) not in values.own)):
        some = values.alternatives(value)
        yield (
            value,
            tuple(
                place
                for place, one in enumerate(variants)
                if any(alternative.holds(one.parameters, one.components) for alternative in some)
            ),
        )
