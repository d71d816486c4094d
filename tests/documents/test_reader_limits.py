"""Files that hold more than anybody means them to: refused soon, with the first of what is wrong."""

from __future__ import annotations

import resource
from typing import Annotated

import pytest

from rgss.documents import DocumentModel, Identifier, Text, load_document, read_document
from rgss.documents.composing import MOST_VALUES
from rgss.documents.refusals import MOST_PROBLEMS
from rgss.errors import DocumentError

MANY = f"more than {MOST_PROBLEMS} problems; the first {MOST_PROBLEMS} are shown (correct these first) [document.many]"


class Entry(DocumentModel):
    id: Identifier
    text: Text
    names: tuple[Identifier, ...] = ()


class File(DocumentModel):
    entries: tuple[Entry, ...]
    note: Annotated[str, "last in the file"] = ""


def findings_of(path):
    with pytest.raises(DocumentError) as caught:
        load_document(path, File, label="f.yaml")
    return caught.value.findings


def test_six_megabytes_of_nested_lists_are_refused(write):
    row = "[" * 37 + "]" * 37 + ","
    path = write("entries: [" + row * (6 * 1024 * 1024 // len(row)) + "]")

    (finding,) = findings_of(path)

    assert finding.message == "holds more than 500000 values"
    assert (finding.rule, finding.hint) == ("document.values", "divide it into several files")


def test_as_many_values_as_are_allowed(write):
    assert len(read_document(write("[" + "1," * (MOST_VALUES - 1) + "]")).data) == MOST_VALUES - 1
    with pytest.raises(DocumentError, match="holds more than 500000 values"):
        read_document(write("[" + "1," * MOST_VALUES + "]"))


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("entries: [" + "{}," * 60_000 + "]", "document.missing-key"),
        ("entries: [" + "1," * 200_000 + "]", "document.value"),
        ("entries: [{id: A, text: T, names: [" + "1," * 200_000 + "]}]", "document.value"),
        ("entries: [{id: A, text: T," + ",".join(f"k{n}: 1" for n in range(30_000)) + "}]", "document.unknown-key"),
        ("entries: [{" + ",".join("k: 1" for _ in range(100_000)) + "}]", "document.duplicate-key"),
        ("entries: [" + "*a," * 200_000 + "]", "document.alias"),
    ],
    ids=["missing keys", "wrong values", "wrong names", "unknown keys", "keys twice", "aliases"],
)
def test_of_many_problems_the_first_are_shown(write, text, rule):
    path = write(text)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    first, *others = findings_of(path)

    assert str(first) == f"f.yaml:1:1: error: {MANY}"
    assert len(others) == MOST_PROBLEMS
    assert {finding.rule for finding in others} == {rule}
    assert [finding.column for finding in others] == sorted(finding.column for finding in others)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 1024 * 1024


@pytest.mark.parametrize("count", [MOST_PROBLEMS - 1, MOST_PROBLEMS])
def test_as_many_problems_as_are_shown(write, count):
    findings = findings_of(write("entries: [" + "1," * count + "]"))

    assert len(findings) == count
    assert {finding.rule for finding in findings} == {"document.value"}


def test_problems_behind_many_sound_entries_are_found(write):
    """The beginning of the file that is looked at is as long as it must be."""
    sound, broken = "{id: A, text: T},", "{id: 1, text: 1},"
    findings = findings_of(write("entries: [" + sound * 30_000 + broken * 30_000 + "]\nnote: 7\n"))

    assert len(findings) == MOST_PROBLEMS + 1
    assert findings[1].column == len("entries: [") + 30_000 * len(sound) + len("{id: ") + 1
