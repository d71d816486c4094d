"""Words of ``rgss evidence`` that are not understood, and its help."""

from __future__ import annotations

import pytest


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["nope"], "rgss evidence: argument ACTION: invalid choice: 'nope'"),
        (["export"], "rgss evidence export: the following arguments are required: FILE"),
        (["gc", "--apply", "--dry-run"], "rgss evidence gc: argument --dry-run: not allowed with argument --apply"),
        (["verify", "--apply"], "rgss evidence verify: unrecognized arguments: --apply"),
    ],
)
def test_words_that_are_not_understood(rgss, words, complaint):
    told = rgss("evidence", *words)

    assert (told.status, told.output) == (2, "")
    assert told.complaint.startswith(complaint)


@pytest.mark.parametrize("action", ["verify", "export", "gc"])
def test_help_of_an_action(rgss, action):
    told = rgss("evidence", action, "--help")

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith(f"usage: rgss evidence {action} ")
    assert "--project DIR" in told.output
