"""Changes to a YAML file leave what they do not touch."""

from __future__ import annotations

import pytest
import yaml

from rgss.documents.editing import AppendEntry, RemoveEntry, RemoveKey, SetKey, edited
from rgss.errors import DefinitionError

TEXT = """\
# About all of it.
requirements:
  - id: A # the first
    text: >-
      A long
      text.

    # About the owner.
    owner: "x"  # who
    links: # to where
      - a # why
      - b
    criterion:
      measure: m
      threshold: 1 s # one

  # Before B.
  - {id: B, owner: y, n: 1}

  - id: C
    owner: z
# The end.
"""
A, B, C = (("requirements", index) for index in range(3))


def lines_changed(before: str, after: str) -> tuple[list[str], list[str]]:
    old, new = before.splitlines(), after.splitlines()
    return [line for line in old if line not in new], [line for line in new if line not in old]


@pytest.mark.parametrize(
    ("edit", "gone", "come"),
    [
        (SetKey(location=A, key="owner", value="y: #"), ['    owner: "x"  # who'], ['    owner: "y: #"  # who']),
        (
            SetKey(location=A, key="text", value="New"),
            ["    text: >-", "      A long", "      text."],
            ["    text: New"],
        ),
        (
            SetKey(location=A, key="links", value=["c"]),
            ["    links: # to where", "      - a # why", "      - b"],
            ["    links: [c] # to where"],
        ),
        (
            SetKey(location=(*A, "criterion"), key="threshold", value="2 s"),
            ["      threshold: 1 s # one"],
            ["      threshold: 2 s # one"],
        ),
        (
            SetKey(location=B, key="owner", value="a, b"),
            ["  - {id: B, owner: y, n: 1}"],
            ['  - {id: B, owner: "a, b", n: 1}'],
        ),
        (
            SetKey(location=B, key="kind", value="k", before=("id",)),
            ["  - {id: B, owner: y, n: 1}"],
            ["  - {id: B, kind: k, owner: y, n: 1}"],
        ),
        (SetKey(location=C, key="kind", value="k", before=("id",)), [], ["    kind: k"]),
        (SetKey(location=C, key="kind", value="k"), [], ["    kind: k"]),
        (RemoveKey(location=A, key="owner"), ['    owner: "x"  # who'], []),
        (
            RemoveKey(location=A, key="criterion"),
            ["    criterion:", "      measure: m", "      threshold: 1 s # one"],
            [],
        ),
        (RemoveKey(location=B, key="n"), ["  - {id: B, owner: y, n: 1}"], ["  - {id: B, owner: y}"]),
        (RemoveKey(location=B, key="owner"), ["  - {id: B, owner: y, n: 1}"], ["  - {id: B, n: 1}"]),
        (RemoveEntry(location=("requirements",), index=2), ["  - id: C", "    owner: z"], []),
        (RemoveEntry(location=("requirements",), index=1), ["  - {id: B, owner: y, n: 1}"], []),
        (AppendEntry(key="requirements", entry={"id": "D"}), [], ["  - id: D"]),
        (AppendEntry(key="blocks", entry={"id": "D"}), [], ["blocks:", "  - id: D"]),
    ],
)
def test_an_edit_touches_its_own_lines_alone(edit, gone, come):
    assert lines_changed(TEXT, edited(TEXT, [edit])) == (gone, come)


def test_a_long_text_keeps_the_comment_of_its_line():
    after = edited(TEXT, [SetKey(location=A, key="owner", value="word " * 40 + "end")])
    assert "    owner: >-  # who\n" in after
    assert yaml.safe_load(after)["requirements"][0]["owner"] == "word " * 40 + "end"


