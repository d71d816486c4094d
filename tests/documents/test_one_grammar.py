"""One grammar with and without libyaml: the same data at the same places, or the same findings."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from rgss.documents import read_document
from rgss.documents.yaml_text import entry_lines, inline_text
from rgss.errors import DocumentError

REPOSITORY = Path(__file__).parents[2]
SHIPPED = sorted(
    path.relative_to(REPOSITORY).as_posix()
    for folder in ("requirements", "designs", "scenes", "studies", "rgss", "docs", "tests")
    for path in (REPOSITORY / folder).rglob("*.yaml")
)

REFUSED = {
    "question mark at a flow value's end": "{a: b?}",
    "question mark before a blank in a flow": "{a: b? }",
    "question mark in a flow key": "{a?: 1}",
    "question mark in a flow list": "a: [b?, c]",
    "question mark within a flow word": "x: [a?b]",
    "question mark in a nested flow": "x: {a: [[{b: c?d}]]}",
    "question mark in the second line of a flow": "x: {a: b,\n  c: d?}",
    "tab before a value": "a:\tb",
    "tab after a blank": "a: \tb",
    "tab before a comment": "a: b\t# c",
    "tab as indentation": "a:\n\tb: 1",
    "tab in a block scalar's indentation": "a: |\n\tx\n",
    "comment at the head of a block scalar": "a: >#b\n  c\n",
    "comment at the head of a kept block scalar": "a: |2-#b\n  c\n",
    "unknown directive": "%FOO x\n---\na: 1",
    "a version twice": "%YAML 1.1\n%YAML 1.1\n---\na: 1",
    "other version": "# c\n\n%YAML 3.0\n---\na: 1",
    "tag directive": "%TAG ! tag:x,2000:\n---\na: !b 1",
    "anchor": "a: &x 1\nb: 2",
    "alias": "a: *x",
    "merge key": "<<: {a: 1}\nb: 2",
    "duplicate key": "a: 1\n'a': 2",
    "two documents": "a: 1\n---\nb: 2",
    "document end and more": "--- {a: 1}\n...\nb",
    "not printable": "a: b\x07",
    "escaped number beyond Unicode": 'a: "\\U00110000"',
    "escaped number beyond 32 bits": 'a: "\\UFFFFFFFF"',
    "half of a surrogate pair": 'a: "\\ud800"',
    "half of a surrogate pair in a key": '"a\\ud800": 1',
    "half of a surrogate pair beside a whole one": 'a: "\\ud83e\\udd16\\udd16"',
    "unknown escape": 'a: "\\q"',
    "byte order mark in the middle": "a: 1\nb: \ufeff2",
    "open flow": "a: [b",
    "open quotation": "a: 'b\nc: 1",
    "reserved sign": "a: @x",
    "key of a list": "? [a]\n: b",
    "comma alone": "[a, , b]",
    "value twice": "a: b: c",
    "list in a line": "key: - a",
    "line separator that ends a key": "a: \x85b",
    "nested too deep": "[" * 60 + "]" * 60,
    "nested far too deep": "{a: " * 2000,
    "bomb": "\n".join(f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 9)),
    "tag of Python": "a: !!python/object:os.system x",
}
READ = {
    "question mark in quotations": '{a: \'b?\', "c?": ["d?"]}',
    "question mark in a block": "a: b? c\nd?: e\nf:\n  - g?\n",
    "question mark after a flow": "a: {b: c}\nd: e?\n",
    "question mark as the key of a line": "? a\n: b",
    "question mark as the key of a flow": "{? a : b}",
    "question mark that begins a word": "a: ?b",
    "tabs within quotations and comments": "a: \"b\tc\" # d\te\nf: 'g\th'",
    "tabs in a block scalar": "a: |\n  b\tc\n",
    "words that were truth values": "a: [yes, no, on, off, y, n, True, FALSE, true]",
    "numbers that were octal or sexagesimal": "a: [010, 0o10, 0x1F, 1:30, 190:20:30, 1_000, .5, 5., 1e3, +1, -0]",
    "not numbers": "a: [.inf, .nan, -.INF, 1e999, 2001-01-01, ~, null, NULL, =]",
    "byte order mark": "\ufeffa: 1",
    "line breaks of Windows": "a: 1\r\nb:\r\n  - c\r\n  - 'd\r\n    e'\r\n",
    "line breaks of old": "a: 1\rb: 2",
    "line separators": "a: 'x\u2028y\u2029z'\nb: 2",
    "beyond the basic plane": "𝔘: [🤖, é]\nb: ü𝄞",
    "per cent in the text": "a: 5 %\nb: 'x\n  %y'",
    "block scalars": "a: |2-\n    x\n   y\nb: >+\n  p\n\n  q\n\nc: 1",
    "escapes": 'a: "\\x41\\u00e9\\U0001F916\\N\\_\\/\\\n  b"',
    "an escaped surrogate pair": '{"a\\ud83e\\udd16": "\\ud83e\\udd16 b"}',
    "words with signs": "a: [-b, b-, b#c, b:c, 'd'':e', a/b]\nc: -d\ne: f#g\nh:: i",
    "empty values": "a:\nb: []\nc: {}\nd: ''\ne: {f, g: }",
    "a version": "%YAML 1.1\n---\na: 1",
    "another version": "# c\n%YAML 1.2\n---\na: 1",
    "a value left out behind comments": "{a: # b\n  # c\n\n  # d: }\n  }",
    "blank lines of Windows at the head": "\r\n" * 200 + "a: 1",
    "signs of comments in a row": "a: b # " + "# " * 200 + "\n" + "#: #\n" * 200,
    "document marks": "--- # c\na: 1\n...\n",
    "no line break at the end": "a:\n- b\n- {c: d}",
}


def reading_of(text: str, folder: Path) -> object:
    path = folder / "f.yaml"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    try:
        document = read_document(path, label="f.yaml")
    except DocumentError as error:
        return [str(finding) for finding in error.findings]
    return repr(document.data), dict(document.values), dict(document.keys)


def test_an_escaped_surrogate_pair_is_one_character(tmp_path):
    """As JSON writes what lies beyond the basic plane."""
    (tmp_path / "f.yaml").write_text(json.dumps({"🤖": "𝄞 b"}), encoding="utf-8")
    assert read_document(tmp_path / "f.yaml", label="f.yaml").data == {"🤖": "𝄞 b"}


def both_readings(text: str, folder: Path) -> tuple[object, object]:
    with_libyaml = reading_of(text, folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.delattr(yaml, "CSafeLoader")
        return with_libyaml, reading_of(text, folder)


@pytest.mark.parametrize("name", SHIPPED)
def test_every_shipped_file_is_read_alike(name, tmp_path):
    fast, slow = both_readings((REPOSITORY / name).read_bytes().decode("utf-8"), tmp_path)
    assert isinstance(fast, tuple), fast
    assert fast == slow


@pytest.mark.parametrize("name", REFUSED)
def test_what_one_parser_refuses_is_refused_at_the_same_place(name, tmp_path):
    fast, slow = both_readings(REFUSED[name], tmp_path)
    assert isinstance(fast, list)
    assert fast == slow
    if name.startswith("question mark"):
        (finding,) = fast
        line, column, _ = finding.removeprefix("f.yaml:").split(":", 2)
        assert REFUSED[name].splitlines()[int(line) - 1][int(column) - 1] == "?"


@pytest.mark.parametrize("name", READ)
def test_what_both_take_is_the_same_data_at_the_same_places(name, tmp_path):
    fast, slow = both_readings(READ[name], tmp_path)
    assert isinstance(fast, tuple), fast
    assert fast == slow


def test_what_is_written_is_read(tmp_path):
    value = {"a": "b?", "c": ["d? e", "?f", {"g": "h?i", "j": "k?"}]}
    for text in (f"x: {inline_text(value)}\n", "\n".join(["x:", *entry_lines(value, 2)]) + "\n"):
        fast, slow = both_readings(text, tmp_path)
        assert fast == slow
        assert isinstance(fast, tuple), fast


def test_libyaml_reads_what_it_can(tmp_path, monkeypatch):
    """Question marks in texts and in blocks do not cost the speed of a file."""

    def never(_):
        raise AssertionError("PyYAML's own parser was asked")

    monkeypatch.setattr(yaml, "SafeLoader", never)
    text = 'a: {b: "c?", d: [e]}\nf: g? h\ni: |\n  {j: k?}\n'
    assert isinstance(reading_of(text, tmp_path), tuple)
    with pytest.raises(AssertionError, match="own parser"):
        reading_of("a: {b: c?}", tmp_path)


_PARTS = st.sampled_from(
    [
        *(
            "a",
            "b: ",
            "c:",
            "- ",
            "? ",
            "?",
            "?d",
            "e?",
            ": ",
            ":",
            ", ",
            ",",
            "[",
            "]",
            "{",
            "}",
            "\n",
            "\n  ",
            "\n    ",
        ),
        *(" ", "\t", "#", " # f", "'", '"', "\\", "\\u0041", "\\ud83d", "\\UFFFFFFFF", "|", ">", "|-\n  ", "&g ", "*g"),
        *("!h ", "!!str ", "%", "%YAML 1.1\n", "---", "--- ", "...", "<<: ", "\r\n", "\r", "\x85", "\u2028", "\ufeff"),
        *("1", "0.5", "-", "é", "🤖", "@", "`", "=", "~", "yes", "\n- ", "\na: ", "\n? ", "\n: "),
    ]
)


@settings(max_examples=300, deadline=None)
@given(st.lists(_PARTS, max_size=14).map("".join))
def test_anything_made_of_yamls_signs_is_read_alike(tmp_path_factory, text):
    fast, slow = both_readings(text, tmp_path_factory.mktemp("fuzz"))
    assert fast == slow
