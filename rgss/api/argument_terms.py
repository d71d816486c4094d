"""Errors of the Python interface in terms of its arguments, where the library speaks of options."""

from __future__ import annotations

from contextlib import ContextDecorator
from types import TracebackType

from rgss.errors import RgssError

TERMS = (
    ("check the name and --project", "check the name and the folder"),
    ("go into a project or name it with --project DIR", "name its folder: load_study('DIR')"),
    ("allow more time: rgss trade --time-limit", "'rgss trade --time-limit' allows more time"),
    ("run 'rgss sweep' first", "call sweep() first"),
    ("run 'rgss sweep' with at least", "load_study(..., replicates=N).sweep() with at least"),
    ("change the catalogue and run 'rgss sweep'", "change the catalogue and call sweep()"),
    ("see what failed with 'rgss sweep', then run it again", "see what failed, then call sweep() again"),
    ("'rgss variants' lists all of them", "study.variants lists all of them"),
    ("--what-if:", "what_if:"),
)
"""What the library says, and what an analyst is told; the first that fits, in turn."""


class SpeaksOfArguments(ContextDecorator):
    """Context, or decorator of a function, whose errors name arguments and methods.

    The library's errors name what a shell has, for most of its users sit there. The error that is raised is the same
    object, of the same type and with the same data.
    """

    def __enter__(self) -> None:
        """Begin."""

    def __exit__(self, _type: object, error: BaseException | None, _traceback: TracebackType | None) -> None:
        """Put an error of rgss in terms of arguments."""
        if isinstance(error, RgssError):
            error.message, error.hint = in_arguments(error.message), in_arguments(error.hint)


def in_arguments(text: str) -> str:
    """A text with arguments in place of options.

    Args:
        text: A message or a hint.
    """
    for said, told in TERMS:
        text = text.replace(said, told)
    return text
