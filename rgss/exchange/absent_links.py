"""Links of a project to elements that a file of relations lacks."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from rgss.exchange.attributes import ATTRIBUTES, Form
from rgss.exchange.cells import ids_in, joined
from rgss.exchange.content import Content, Row


def with_absent_links(own: Content, foreign: Content, *, remove: bool) -> Content:
    """Content of a file with the project's links to elements that the file lacks and that are kept.

    A relation leads from one object of a file to another: a file with a part of the elements cannot state a link to the
    others, and does not remove it.

    Args:
        own: The project.
        foreign: The file, whose links are relations between its objects.
        remove: True if elements that the file lacks are removed, where it has every element of their part.
    """
    present = {row.id for row in foreign.rows} | {name for name, _ in foreign.measures}
    gone = {row.id for row in own.rows if remove and row.part in foreign.whole}
    known = {row.id: row for row in own.rows}
    return replace(
        foreign,
        rows=tuple(_kept(known[row.id], row, present | gone) if row.id in known else row for row in foreign.rows),
    )


def _kept(own: Row, foreign: Row, stated: Collection[str]) -> Row:
    """Element of a file with the project's links to elements other than the stated ones."""
    cells = dict(foreign.cells)
    for each in ATTRIBUTES.get(own.part, ()) if own.part is not None else ():
        if each.name in cells and each.holds_ids:
            absent = [other for other in ids_in(own.cells[each.name]) if other not in stated]
            if each.form is Form.LINKS:
                cells[each.name] = joined(list(dict.fromkeys((*ids_in(cells[each.name]), *absent))))
            elif absent and not cells[each.name].strip():
                cells[each.name] = absent[0]
    return replace(foreign, cells=cells)
