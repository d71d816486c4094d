"""Parser of the command line, with one-line errors and suggestions."""

from __future__ import annotations

import argparse
import difflib
import re
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

BAD_INPUT = 2
_FEW = 6

_NO_WHOLE_NUMBER = re.compile(r"invalid int value: ('.*')$", re.DOTALL)


class CommandParser(argparse.ArgumentParser):
    """Parser with one-line errors, which accepts arguments and options in any order."""

    def error(self, message: str) -> NoReturn:
        """Print the error and exit with the status of bad input."""
        from rgss.findings import printable

        line = _NO_WHOLE_NUMBER.sub(r"must be a whole number, got \1", " ".join(message.split()))
        print(printable(f"{self.prog}: {line} (see '{self.prog} --help')"), file=sys.stderr)
        self.exit(BAD_INPUT)

    def parse_known_args(  # type: ignore[override]  # the stubs have overloads for the same two arguments
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[Any, list[str]]:
        """Parse arguments; unrecognized ones are an error of this parser, not of its parent."""
        found, left = super().parse_known_args(args, namespace)
        if left and not self._is_late(left, found):
            options = [option for option in self._option_string_actions if option.startswith("--")]
            near = _nearest(left[0].partition("=")[0], options) if left[0].startswith("--") else ""
            self.error(f"unrecognized arguments: {' '.join(left)}{near}")
        return found, []

    def _is_late(self, left: Sequence[str], found: Any) -> bool:
        """Assign an argument that follows an option to the last positional argument, which is optional.

        Python before 3.13 gives such an argument its default as soon as the words before it are read.
        """
        last = next(reversed(self._get_positional_actions()), None)
        if (
            last is None
            or last.nargs != argparse.OPTIONAL
            or last.type is not None
            or last.choices is not None
            or getattr(found, last.dest, None) is not last.default
            or len(left) != 1
            or left[0].startswith("-")
        ):
            return False
        setattr(found, last.dest, left[0])
        return True

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse an invalid choice; name the nearest valid one, or all of them."""
        if action.choices is None or value in action.choices:
            return
        choices = [str(choice) for choice in action.choices]
        # A short list is shown in full, since its nearest entry need not be what was meant.
        near = _nearest(str(value), choices) if len(choices) > _FEW else ""
        known = near or f" (choose from {', '.join(map(repr, choices))})"
        raise argparse.ArgumentError(action, f"invalid choice: {value!r}{known}")

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        """Print help; a full disk or a closed pipe raises an error, which argparse ignores."""
        to = sys.stderr if file is None else file
        if message and to is not None:
            to.write(message)
            getattr(to, "flush", lambda: None)()


def _nearest(word: str, words: Iterable[str]) -> str:
    near = difflib.get_close_matches(word, list(words), n=1)
    return f" (did you mean {near[0]!r}?)" if near else ""
