"""docs/api.md names what the Python interface has: each method with its arguments, each attribute, nothing left out."""

from __future__ import annotations

import inspect
import re

import pytest

import rgss
from rgss.api.plots import Plots
from rgss.api.study import Study
from rgss.api.trade import Trade
from rgss.api.trial import Trial
from rgss.studies import Project
from rgss.tradeoff import Decision
from rgss.trials.payload_bench import PayloadResult
from tests.fixtures.shipped_project import REPOSITORY

PAGE = (REPOSITORY / "docs" / "api.md").read_text(encoding="utf-8")
TABLES = [
    ("## A study", "| `variants`, `trials`", Study),
    ("## A study", "| `decision`, `ranking`, `pareto`, `enumeration`", Trade),
    ("## Figures", "| `plot.pareto(", Plots),
]
"""Section, beginning of the first row of the table, and the class that it describes."""

LISTED = [("`decision` |", Decision), ("`payload(", PayloadResult), ("`project` |", Project)]
"""Rows whose content names attributes of another class."""


def section(head):
    return re.split(r"^## ", PAGE.split(f"\n{head}\n")[1], flags=re.MULTILINE)[0]


def described(head, first):
    """The names in the first column of a table, with their arguments."""
    table = section(head)[section(head).index(first) :].split("\n\n")[0]
    return [
        span.removeprefix("plot.")
        for row in table.splitlines()
        for span in re.findall(r"`([^`]+)`", row.split(" | ")[0])
    ]


def arguments(function):
    """The arguments of a method as the page writes them: without types."""
    bare = [
        parameter.replace(annotation=inspect.Parameter.empty)
        for parameter in inspect.signature(function).parameters.values()
        if parameter.name != "self"
    ]
    return str(inspect.Signature(bare)).replace("'", '"')


def public(cls):
    fields = getattr(cls, "__dataclass_fields__", {})
    return {name for name in (*vars(cls), *fields) if not name.startswith("_")}


@pytest.mark.parametrize(("head", "first", "cls"), TABLES, ids=lambda value: getattr(value, "__name__", ""))
def test_a_table_has_every_public_name_with_its_arguments(head, first, cls):
    spans = described(head, first)

    # What a `Plots` is made from are no figures.
    inputs = set(Plots.__dataclass_fields__) if cls is Plots else set()
    assert {span.partition("(")[0] for span in spans} == public(cls) - inputs
    for span in spans:
        name, bracket, _ = span.partition("(")
        member = inspect.getattr_static(cls, name, None)
        assert bool(bracket) == inspect.isfunction(member), span
        if bracket:
            assert span.removeprefix(name) == arguments(member)


def test_the_section_on_a_trial_has_every_public_name():
    spans = re.findall(r"`([^`]+)`", section("## A trial"))
    named = {span.partition("(")[0]: span for span in spans if "study." not in span and not span.startswith("rgss ")}

    assert set(named) == public(Trial)
    for name in ("figure", "filmstrip"):
        assert named[name].removeprefix(name) == arguments(getattr(Trial, name))


def test_load_study_has_the_stated_arguments():
    assert f"`rgss.load_study{arguments(rgss.load_study)}`" in PAGE
    rows = section("## Loading").split("|---|---|---|\n")[1].split("\n\n")[0].splitlines()
    assert [row.split("`")[1] for row in rows] == list(inspect.signature(rgss.load_study).parameters)


@pytest.mark.parametrize(("row", "cls"), LISTED, ids=lambda value: getattr(value, "__name__", ""))
def test_attributes_that_a_row_lists_are_there(row, cls):
    (content,) = [line.split(" | ")[1] for line in PAGE.splitlines() if line.startswith(f"| {row}")]
    names = re.findall(r"`(\w+)`", content)

    assert len(names) > 2
    assert [name for name in names if not hasattr(cls, name) and name not in cls.__dataclass_fields__] == []
