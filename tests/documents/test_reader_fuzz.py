"""Whatever stands in a file: plain data, or findings inside the file, and nothing else."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

import pytest
import yaml
from hypothesis import example, given
from hypothesis import strategies as st

from rgss.documents import read_document
from rgss.documents.reader import Document
from rgss.errors import DocumentError

_PIECES = st.sampled_from(
    [
        *("a", "b", "1", "1e3", ".5", "~", "é", "𝄞", "=", "0o7", "120 mm", "<<", "\\", '"\\ud800"'),
        *(": ", ":", "- ", "[", "]", "{", "}", ",", "? ", "'", '"', "|", ">", "#", "@", "`"),
        *("&x ", "*x", "!t ", "!!str ", "%YAML 1.1\n", "---", "..."),
        *("\n", "\t", "  ", "\r", "\x85", "\u2028", "\ufeff", "\x00"),
    ]
)
_YAML_LIKE = st.lists(_PIECES, max_size=40).map("".join)
_PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**17), 10**17) | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(st.characters(exclude_categories=["C"]), max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text("abcdefgh", min_size=1), inner, max_size=4),
    max_leaves=12,
)  # fmt: skip


def read(content: bytes) -> Document | DocumentError:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "file.yaml")
        path.write_bytes(content)
        try:
            return read_document(path)
        except DocumentError as error:
            return error


def assert_inside(line: int, column: int, text: str) -> None:
    lines = re.split("\r\n|[\n\r\x85\u2028\u2029]", text)
    assert 1 <= line <= len(lines)
    assert 1 <= column <= len(lines[line - 1]) + 1


def assert_data_or_findings_inside(content: bytes) -> None:
    outcome = read(content)
    text = content.decode("utf-8-sig", errors="replace")
    if isinstance(outcome, Document):
        positions = [*outcome.values.values(), *outcome.keys.values()]
    else:
        assert outcome.findings
        assert list(outcome.findings) == sorted(outcome.findings)
        assert not any(re.search("[\n\r]", str(finding)) for finding in outcome.findings)
        positions = [(finding.line, finding.column) for finding in outcome.findings]
    for position in positions:
        assert_inside(*position, text)


@given(st.binary(max_size=60) | st.text(max_size=60).map(lambda text: text.encode("utf-8", "surrogatepass")))
def test_any_bytes(content):
    assert_data_or_findings_inside(content)


@given(_YAML_LIKE)
@example("a: |\n\n\n")
@example("? ")
@example("{? a, : }")
def test_anything_like_yaml(text):
    assert_data_or_findings_inside(text.encode("utf-8"))


@pytest.mark.usefixtures("pure_parser")
@given(_YAML_LIKE)
def test_anything_like_yaml_without_libyaml(text):
    assert_data_or_findings_inside(text.encode("utf-8"))


@given(_PLAIN.filter(lambda value: value is not None))
def test_what_is_written_is_read_again(value):
    outcome = read(_written(value).encode("utf-8"))

    assert isinstance(outcome, Document)
    assert outcome.data == value


def _written(value: object) -> str:
    """The value in flow style, every text quoted, by an oracle of our own."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, list):
        return "[" + ", ".join(_written(item) for item in value) + "]"
    assert isinstance(value, dict)
    return "{" + ", ".join(f"'{key}': {_written(item)}" for key, item in value.items()) + "}"


@pytest.fixture(scope="module")
def pure_parser():
    with pytest.MonkeyPatch.context() as patch:
        patch.delattr(yaml, "CSafeLoader")
        yield
