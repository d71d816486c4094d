"""``rgss completion``: a shell script that completes verbs, options, choices and names of files."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

HELP = "print the script for completion in a shell"
FITTED = False
EXAMPLE = "rgss completion bash >> ~/.bash_completion"
MORE_EXAMPLES = (
    ('eval "$(rgss completion bash)"', "for this shell alone"),
    ('rgss completion zsh > "${fpath[1]}/_rgss"', "permanently, in zsh"),
    ("rgss completion fish > ~/.config/fish/completions/rgss.fish", "permanently, in fish"),
)
SHELLS = ("bash", "zsh", "fish")

_FILES = frozenset({"FILE", "STUDY", "PATH"})
_FOLDERS = frozenset({"DIR", "FOLDER"})


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("shell", choices=SHELLS, metavar="SHELL", help=f"one of {', '.join(SHELLS)}")


def run(options: argparse.Namespace) -> int:
    """Print the script."""
    from rgss.cli.main import CLEAN, command_line
    from rgss.cli.output import print_json
    from rgss.errors import DefinitionError

    if options.project is not None:
        raise DefinitionError("--project has no effect on completion", hint=f"rgss completion {options.shell}")
    script = completion_script(command_line(), options.shell)
    if options.json:
        print_json({"shell": options.shell, "script": script})
    else:
        print(script)
    return CLEAN


def completion_script(parser: argparse.ArgumentParser, shell: str) -> str:
    """The script for a shell.

    Args:
        parser: The command line.
        shell: One of `SHELLS`.

    Raises:
        DefinitionError: The package that writes the scripts is not installed.
    """
    from rgss.errors import DefinitionError

    try:
        import shtab
    except ImportError as error:
        raise DefinitionError("completion needs shtab", hint="run 'pip install shtab'") from error
    for action in _actions(parser):
        metavar = action.metavar if isinstance(action.metavar, str) else ""
        if action.choices is None and metavar in _FILES | _FOLDERS:
            # An attribute of shtab, which argparse does not declare.
            setattr(action, "complete", shtab.DIRECTORY if metavar in _FOLDERS else shtab.FILE)  # noqa: B010
    return str(shtab.complete(parser, shell=shell, root_prefix="rgss"))


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Every argument of a parser and of the parsers of its verbs."""
    for action in parser._actions:  # noqa: SLF001  # argparse has no public list of them
        yield action
        if isinstance(action.choices, dict):
            for inner in action.choices.values():
                yield from _actions(inner)
