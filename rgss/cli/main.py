"""The command line: one verb, one module; the only place that prints."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from rgss.errors import DocumentError, MotionError, RgssError, SimulationError

VERBS = ("check", "variants", "run", "sweep", "evidence", "replay", "measure", "trade", "trace", "export", "import")
CLEAN, FINDINGS, BAD_INPUT, RUN_FAILED, INTERRUPTED = 0, 1, 2, 3, 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one verb.

    Args:
        arguments: The words after the program's name; the process's own by default.

    Returns:
        0 clean, 1 findings or an unmet bar, 2 bad input, 3 a run failed, 130 interrupted.
    """
    try:
        options = _parser().parse_args(arguments)
        status = int(options.handler(options))
        if sys.stdout is not None:
            # Here, where a failure can still be told, and not when the interpreter ends.
            sys.stdout.flush()
        return status
    except DocumentError as error:
        for finding in error.findings:
            _complain(str(finding))
        return BAD_INPUT
    except (SimulationError, MotionError) as error:
        _complain(f"rgss: {error}")
        return RUN_FAILED
    except RgssError as error:
        _complain(f"rgss: {error}")
        return BAD_INPUT
    except KeyboardInterrupt:
        _complain("rgss: interrupted; what was finished is kept")
        return INTERRUPTED
    except BrokenPipeError:
        # The reader of our output has gone, which is its right; nothing more can be said to it.
        _discard_output()
        return CLEAN
    except OSError as error:
        _discard_output()
        _complain(f"rgss: {error}")
        return RUN_FAILED


class _Parser(argparse.ArgumentParser):
    """A parser that says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        _complain(f"{self.prog}: {' '.join(message.split())} (see '{self.prog} --help')")
        self.exit(BAD_INPUT)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="rgss",
        description="Choose a robot design by evidence: requirements, simulated trials, a certified trade-off.",
        epilog="Exit status: 0 clean, 1 findings or nothing feasible, 2 bad input, 3 a run failed, 130 interrupted.",
    )
    parser.add_argument("--version", action="version", version=f"rgss {_version()}")
    verbs = parser.add_subparsers(metavar="VERB", required=True)
    for name in VERBS:
        module = importlib.import_module(f"rgss.cli.{name}_verb")
        verb = verbs.add_parser(
            name,
            help=module.HELP,
            description=module.HELP[:1].upper() + module.HELP[1:] + ".",
            epilog=f"Example: {module.EXAMPLE}",
        )
        verb.add_argument(
            "--project", type=Path, metavar="DIR", help="the project's folder (default: the nearest one above)"
        )
        verb.add_argument("--json", action="store_true", help="print one JSON document and nothing else")
        module.configure(verb)
        verb.set_defaults(handler=module.run)
    return parser


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("rgss")
    except PackageNotFoundError:
        return "(not installed)"


def _discard_output() -> None:
    """Let what is still to be written go nowhere, so that it does not fail again at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _complain(text: str) -> None:
    print(text, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
