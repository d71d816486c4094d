"""Number of trials of a store by their numerics."""

from __future__ import annotations

from collections import Counter

from rgss.errors import EvidenceError
from rgss.evidence.records import Numerics, provenance_from_json, unpack
from rgss.evidence.store.connection import Database


def numerics_census(database: Database) -> tuple[tuple[Numerics, int], ...]:
    """Numerics of the trials of a store with their number of trials, the most frequent first.

    Trials without recorded numerics are counted under empty numerics. Damaged rows are skipped; `verify` reports them.

    Raises:
        EvidenceError: The file cannot be read.
    """
    found: Counter[tuple[tuple[str, str], ...]] = Counter()
    for (packed,) in database.rows("SELECT provenance FROM trials ORDER BY key"):
        try:
            numerics = provenance_from_json(unpack(packed, "provenance")).numerics
        except EvidenceError:
            continue
        found[tuple(sorted(numerics.items()))] += 1
    return tuple((dict(parts), count) for parts, count in found.most_common())
