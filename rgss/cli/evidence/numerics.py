"""Lines of ``rgss evidence verify`` on the numerics that trials were computed with."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rgss.counted import counted


def computed_with(path: Path, label: str) -> list[dict[str, Any]]:
    """Numeric environments of a store's trials, with the number of trials and whether this machine has the same.

    Args:
        path: The store, which is sound.
        label: Its name in messages.

    Raises:
        EvidenceError: It cannot be read.
        SimulationError: No process can be started to determine this machine's numerics.
    """
    from rgss.evidence import EvidenceStore
    from rgss.evidence.records import numerics_difference
    from rgss.evidence.store import numerics_census
    from rgss.trials.code import fixed_numerics

    with EvidenceStore.open(path, create=False, label=label) as evidence:
        census = numerics_census(evidence.database)
    here = fixed_numerics() if any(numerics for numerics, _ in census) else {}
    return [
        {
            "trials": count,
            "numerics": dict(numerics),
            "as_here": not numerics_difference(numerics, here) if numerics else None,
        }
        for numerics, count in census
    ]


def numerics_line(computed: Mapping[str, Any]) -> str:
    """One line about the trials of one numerics.

    Args:
        computed: An entry of `computed_with`.
    """
    from rgss.evidence.records import numerics_text
    from rgss.findings import printable

    who = counted(computed["trials"], "trial")
    how = printable(numerics_text(computed["numerics"]))
    if computed["as_here"]:
        return f"{who}: computed as on this machine, so 'rgss replay' must agree bit for bit ({how})."
    return f"{who}: computed with other numerics, so 'rgss replay' compares within a tolerance here ({how})."
