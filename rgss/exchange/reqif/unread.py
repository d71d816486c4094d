"""Content of a ReqIF file beside its objects that is not imported."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from rgss.findings import shown

_MOST_NAMED = 8


def unread_notes(core: Any) -> Iterator[str]:
    """A note for the attributes of relations and specifications, and for groups of relations.

    Args:
        core: The content of the file as read by the library.
    """
    names = {
        definition.identifier: definition.long_name or definition.identifier
        for each in core.spec_types or []
        for definition in getattr(each, "attribute_definitions", None) or getattr(each, "spec_attributes", None) or ()
    }
    for what, elements in (("relation", core.spec_relations), ("specification", core.specifications)):
        valued = [each for each in elements or [] if each.values]
        if valued:
            had = dict.fromkeys(names.get(value.definition_ref, "") for each in valued for value in each.values)
            yield f"the attributes of {_counted(valued, what)} are not imported: {_listed(filter(None, had))}"
    groups = core.spec_relation_groups or []
    if groups:
        yield f"{_counted(groups, 'group')} of relations {'is' if len(groups) == 1 else 'are'} not imported"


def _counted(elements: Sequence[Any], what: str) -> str:
    return f"{len(elements)} {what}{'' if len(elements) == 1 else 's'}"


def _listed(names: Iterable[str]) -> str:
    known = list(names)
    said = ", ".join(map(shown, known[:_MOST_NAMED]))
    return f"{said} and {len(known) - _MOST_NAMED} more" if len(known) > _MOST_NAMED else said or "they have no names"
