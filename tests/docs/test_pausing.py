"""The example of docs/api.md that pauses a simulation."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rgss.evidence import record_digest
from rgss.trials.pieces import run_trial

REPOSITORY = Path(__file__).parents[2]


@pytest.mark.engine
def test_a_paused_simulation_gives_the_record_of_one_that_is_not(monkeypatch):
    page = (REPOSITORY / "docs/api.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"## Pausing a simulation\n.*?```python\n(.*?)```", page, re.DOTALL)
    monkeypatch.chdir(REPOSITORY)
    names = {"__name__": "example"}

    exec(compile(example, "docs/api.md", "exec"), names)  # noqa: S102 - the page's own example

    (record,) = names["records"]
    assert names["simulation"].state.value == "shut_down"
    assert record_digest(record) == record_digest(run_trial(names["spec"]))
