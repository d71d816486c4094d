"""Edits beside comments, omitted values, and what PyYAML's two parsers read differently."""

from __future__ import annotations

import pytest
import yaml

from rgss.documents import AppendEntry, RemoveEntry, RemoveKey, SetKey, edited, read_document

FOLDED = """\
r:
  - a: >-
      text
    b:
      - x
      # of x

      # of b
    c: 1
  - a: >-
      last
      # of the last
"""
FIRST, SECOND = ("r", 0), ("r", 1)


@pytest.fixture(params=["libyaml", "python"])
def data_of(request, tmp_path, monkeypatch):
    """Data of a text after some edits, with each parser."""
    if request.param == "python":
        monkeypatch.delattr(yaml, "CSafeLoader")

    def read(text, *edits):
        (tmp_path / "f.yaml").write_text(edited(text, edits), encoding="utf-8")
        return read_document(tmp_path / "f.yaml").data

    return read


def test_a_removed_key_leaves_no_comment_in_the_text_before_it(data_of):
    data = data_of(FOLDED, RemoveKey(location=FIRST, key="b"))
    assert data["r"][0] == {"a": "text", "c": 1}


@pytest.mark.parametrize("value", ["a word " * 40, "two\nlines"])
def test_a_replaced_value_takes_no_comment_into_its_text(data_of, value):
    data = data_of(FOLDED, SetKey(location=FIRST, key="b", value=value.strip(), before=()))
    assert data["r"][0] == {"a": "text", "b": value.strip(), "c": 1}


def test_a_new_key_takes_no_comment_into_its_text(data_of):
    data = data_of(FOLDED, SetKey(location=FIRST, key="d", value="a word " * 40 + "end", before=("b",)))
    assert data["r"][0]["d"] == "a word " * 40 + "end"


def test_a_removed_entry_leaves_no_comment_in_the_text_before_it(data_of):
    text = FOLDED.replace("    b:\n      - x\n      # of x\n\n      # of b\n    c: 1\n", "")
    assert data_of(text, RemoveEntry(location=("r",), index=1)) == {"r": [{"a": "text"}]}
    assert "# of the last" not in edited(text, [RemoveEntry(location=("r",), index=1)])


def test_a_new_entry_takes_no_comment_into_its_text(data_of):
    entry = {"a": "a word " * 40 + "end"}
    assert data_of(FOLDED.replace(">-\n      last", "last"), AppendEntry(key="r", entry=entry))["r"][2] == entry


def test_comments_of_what_follows_stay():
    text = "r:\n  - a: 1\n    b: 2\n    # of c\n    c: 3\n  # of the next\n  - a: 4\n"
    assert "    # of c\n    c: 3\n" in edited(text, [RemoveKey(location=FIRST, key="b")])
    assert "  # of the next\n  - a: 4\n" in edited(text, [RemoveEntry(location=("r",), index=0)])


@pytest.mark.parametrize("text", ["r: [{a:, b: 1}]", "r: [{b: 1, a:}]", "r: [{b: 1, a: }]", "r: [{a: , b: 1}]\r\n"])
@pytest.mark.parametrize("value", ["", "x", True, 3, ["y"]])
def test_an_omitted_value_is_set(data_of, text, value):
    """libyaml rejects the first of these texts, and locates the omitted value elsewhere in others."""
    assert data_of(text, SetKey(location=FIRST, key="a", value=value, before=())) == {"r": [{"a": value, "b": 1}]}
