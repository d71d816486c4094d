"""Errors of the Python interface, which name arguments where the library names options."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Iterable
from contextlib import ContextDecorator
from types import TracebackType

from rgss.errors import DefinitionError, RgssError

TERMS = (
    ("check the name and --project", "check the name and the folder"),
    ("go into a project or name it with --project DIR", "name its folder: load_study('DIR')"),
    ("allow more time: rgss trade --time-limit", "'rgss trade --time-limit' allows more time"),
    ("run 'rgss sweep' first", "call sweep() first"),
    ("run 'rgss sweep' with at least", "load_study(..., replicates=N).sweep() with at least"),
    ("change the catalogue and run 'rgss sweep'", "change the catalogue and call sweep()"),
    ("see what failed with 'rgss sweep', then run it again", "see what failed, then call sweep() again"),
    ("run 'rgss variants' to list them", "study.variants lists them"),
    ("--what-if:", "what_if:"),
)
"""Phrases of the command line and their replacements, applied in order."""


_LONGEST_SHOWN = 60
_SWEEP_OF = re.compile(r"'rgss sweep [^']*' first")
"""A sweep of the trials that a study was loaded with."""


class ErrorsNameArguments(ContextDecorator):
    """Context, or decorator of a function, whose errors name arguments and methods.

    The library words its errors for the command line. The error that is raised is the same object, of the same type
    and with the same data.
    """

    def __enter__(self) -> None:
        """Begin."""

    def __exit__(self, _type: object, error: BaseException | None, _traceback: TracebackType | None) -> None:
        """Replace options by arguments in the message and the hint of an error of rgss."""
        if isinstance(error, RgssError):
            error.message, error.hint = in_arguments(error.message), in_arguments(error.hint)


def in_arguments(text: str) -> str:
    """Text with options replaced by arguments.

    Args:
        text: A message or a hint.
    """
    text = _SWEEP_OF.sub("'rgss sweep' first", text)
    for option, argument in TERMS:
        text = text.replace(option, argument)
    return text


def whole_argument(name: str, number: object, *, hint: str) -> int:
    """Plain integer of an argument: a frame has integers of NumPy, which cannot be digested.

    Args:
        name: Name of the argument.
        number: Its value.
        hint: What to give.

    Raises:
        DefinitionError: It is no whole number; True and False are none.
    """
    if not isinstance(number, bool):
        try:
            return operator.index(number)  # type: ignore[arg-type]
        except TypeError:
            pass
    raise DefinitionError(f"{name} must be a whole number, got {_shown(number)}", hint=hint)


def number_argument(name: str, number: object, *, hint: str) -> float:
    """Plain float of an argument.

    Args:
        name: Name of the argument.
        number: Its value.
        hint: What to give.

    Raises:
        DefinitionError: It is no finite number; True, False and texts are none.
    """
    try:
        found = math.nan if isinstance(number, (bool, str, bytes)) else float(number)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        found = math.nan
    if not math.isfinite(found):
        raise DefinitionError(f"{name} must be a finite number, got {_shown(number)}", hint=hint)
    return found


def text_argument(name: str, text: object, *, hint: str) -> str:
    """Text of an argument.

    Args:
        name: Name of the argument.
        text: Its value.
        hint: What to give.

    Raises:
        DefinitionError: It is no text.
    """
    if isinstance(text, str):
        return text
    raise DefinitionError(f"{name} must be a text, got {_shown(text)}", hint=hint)


def texts_argument(name: str, texts: object, *, hint: str) -> tuple[str, ...]:
    """Texts of an argument that is a list of them.

    Args:
        name: Name of the argument.
        texts: Its value.
        hint: What to give.

    Raises:
        DefinitionError: It is no list, a text alone included, or an entry is no text.
    """
    if isinstance(texts, str) or not isinstance(texts, Iterable):
        raise DefinitionError(f"{name} must be a list of texts, got {_shown(texts)}", hint=hint)
    return tuple(text_argument(f"an entry of {name}", text, hint=hint) for text in texts)


def _shown(value: object) -> str:
    """A value in one line; a frame has many."""
    text = repr(value)
    return text if len(text) <= _LONGEST_SHOWN and text.isprintable() else f"a {type(value).__name__}"
