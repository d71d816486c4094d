"""Numerics of a process, part by part, as an item of the provenance.

Each part is a text: the names of numerical libraries and kernels, for information, followed by a digest of the results
of fixed problems. Two processes give equal results if the digests agree, regardless of the names.
"""

from __future__ import annotations

from collections.abc import Mapping

from rgss.errors import EvidenceError

Numerics = Mapping[str, str]
"""Mapping of parts to texts: ``platform``, ``libm``, ``numpy``, ``blas``."""


def results_of(numerics: Numerics) -> dict[str, str]:
    """Digest of each part's results, the compared values."""
    return {part: text.rpartition(" ")[2] for part, text in numerics.items()}


def numerics_text(numerics: Numerics) -> str:
    """Numerics in one line; "not recorded" if unknown."""
    return "; ".join(f"{part}: {text}" for part, text in sorted(numerics.items())) or "not recorded"


def numerics_difference(there: Numerics, here: Numerics) -> str:
    """Parts with different results, in one line; empty if there are none, or one side is unknown.

    Args:
        there: The numerics of one process.
        here: The numerics of the other.
    """
    if not (there and here):
        return ""
    before, after = results_of(there), results_of(here)
    parts = [part for part in dict.fromkeys([*there, *here]) if before.get(part) != after.get(part)]
    return "; ".join(f"{part}: {there.get(part, 'unknown')} there, {here.get(part, 'unknown')} here" for part in parts)


def require_alike(what: str, there: Numerics, here: Numerics) -> None:
    """Require equal numerics of stored and new trials.

    Args:
        what: Name of the stored trials, for messages.
        there: The numerics of the process that made them; empty if unknown.
        here: The numerics of the process that makes the new ones.

    Raises:
        EvidenceError: The numerics differ, so that neither result could be reproduced bit for bit on the other machine.
    """
    difference = numerics_difference(there, here)
    if difference:
        raise EvidenceError(
            f"{what} was computed with other numerics ({difference})",
            hint="continue on the first machine, or use another store; docs/determinism.md lists compatible ones",
        )
