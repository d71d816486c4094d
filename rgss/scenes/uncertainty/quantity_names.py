"""Names of uncertain quantities: those of the registry, and those of the further objects of a scene.

`workpiece.mass` and `perception.x` of the first object correspond to `workpieces.ID.mass` and `perception.ID.x` of the
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
"""Name prefixes of the first object's quantities, and the corresponding prefixes for further objects."""

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
    """Quantity of a name or of a draw, such as ``robot.joint_offset.3`` or ``workpieces.lid.mass``.

    Raises:
        KeyError: The name is unknown.
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
    """Name of the corresponding quantity of the first object."""
    prefix, last = quantity.name.partition(".")[0], quantity.name.rpartition(".")[2]
    return _OWN[prefix, last].name if quantity.object else quantity.name


def in_order(names: Iterable[str]) -> tuple[UncertainQuantity, ...]:
    """Quantities in the order of their application: that of the registry, then object by object.

    Args:
        names: Their names; the order has no effect.
    """
    found = [quantity_of(name) for name in names]
    return tuple(sorted(found, key=lambda one: (one.object, _PLACES[name_of_first(one)])))


def similar_name(text: str) -> str | None:
    """Nearest known name; None if none is near."""
    known = text.partition(".")[2].rpartition(".")[0]
    of_object = [f"{prefix}.{known}.{last}" for prefix, last in _OWN] if known else []
    near = difflib.get_close_matches(text, [*of_object, *QUANTITIES], n=1)
    return near[0] if near else None


def further_object_endings() -> dict[str, tuple[str, ...]]:
    """Last parts of the names of quantities of further objects, by their first part."""
    return {prefix: tuple(last for first, last in _OWN if first == prefix) for prefix in _PREFIXES.values()}


def draw_column(draw: str) -> str:
    """Name of the table column of a draw, such as ``drawn_perception_x_m``, with the unit as suffix.

    Args:
        draw: The name of the draw; without a unit if it is not in the registry (from another version).
    """
    try:
        unit = _UNIT_ENDINGS[quantity_of(draw).unit]
    except KeyError:
        unit = ""
    return f"drawn_{draw.replace('.', '_')}{unit}"


def object_quantity_of_column(column: str) -> UncertainQuantity | None:
    """Quantity of a further object in a column of draws; None for any other column.

    Args:
        column: Name of the column; dots of the object's id are replaced by underscores.
    """
    for (prefix, last), one in _OWN.items():
        start, end = f"drawn_{prefix}_", f"_{last}{_UNIT_ENDINGS[one.unit]}"
        known = column[len(start) : -len(end)]
        if known and column.startswith(start) and column.endswith(end):
            return quantity_of(f"{prefix}.{known}.{last}")
    return None