def test_many_edits_at_once_make_what_they_say():
    edits = [
        RemoveKey(location=A, key="criterion"),
        SetKey(location=A, key="success", value="s", before=("id", "owner")),
        SetKey(location=A, key="phase", value="p", before=("id", "owner")),
        RemoveKey(location=B, key="owner"),
        RemoveKey(location=B, key="n"),
        RemoveKey(location=C, key="owner"),
        AppendEntry(key="requirements", entry={"id": "D", "text": "t"}),
        AppendEntry(key="requirements", entry={"id": "E"}),
    ]
    expected = [
        {"id": "A", "text": "A long text.", "owner": "x", "success": "s", "phase": "p", "links": ["a", "b"]},
        {"id": "B"},
        {"id": "C"},
        {"id": "D", "text": "t"},
        {"id": "E"},
    ]
    assert yaml.safe_load(edited(TEXT, edits))["requirements"] == expected


def test_the_last_entry_goes_and_another_comes():
    edits = [RemoveEntry(location=("requirements",), index=2), AppendEntry(key="requirements", entry={"id": "D"})]
    assert [each["id"] for each in yaml.safe_load(edited(TEXT, edits))["requirements"]] == ["A", "B", "D"]


def test_a_list_that_loses_every_entry_is_an_empty_list():
    edits = [RemoveEntry(location=("requirements",), index=index) for index in range(3)]
    after = edited(TEXT, edits)
    assert yaml.safe_load(after)["requirements"] == []
    assert yaml.safe_load(edited(TEXT, [*edits, AppendEntry(key="requirements", entry={"id": "D"})])) == {
        **yaml.safe_load(TEXT),
        "requirements": [{"id": "D"}],
    }


@pytest.mark.parametrize("text", ["a: [{id: A}, {id: B}, {id: C}]\n", "a: [{id: A}, {id: B}, {id: C},]\n"])
@pytest.mark.parametrize("gone", [{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}])
def test_any_entries_of_a_list_on_one_line_may_go(text, gone):
    edits = [RemoveEntry(location=("a",), index=index) for index in sorted(gone)]
    left = [each for index, each in enumerate(yaml.safe_load(text)["a"]) if index not in gone]
    assert yaml.safe_load(edited(text, edits))["a"] == left


def test_a_file_without_a_last_line_break_and_one_with_windows_breaks():
    assert edited("a:\n  - id: A", [AppendEntry(key="a", entry={"id": "B"})]) == "a:\n  - id: A\n\n  - id: B"
    windows = TEXT.replace("\n", "\r\n")
    after = edited(windows, [SetKey(location=A, key="text", value="word " * 40 + "end")])
    assert "\n" not in after.replace("\r\n", "")


@pytest.mark.parametrize("lists", ["a: [{id: A}, {id: B}]\n", "a: [x, {id: B}]\n"])
def test_lists_on_one_line(lists):
    edits = [RemoveEntry(location=("a",), index=0), AppendEntry(key="a", entry={"id": "C"})]
    assert edited(lists, edits) == "a: [{id: B}, {id: C}]\n"
    assert edited("a: []\n", [AppendEntry(key="a", entry="x")]) == "a: [x]\n"


def test_pythons_parser_and_libyaml_place_the_ends_alike(monkeypatch):
    edits = [SetKey(location=A, key="text", value="New"), AppendEntry(key="requirements", entry={"id": "D"})]
    by_default = edited(TEXT, edits)
    monkeypatch.setattr(yaml, "CSafeLoader", yaml.SafeLoader)
    assert edited(TEXT, edits) == by_default


def test_a_list_that_is_new_takes_several_entries():
    edits = [AppendEntry(key="blocks", entry={"id": name}) for name in ("D", "E")]
    assert yaml.safe_load(edited(TEXT.rstrip("\n"), edits))["blocks"] == [{"id": "D"}, {"id": "E"}]


def test_a_place_that_is_not_there_is_said():
    with pytest.raises(DefinitionError, match=r"^the file has no value at requirements\.9"):
        edited(TEXT, [SetKey(location=("requirements", 9), key="a", value="b")])
    with pytest.raises(DefinitionError, match="the edits of a file must not overlap"):
        edited(TEXT, [RemoveKey(location=A, key="criterion"), SetKey(location=A, key="criterion", value="x")])
