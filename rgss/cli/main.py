"""Entry point of the command line; each verb is a module."""

from __future__ import annotations

import argparse
import errno
import gc
import importlib
import keyword
import os
import sys
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from types import ModuleType

from rgss.cli.command_parser import BAD_INPUT, CommandParser
from rgss.cli.options import with_given_options
from rgss.cli.safe_output import safe_output
from rgss.cli.termination import Interrupts
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
    "verify",
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

_FAILURES_OF_A_RUN = (SimulationError, MotionError, DriverError, StorageError)
_UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one verb.

    Args:
        arguments: The arguments after the program's name; the process's own by default.

    Returns:
        0 clean, 1 findings or nothing feasible, 2 bad input, 3 a run failed, 4 a change without a fault, 130
        interrupted.
    """
    # Start-up creates some hundred thousand long-lived objects; frequent garbage collections over them take a
    # tenth of a short command's time.
    gc.set_threshold(_OBJECTS_BETWEEN_COLLECTIONS)
    if arguments is not None:
        # Another program that calls this keeps its handlers.
        with safe_output():
            return _run(arguments, Interrupts())
    interrupts = Interrupts()
    interrupts.listen()
    with safe_output():
        try:
            return _run(None, interrupts)
        finally:
            # The work is done. What ends with the process, such as its children, is not cut off.
            interrupts.ignore()


def _run(arguments: Sequence[str] | None, interrupts: Interrupts) -> int:
    options: argparse.Namespace | None = None
    try:
        options = command_line().parse_args(arguments)
        # Before the result, which is that of a mixture; an import undoes it and says so itself.
        if not getattr(options, "undoes_imports", False):
            _report_interrupted_import(options)
        with _page(options):
            status = int(options.handler(options))
            if sys.stdout is not None:
                # Flushed here, where a failure can still be reported, and not at the exit of the interpreter.
                sys.stdout.flush()
        _report_interrupted_import(options)
        return status
    except RgssError as error:
        return _report_error(error, options)
    except KeyboardInterrupt:
        return _interrupted(options, interrupts)
    except BrokenPipeError:
        # The reader of the output has closed the pipe, which is no error.
        _discard_output()
        return CLEAN
    except UnicodeEncodeError as error:
        if sys.stdout is None or error.encoding != sys.stdout.encoding:
            raise
        character = ascii(error.object[error.start])
        hint = "write it to a file, or set PYTHONIOENCODING=utf-8"
        _print_error(f"rgss: the output has the character {character}, which {error.encoding} lacks ({hint})")
        return RUN_FAILED
    except OSError as error:
        return _failed_file(error)
    except Exception:
        if not interrupts.received:
            raise
        # What a library made of the interrupt.
        return _interrupted(options, interrupts)


def _report_error(error: RgssError, options: argparse.Namespace | None) -> int:
    """Report bad input or a failed run, and return the exit status."""
    if isinstance(error, DocumentError):
        for finding in error.findings:
            _print_error(str(finding))
        _report_interrupted_import(options)
        return BAD_INPUT
    if options is not None and error.hint:
        error.hint = with_given_options(error.hint, options)
    _print_error(f"rgss: {error}")
    return RUN_FAILED if isinstance(error, _FAILURES_OF_A_RUN) else BAD_INPUT


def _failed_file(error: OSError) -> int:
    """Report a file, or the output, that cannot be read or written, and return the exit status."""
    from rgss.documents import is_disk_failure, unwritable

    _discard_output()
    # An error of a file has its name; an error of standard output has none.
    printed = error.filename is None and error.errno in _UNWRITABLE
    if isinstance(error, FileNotFoundError) and not _has_current_folder():
        _print_error("rgss: the current folder no longer exists (go into one that does)")
        return BAD_INPUT
    if isinstance(error, PermissionError) and error.filename is not None:
        path = _denying(Path(os.fsdecode(error.filename)))
        _print_error(f"rgss: {path} may not be read or written (change its permissions)")
        return BAD_INPUT
    if error.filename is not None and is_disk_failure(error):
        _print_error(f"rgss: {unwritable(Path(os.fsdecode(error.filename)), error)}")
    else:
        _print_error(f"rgss: the output cannot be written: {error.strerror}" if printed else f"rgss: {error}")
    return RUN_FAILED


def _interrupted(options: argparse.Namespace | None, interrupts: Interrupts) -> int:
    """Report an interrupt, which further ones do not cut off."""
    interrupts.ignore()
    stores = getattr(options, "stores_trials", False) or getattr(options, "run", False)
    _print_error("rgss: interrupted; finished trials are stored" if stores else "rgss: interrupted")
    # Modules whose import was cut off cannot be imported again; then nothing has been written.
    with suppress(ImportError, AttributeError):
        _report_interrupted_import(options)
    return INTERRUPTED


def _report_interrupted_import(options: argparse.Namespace | None) -> None:
    """Report, once, an import that was killed while it wrote: the project is neither the old nor the new one.

    It may be why the project cannot be read; if it can, what a verb has read or run is of a mixture.
    """
    if options is None or not hasattr(options, "project") or getattr(options, "is_import_reported", False):
        return
    from rgss.exchange import was_interrupted
    from rgss.studies import find_project

    try:
        folder = find_project(options.project)
    # A folder that was removed, or cannot be read, is in no project.
    except (RgssError, OSError):
        return
    if was_interrupted(folder):
        options.is_import_reported = True
        _print_error("rgss: an import into this project was interrupted (`rgss import` undoes what it has written)")


def _page(options: argparse.Namespace) -> AbstractContextManager[object]:
    """Page of a verb's output on a terminal; JSON is not paged."""
    if options.json or not options.is_fitted or sys.stdout is None or not sys.stdout.isatty():
        return nullcontext()
    from rgss.cli.terminal import fitted_page

    # Progress bars would overwrite the pager's screen.
    is_paged = options.is_paged and not getattr(options, "run", False)
    return fitted_page(is_wide=options.wide, is_paged=is_paged)


