"""Every option of the command line is on a page of the documentation."""

from __future__ import annotations

import argparse
import re

import pytest

from rgss.cli.main import VERBS, command_line
from tests.fixtures.shipped_project import REPOSITORY

EVERYWHERE = {"--help", "--project", "--json", "--wide"}


def parsers_of(parser):
    """A parser and those of its verbs."""
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for below in action.choices.values():
                yield from parsers_of(below)


def verb_parser(verb):
    (verbs,) = [one for one in command_line()._actions if isinstance(one, argparse._SubParsersAction)]
    return verbs.choices[verb]


@pytest.mark.parametrize("verb", VERBS)
def test_every_option_is_on_a_page(verb):
    text = "\n".join(page.read_text("utf-8") for page in sorted((REPOSITORY / "docs").glob("*.md")))
    missing = [
        names
        for parser in parsers_of(verb_parser(verb))
        for action in parser._actions
        if (names := action.option_strings)
        and EVERYWHERE.isdisjoint(names)
        and not any(re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", text) for name in names)
    ]
    assert missing == []
