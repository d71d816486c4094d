"""The command line: one verb, one module; the only place that prints."""

from __future__ import annotations

import argparse
import errno
import gc
import importlib
import keyword
import os
import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from types import ModuleType

from rgss.cli.command_parser import BAD_INPUT, CommandParser
from rgss.cli.safe_output import safe_output
from rgss.errors import DocumentError, DriverError, MotionError, RgssError, SimulationError, StorageError
from rgss.findings import printable

VERBS = (
    "init",
    "check",
    "variants",
    "robot",
    "planners",
    "run",
    "sweep",
    "evidence",
    "replay",
    "measure",
    "trade",
    "weigh",
    "confirm",
    "regress",
    "identify",
    "trace",
    "report",
    "serve",
    "export",
    "import",
    "schema",
    "completion",
)
_OBJECTS_BETWEEN_COLLECTIONS = 50_000
CLEAN, FINDINGS, RUN_FAILED, INTERRUPTED = 0, 1, 3, 130

_UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one verb.

    Args:
        arguments: The words after the program's name; the process's own by default.

    Returns:
        0 clean, 1 findings or an unmet bar, 2 bad input, 3 a run failed, 130 interrupted.
    """
    # Start-up makes some hundred thousand objects that all stay; looking through them again and again for
    # circles takes a tenth of a short command's time.
    gc.set_threshold(_OBJECTS_BETWEEN_COLLECTIONS)
    with safe_output():
        return _run(arguments)


def _run(arguments: Sequence[str] | None) -> int:
    try:
        options = command_line().parse_args(arguments)
        with _page(options):
            status = int(options.handler(options))
            if sys.stdout is not None:
                # Here, where a failure can still be reported, and not when the interpreter ends.
                sys.stdout.flush()
        return status
    except DocumentError as error:
        for finding in error.findings:
            _complain(str(finding))
        return BAD_INPUT
    except (SimulationError, MotionError, DriverError, StorageError) as error:
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
        # A file says its name; what is printed has none.
        printed = error.filename is None and error.errno in _UNWRITABLE
        _complain(f"rgss: the output cannot be written: {error.strerror}" if printed else f"rgss: {error}")
        return RUN_FAILED


def _page(options: argparse.Namespace) -> AbstractContextManager[object]:
    """The page of what a verb prints; what programs read is not a page."""
    if options.json or not options.is_fitted or sys.stdout is None or not sys.stdout.isatty():
        return nullcontext()
    from rgss.cli.terminal import fitted_page

    # Progress would be written over the pager.
    is_paged = options.is_paged and not getattr(options, "run", False)
    return fitted_page(is_wide=options.wide, is_paged=is_paged)


def command_line() -> argparse.ArgumentParser:
    """The parser of the whole command line, with a parser for each verb."""
    parser = CommandParser(
        prog="rgss",
        description="Choose a robot design by evidence: requirements, simulated trials, a certified trade-off. "
        "Without a verb: how the project stands, and the next command.",
        epilog="Begin with 'rgss init my_project'; every verb has examples under --help. "
        "Exit status: 0 clean, 1 findings or nothing feasible, 2 bad input, 3 a run failed, 130 interrupted.",
    )
    parser.add_argument("--version", action="version", version=f"rgss {_version()}")
    parser.set_defaults(handler=_show_state, json=False, is_fitted=True, is_paged=False, wide=False)
    verbs = parser.add_subparsers(metavar="VERB")
    for name in VERBS:
        module = importlib.import_module(f"rgss.cli.verbs.{module_name(name)}")
        verb = verbs.add_parser(
            name,
            help=module.HELP,
            description=module.HELP[:1].upper() + module.HELP[1:] + ".",
            epilog=_examples(module),
            formatter_class=_HelpFormatter,
        )
        verb.add_argument(
            "--project", type=Path, metavar="DIR", help="the project's folder (default: the nearest one above)"
        )
        verb.add_argument("--json", action="store_true", help="print one JSON document and nothing else")
        verb.add_argument("--wide", action="store_true", help="on a terminal: lines and tables wider than it")
        module.configure(verb)
        verb.set_defaults(
            handler=module.run, is_fitted=getattr(module, "FITTED", True), is_paged=getattr(module, "PAGED", False)
        )
    return parser


def _show_state(options: argparse.Namespace) -> int:  # noqa: ARG001 - every handler takes the options
    """Say how the project stands, and what to do next."""
    from rgss.cli.output import print_lines
    from rgss.cli.project_state import state_lines

    print_lines(state_lines())
    return CLEAN


def module_name(verb: str) -> str:
    """The module of a verb, which has an underscore behind it where the verb is a word of Python."""
    return f"{verb}_" if keyword.iskeyword(verb) else verb


class _HelpFormatter(argparse.HelpFormatter):
    """Help whose examples keep their lines."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return text if "\n" in text else super()._fill_text(text, width, indent)


def _examples(module: ModuleType) -> str:
    """The examples of a verb: a command on each line, with what it is for where that is not plain."""
    examples = [(module.EXAMPLE, ""), *getattr(module, "MORE_EXAMPLES", ())]
    lines = [f"  {command}" + (f"\n      {purpose}" if purpose else "") for command, purpose in examples]
    # The percent sign is argparse's own.
    return "\n".join(["examples:", *lines]).replace("%", "%%")


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
    print(printable(text), file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
