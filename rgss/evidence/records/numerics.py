"""Numerics of a process, part by part, as part of the provenance.

Each part is a text: the names of what computes, for readers, and at its end a digest of the results of fixed
problems. Two processes compute alike where the digests agree, whatever the names.
"""

from __future__ import annotations

from collections.abc import Mapping

from rgss.errors import EvidenceError

Numerics = Mapping[str, str]
"""A text for each part: ``platform``, ``libm``, ``numpy``, ``blas``."""


def results_of(numerics: Numerics) -> dict[str, str]:
    """Compared values: the digest of each part's results.

    Args:
        numerics: The numerics.
    """
    return {part: text.rpartition(" ")[2] for part, text in numerics.items()}


def numerics_text(numerics: Numerics) -> str:
    """Numerics in one line; "not recorded" if they are not known.

    Args:
        numerics: The numerics.
    """
    return "; ".join(f"{part}: {text}" for part, text in sorted(numerics.items())) or "not recorded"


def numerics_difference(there: Numerics, here: Numerics) -> str:
    """The parts that compute otherwise, in one line; empty if none does, or one side is not known.

    Args:
        there: The numerics of the one process.
        here: The numerics of the other.
    """
    if not (there and here):
        return ""
    before, after = results_of(there), results_of(here)
    parts = [part for part in dict.fromkeys([*there, *here]) if before.get(part) != after.get(part)]
    return "; ".join(f"{part}: {there.get(part, 'unknown')} there, {here.get(part, 'unknown')} here" for part in parts)


def require_alike(what: str, there: Numerics, here: Numerics) -> None:
    """Check that stored trials and new ones have the same numerics.

    Args:
        what: Name of what is stored, for messages.
        there: The numerics of the process that made it; empty if they are not known.
        here: Those of the process that makes the rest.

    Raises:
        EvidenceError: They differ, so that neither could be run again bit for bit on the other's machine.
    """
    difference = numerics_difference(there, here)
    if difference:
        raise EvidenceError(
            f"{what} was computed with other numerics ({difference})",
            hint="go on where it was made, or keep another store; docs/determinism.md lists what agrees",
        )
