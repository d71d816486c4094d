"""The inputs that the page of measures names are those of the shipped measures."""

from __future__ import annotations

import re

import pytest

from rgss.trials.metrics import METRICS
from tests.fixtures.shipped_project import REPOSITORY

PAGE = (REPOSITORY / "docs" / "measures.md").read_text(encoding="utf-8")
ROWS = [
    (measure, set(re.findall(r"`(trial\.\w+)`", inputs)))
    for measures, inputs in re.findall(r"(?m)^\| (`\w+`(?:, `\w+`)*) \| ([^|]*trial\.[^|]*) \|", PAGE)
    for measure in re.findall(r"`(\w+)`", measures)
]


@pytest.mark.parametrize(("measure", "inputs"), ROWS)
def test_the_named_inputs_are_those_of_the_measure(shipped, measure, inputs):
    used = {source for source in shipped.measures.sources(measure) if source.startswith("trial.")}
    assert used <= inputs
    assert inputs <= {f"trial.{name}" for name in METRICS}


def test_every_row_of_the_table_is_compared():
    assert len(ROWS) == 14
