"""Error of a supposition about a number that a study does not have."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence

from rgss.errors import DefinitionError
from rgss.findings import shown


class UnknownSuppositionError(DefinitionError):
    """A supposition about a number that the study does not have."""


def unknown_input(name: str, known: Iterable[str], near_to: str) -> UnknownSuppositionError:
    """Error with the names that are nearest to an unknown one.

    Args:
        name: The unknown name.
        known: The known names.
        near_to: Part of the name by which others are found.
    """
    return UnknownSuppositionError(
        f"--what-if: unknown input {shown(name)}", hint=nearest_names(name, list(known), near_to)
    )


def nearest_names(name: str, known: Sequence[str], near_to: str = "") -> str:
    """Hint with the names that are nearest to an unknown one, or with the first ones.

    Args:
        name: The unknown name.
        known: The known names.
        near_to: Part of the name by which others are found; empty for none.
    """
    near = difflib.get_close_matches(name, known, n=3) or [one for one in known if near_to and near_to in one][:3]
    return f"did you mean {' or '.join(near)}?" if near else f"such as {', '.join(known[:4])}"
