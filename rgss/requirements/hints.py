"""Hints that name the nearest known id, with a bound on the comparisons."""

from __future__ import annotations

import difflib
from collections.abc import Collection

_MOST_COMPARISONS = 100_000


class Hints:
    """Finder of the id most similar to a wrong one, with a limit on the number of comparisons.

    A project in which every id is wrong would otherwise compare each with each.
    """

    def __init__(self, most_comparisons: int = _MOST_COMPARISONS) -> None:
        """Begin with nothing compared.

        Args:
            most_comparisons: Largest number of compared ids.
        """
        self._left = most_comparisons

    def nearest(self, name: str, names: Collection[str]) -> str:
        """A hint with the id most similar to an unknown one; empty if none is similar or the search takes too long.

        Args:
            name: The wrong id.
            names: The ids that it may be.
        """
        if len(names) > self._left:
            return ""
        self._left -= len(names)
        near = [one for one in names if one.casefold() == name.casefold()]
        near = near or difflib.get_close_matches(name, list(names), n=1)
        return f"did you mean {near[0]!r}?" if near else ""
