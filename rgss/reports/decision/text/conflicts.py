"""Conflicts of requirements of an infeasible decision, and the cheapest repairs, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.reports.decision.conflict_tables import conflict_tables, unmeasured_headline
from rgss.reports.decision.sentences import nearest_sentence
from rgss.reports.plain_text import aligned_table
from rgss.tradeoff import Decision


def conflict_lines(decision: Decision) -> Iterator[str]:
    """Lines on the variants that each requirement excludes, on conflicts, and on the cheapest repairs.

    Args:
        decision: A decision without a choice.
    """
    missing = unmeasured_headline(decision)
    if missing:
        yield missing
    if decision.conflicts is None:
        return
    for place, table in enumerate(conflict_tables(decision, decision.conflicts)):
        if place:
            yield ""
        yield from aligned_table(list(table.heads), [list(row) for row in table.rows], right=table.right)
        yield from table.notes
    yield from ("", nearest_sentence(decision, decision.conflicts))
