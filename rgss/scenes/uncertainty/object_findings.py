"""Findings about uncertain quantities of objects that a scene does not have."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.uncertainty.quantity_names import name_of_first, object_quantity_name, quantity_of


def unknown_objects(
    names: Iterable[str], document: Document, *, first: str, further: Sequence[str]
) -> Iterator[Finding]:
    """Findings about uncertain quantities of unknown further objects.

    Args:
        names: Names of the uncertain quantities, under ``uncertainty``.
        document: The file, for positions.
        first: Id of the scene's first object.
        further: Ids of its further objects.
    """
    for name in names:
        quantity = quantity_of(name)
        if not quantity.object or quantity.object in further:
            continue
        own = name_of_first(quantity)
        near = difflib.get_close_matches(quantity.object, [*further, first], n=1)
        if quantity.object == first or near == [first]:
            hint = f"{first!r} is the first object, under 'workpiece': its quantity is {own!r}"
        elif near:
            hint = f"did you mean {object_quantity_name(own, near[0])!r}?"
        elif further:
            hint = f"objects under 'workpieces': {', '.join(further)}"
        else:
            hint = f"the scene has one object: its quantity is {own!r}"
        message = f"{name}: no object {quantity.object!r} under the scene's 'workpieces'"
        yield document.finding("uncertainty.object", message, ("uncertainty", name), hint=hint)
