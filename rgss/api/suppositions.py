"""Suppositions in the forms that the Python interface accepts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

WhatIf = Mapping[str, float | str] | Sequence[str] | str
"""Suppositions: ``{"weight.t_p": 0.4}``, or texts as ``--what-if`` takes them."""


def suppositions_of(what_if: WhatIf) -> list[str]:
    """Suppositions as the texts that ``--what-if`` takes.

    Args:
        what_if: The suppositions.
    """
    if isinstance(what_if, str):
        return [what_if]
    if isinstance(what_if, Mapping):
        # `float` first: the repr of a number of NumPy is a call such as `np.float64(0.4)`.
        return [f"{name}={value if isinstance(value, str) else repr(float(value))}" for name, value in what_if.items()]
    return list(what_if)
