"""Hints with the nearest known id, with a bound on the number of comparisons."""

from __future__ import annotations

import difflib
from collections.abc import Collection

_MOST_COMPARISONS = 100_000


class Hints:
    """Finder of the nearest known id, with a limit on the number of comparisons.

    Without it, a project with only wrong ids would compare all pairs.
    """

    def __init__(self) -> None:
        """Start without comparisons."""
        self._left = _MOST_COMPARISONS

    def nearest(self, name: str, names: Collection[str]) -> str:
        """Hint with the id nearest to an unknown one; empty if none is similar or the limit is exceeded.

        Args:
            name: The unknown id.
            names: The known ids.
        """
        if len(names) > self._left:
            return ""
        self._left -= len(names)
        near = [one for one in names if one.casefold() == name.casefold()]
        near = near or difflib.get_close_matches(name, list(names), n=1)
        return f"did you mean {near[0]!r}?" if near else ""
