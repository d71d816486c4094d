"""Every example that a verb shows is a command that is understood."""

from __future__ import annotations

import importlib
import shlex

import pytest

from rgss.cli.main import VERBS, command_line, module_name

_SIGNS = (">", ">>", "|", "<")


def examples() -> list[tuple[str, str, str]]:
    found = []
    for verb in VERBS:
        module = importlib.import_module(f"rgss.cli.verbs.{module_name(verb)}")
        found += [
            (verb, command, purpose)
            for command, purpose in [(module.EXAMPLE, "–"), *getattr(module, "MORE_EXAMPLES", ())]
        ]
    return found


@pytest.mark.parametrize(("verb", "command", "purpose"), examples(), ids=lambda text: text)
def test_an_example_is_understood(verb, command, purpose):
    inner = command.removeprefix('eval "$(').removesuffix(')"') if command.startswith("eval") else command
    words = shlex.split(inner)
    end = min((words.index(sign) for sign in _SIGNS if sign in words), default=len(words))

    assert words[:2] == ["rgss", verb]
    assert purpose
    assert callable(command_line().parse_args(words[1:end]).handler)


@pytest.mark.parametrize("verb", VERBS)
def test_examples_stand_in_the_help(rgss, verb):
    told = rgss(verb, "--help").output

    for of_verb, command, purpose in examples():
        if of_verb == verb:
            assert f"\n  {command}\n" in told
            assert purpose in ("–", *[line.strip() for line in told.splitlines()])
