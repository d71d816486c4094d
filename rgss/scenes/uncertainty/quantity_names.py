"""Names of uncertain quantities: those of the registry, and those of the further objects of a scene.

What is `workpiece.mass` and `perception.x` of the first object is `workpieces.ID.mass` and `perception.ID.x` of the
object ID under the scene's `workpieces`.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType

from rgss.scenes.uncertainty.quantities import QUANTITIES, UncertainQuantity

_PREFIXES: Mapping[str, str] = MappingProxyType({"workpiece": "workpieces", "perception": "perception"})
"""First part of a name of the first object, and of the same name of a further object."""

_OWN = {
    (_PREFIXES[first], last): one
    for one in QUANTITIES.values()
    for first, _, last in [one.name.partition(".")]
    if first in _PREFIXES
}
_PLACES = {name: place for place, name in enumerate(QUANTITIES)}
_UNIT_ENDINGS: Mapping[str, str] = MappingProxyType(
    {"m": "_m", "rad": "_rad", "kg": "_kg", "N": "_n", "s": "_s", "1": "_1"}
)


@lru_cache(maxsize=1024)
def quantity_of(name: str) -> UncertainQuantity:
    """The quantity of a name or of a draw, such as ``robot.joint_offset.3`` or ``workpieces.lid.mass``.

    Args:
        name: The name.

    Raises:
        KeyError: There is none.
    """
    if name in QUANTITIES:
        return QUANTITIES[name]
    before, _, last = name.rpartition(".")
    prefix, _, known = before.partition(".")
    own = _OWN.get((prefix, last))
    if own is not None and known:
        return replace(own, name=name, object=known, meaning=f"{own.meaning.rstrip('.')} ({known}).")
    return QUANTITIES[before]


def object_quantity_name(first: str, known: str) -> str:
    """Name of a further object's quantity.

    Args:
        first: Name of the same quantity of the first object, such as ``workpiece.mass``.
        known: Id of the further object.
    """
    prefix, _, last = first.partition(".")
    return f"{_PREFIXES[prefix]}.{known}.{last}"


def name_of_first(quantity: UncertainQuantity) -> str:
    """Name of the same quantity of the first object.

    Args:
        quantity: A quantity.
    """
    prefix, last = quantity.name.partition(".")[0], quantity.name.rpartition(".")[2]
    return _OWN[prefix, last].name if quantity.object else quantity.name


def in_order(names: Iterable[str]) -> tuple[UncertainQuantity, ...]:
    """The quantities in the order in which they are applied: that of the registry, then object by object.

    Args:
        names: Their names; the order has no effect.
    """
    found = [quantity_of(name) for name in names]
    return tuple(sorted(found, key=lambda one: (one.object, _PLACES[name_of_first(one)])))


def similar_name(text: str) -> str | None:
    """The name that a text may stand for; None if none is near.

    Args:
        text: What a file has for a name.
    """
    known = text.partition(".")[2].rpartition(".")[0]
    of_object = [f"{prefix}.{known}.{last}" for prefix, last in _OWN] if known else []
    near = difflib.get_close_matches(text, [*of_object, *QUANTITIES], n=1)
    return near[0] if near else None


def further_object_endings() -> dict[str, tuple[str, ...]]:
    """Last parts of the names of quantities of further objects, by their first part."""
    return {prefix: tuple(last for first, last in _OWN if first == prefix) for prefix in _PREFIXES.values()}


def draw_column(draw: str) -> str:
    """Name of a table's column of a draw, such as ``drawn_perception_x_m``: the unit at its end.

    Args:
        draw: The name of the draw; one that is not in the registry, from another version, has no unit.
    """
    try:
        unit = _UNIT_ENDINGS[quantity_of(draw).unit]
    except KeyError:
        unit = ""
    return f"drawn_{draw.replace('.', '_')}{unit}"


def object_quantity_of_column(column: str) -> UncertainQuantity | None:
    """The quantity of a further object whose draws a column has; None for any other column.

    Args:
        column: Name of the column; dots of the object's id are underscores in it.
    """
    for (prefix, last), one in _OWN.items():
        start, end = f"drawn_{prefix}_", f"_{last}{_UNIT_ENDINGS[one.unit]}"
        known = column[len(start) : -len(end)]
        if known and column.startswith(start) and column.endswith(end):
            return quantity_of(f"{prefix}.{known}.{last}")
    return None
