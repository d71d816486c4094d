"""Which inputs differ from those of a baseline."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rgss.regression.input_changes import value_changes


@pytest.mark.parametrize(
    ("then", "now", "expected"),
    [
        ({"a": "1"}, {"a": "1", "b": "None"}, []),
        ({"a": "1", "b": "None"}, {"a": "1"}, []),
        ({"a": "1"}, {"a": "1", "b": "''", "c": "[]"}, []),
        ({"a": "1", "b": "'x'"}, {"a": "1", "b": "''"}, [("b", "'x'", "''")]),
        ({"a": "1", "b": "None"}, {"a": "1", "b": "2"}, [("b", "None", "2")]),
        ({"a": "1"}, {"a": "1", "b": "2"}, [("b", "–", "2")]),
    ],
)
def test_an_input_that_is_none_is_the_same_as_one_that_is_absent(then, now, expected):
    baseline = SimpleNamespace(inputs_of=lambda *_: then)
    assert [(one.name, one.then, one.now) for one in value_changes(baseline, {"contact": {3: now}})] == expected
