"""Plain data written as YAML reads back as the same data, by us and by another reader."""

from __future__ import annotations

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from rgss.documents import read_document
from rgss.documents.yaml_text import WIDEST_LINE, entry_lines, inline_text, value_lines

TEXTS = st.text(st.characters(exclude_categories=("Cs", "Cc")) | st.sampled_from("\n\t :#-'\"\\{}[],&*!|>%@`"))
VALUES = st.recursive(
    TEXTS | st.integers(-1000, 1000) | st.booleans() | st.none(),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["a", "b", "id", "text"]), inner, max_size=3)
    ),
    max_leaves=6,
)


@given(value=VALUES, indent=st.sampled_from([0, 2, 6]))
def test_a_value_of_a_key_comes_back(value, indent, tmp_path_factory):
    first, *rest = value_lines(value, indent, indent + 4)
    lines = [f"{' ' * indent}key: {first}", *rest]
    text = "\n".join(["top:", *lines, ""]) if indent else "\n".join([*lines, ""])
    ours = tmp_path_factory.getbasetemp() / "value.yaml"
    ours.write_text(text, encoding="utf-8", newline="")
    read = read_document(ours).data
    assert (read["top"] if indent else read) == {"key": value}
    other = yaml.safe_load(text)
    assert (other["top"] if indent else other) == {"key": value}


@given(entry=VALUES)
def test_an_entry_and_a_value_on_one_line_come_back(entry):
    assert yaml.safe_load("\n".join(["list:", *entry_lines(entry, 2)])) == {"list": [entry]}
    assert yaml.safe_load(f"[{inline_text(entry)}]") == [entry]


def test_a_long_text_is_folded_at_blanks_within_the_width():
    text = "The gripper shall close its fingers: within 2 s # in words. " * 5 + "End"
    first, *lines = value_lines(text, 4, 9)
    assert first == ">-"
    assert all(len(line) <= WIDEST_LINE and line.startswith("      ") for line in lines)
    assert yaml.safe_load("\n".join(["    text: >-", *lines])) == {"text": text}


@pytest.mark.parametrize("word", ["yes", "No", "null", "1e5", "0x10", "2026-01-01", "12:30", "1_000", "~", "true"])
def test_a_word_that_another_reader_takes_for_something_else_is_quoted(word):
    assert value_lines(word, 0) == [f'"{word}"']
    assert value_lines("25 s", 0) == ["25 s"]
