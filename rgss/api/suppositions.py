"""Suppositions in the forms that the Python interface accepts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.api.argument_terms import number_argument, texts_argument

WhatIf = Mapping[str, float | str | bool] | Sequence[str] | str
"""Suppositions: ``{"weight.t_p": 0.4}``, or texts as ``--what-if`` takes them."""


_HINT = "such as {'weight.t_p': 0.4, 'SYS-012.threshold': '0.9 kg'} or ['weight.t_p=0.4']"


def suppositions_of(what_if: WhatIf) -> list[str]:
    """Suppositions as the texts that ``--what-if`` takes.

    Args:
        what_if: The suppositions.

    Raises:
        DefinitionError: They have another form, or a value is neither a number, a text nor a truth value.
    """
    if isinstance(what_if, str):
        return [what_if]
    if isinstance(what_if, Mapping):
        return [f"{name}={_value(name, value)}" for name, value in what_if.items()]
    return list(texts_argument("what_if", what_if, hint=_HINT))


def _value(name: str, value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    # A plain float: the repr of a number of NumPy is a call such as `np.float64(0.4)`.
    return value if isinstance(value, str) else repr(number_argument(f"what_if: {name}", value, hint=_HINT))
