"""The glossary: its terms are in alphabetical order, and the names of code and of YAML keys in it exist."""

from __future__ import annotations

import importlib
import re
from itertools import groupby
from pathlib import Path

import pytest

from rgss.documents import read_document
from rgss.scenes.uncertainty import QUANTITIES
from rgss.tradeoff import ShapeKeys

REPOSITORY = Path(__file__).resolve().parents[2]
LINES = (REPOSITORY / "docs" / "glossary.md").read_text(encoding="utf-8").splitlines()
ROWS = [[cell.strip() for cell in line.strip("|").split("|")] for line in LINES if line.startswith("| ")]
SPANS = sorted({name for _, _, where in ROWS for name in re.findall(r"`([^`]+)`", where)})

DEFINITION = re.compile(r"^(?: *(?:class|def) |    )(\w+)(?=[(:])", re.MULTILINE)
KEY = re.compile(r"[\w.]+:( [\w.]+)?")
MODULE = re.compile(r"rgss(\.\w+)+")
IDENTIFIER = re.compile(r"[A-Z]\w*(\.\w+)?|[a-z]+(_[a-z]+)+")
ELSEWHERE = re.compile(
    r"rgss [a-z].*|--[a-z-]+.*|.*/.*|.*\.(toml|json)|\[.*\]|study\.\w+\(\)|shape\.MEASURE|stale|info|satisfy"
)
"""Commands, files and paths, which `test_documentation.py` checks, and values."""


def keys_of_files() -> set[str]:
    """Every key of a YAML file."""
    texts = read_document(REPOSITORY / "rgss" / "studies" / "schemas" / "field_descriptions.yaml").data
    return {key for keys in texts.values() for key in keys} | set(ShapeKeys.model_fields)


def names_of_code() -> set[str]:
    """Every class, function and annotated field that the package defines."""
    texts = (path.read_text(encoding="utf-8") for path in (REPOSITORY / "rgss").rglob("*.py"))
    return {name for text in texts for name in DEFINITION.findall(text)}


def exists_at_import(name: str) -> bool:
    """True for a module, or a name of a module."""
    module, _, attribute = name.rpartition(".")
    try:
        return hasattr(importlib.import_module(module), attribute) or bool(importlib.import_module(name))
    except ModuleNotFoundError:
        return False


def is_known(span: str, keys: set[str], names: set[str]) -> bool:
    """True if a code span of the glossary names something that exists."""
    if MODULE.fullmatch(span):
        return exists_at_import(span)
    if KEY.fullmatch(span):
        return span.partition(":")[0].rpartition(".")[2] in keys
    if IDENTIFIER.fullmatch(span):
        return set(span.split(".")) <= names
    return span in QUANTITIES or ELSEWHERE.fullmatch(span) is not None


@pytest.fixture(scope="module")
def known():
    return keys_of_files(), names_of_code()


def test_names_of_code_and_of_keys_exist(known):
    assert len(SPANS) > 60
    assert [span for span in SPANS if not is_known(span, *known)] == []


@pytest.mark.parametrize(
    "span", ["rgss.trials.nothing", "perceptions:", "Phases", "Conditions.seen_scene", "make_plans"]
)
def test_a_name_that_does_not_exist_is_found(span, known):
    assert not is_known(span, *known)


def test_terms_are_in_alphabetical_order():
    tables = [[*lines] for is_row, lines in groupby(LINES, lambda line: line.startswith("| ")) if is_row]
    terms = [[line.strip("|").split("|")[0].strip().lower() for line in table] for table in tables]

    # Each table has its heading apart, before the line of dashes.
    assert [table for table in terms if table != sorted(table)] == []