def command_line() -> argparse.ArgumentParser:
    """The parser of the whole command line, with a parser for each verb."""
    parser = CommandParser(
        prog="rgss",
        description="Choose a robot design by evidence: requirements, simulated trials, a certified trade-off. "
        "Without a verb: the state of the project and the next command.",
        epilog="Begin with 'rgss init my_project'; every verb has examples under --help. "
        "Exit status: 0 clean, 1 findings or nothing feasible, 2 bad input, 3 a run failed, 4 a change without a fault "
        "(regress, replay), 130 interrupted.",
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
        verb.add_argument("--wide", action="store_true", help="on a terminal: do not fit lines and tables to its width")
        module.configure(verb)
        verb.set_defaults(
            handler=module.run,
            is_fitted=getattr(module, "FITTED", True),
            is_paged=getattr(module, "PAGED", False),
            stores_trials=getattr(module, "STORES_TRIALS", False),
            undoes_imports=getattr(module, "UNDOES_IMPORTS", False),
        )
    return parser


def _show_state(options: argparse.Namespace) -> int:  # noqa: ARG001 - every handler takes the options
    """Print the state of the project and the next command."""
    from rgss.cli.output import print_lines
    from rgss.cli.project_state import state_lines

    print_lines(state_lines())
    return CLEAN


def module_name(verb: str) -> str:
    """Name of a verb's module; a verb that is a keyword of Python has a trailing underscore."""
    return f"{verb}_" if keyword.iskeyword(verb) else verb


class _HelpFormatter(argparse.HelpFormatter):
    """Help whose examples keep their lines."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return text if "\n" in text else super()._fill_text(text, width, indent)


def _examples(module: ModuleType) -> str:
    """Examples of a verb: a command on each line, with a comment where it needs one."""
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


def _has_current_folder() -> bool:
    """False if the folder that the shell is in has been deleted."""
    try:
        Path.cwd()
    except FileNotFoundError:
        return False
    return True


def _denying(path: Path) -> Path:
    """The outermost folder of a file that may not be entered, else the file."""
    return next((each for each in reversed(path.parents) if each.is_dir() and not os.access(each, os.X_OK)), path)


def _discard_output() -> None:
    """Redirect buffered output to the null device, so that the flush at exit does not fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _print_error(text: str) -> None:
    print(printable(text), file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
