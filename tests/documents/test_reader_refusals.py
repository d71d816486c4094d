"""What the reader refuses, each at its place and with a way out."""

from __future__ import annotations

import pytest

from rgss.documents import read_document
from rgss.errors import DocumentError

pytestmark = pytest.mark.usefixtures("parser")


def findings_of(path):
    with pytest.raises(DocumentError) as caught:
        read_document(path, label="f.yaml")
    return caught.value.findings


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a: !!python/object:os.system x\n", "1:4: error: tag 'tag:yaml.org,2002:python/object:os.system' is refused"),
        ("a: !!str 1\n", "1:4: error: tag 'tag:yaml.org,2002:str' is refused (remove the tag) [document.tag]"),
        ("a: !Shape {b: 1}\n", "1:4: error: tag '!Shape' is refused (remove the tag) [document.tag]"),
        ("a: !Shape [1]\n", "1:4: error: tag '!Shape' is refused (remove the tag) [document.tag]"),
        ("a: ! 1\n", "1:4: error: tag '!' is refused (remove the tag) [document.tag]"),
        ("!k a: 1\n", "1:1: error: tag '!k' is refused (remove the tag) [document.tag]"),
        ("a: !<%0Ax> 1\n", "1:4: error: tag '\\nx' is refused (remove the tag) [document.tag]"),
        ("a: &x 1\n", "1:4: error: anchor &x is refused (write the value out) [document.alias]"),
        ("a: &x [1]\n", "1:4: error: anchor &x is refused (write the value out) [document.alias]"),
        ("&x a: 1\n", "1:1: error: anchor &x is refused (write the value out) [document.alias]"),
        ("a: *x\n", "1:4: error: alias *x is refused (write the value out) [document.alias]"),
        ("*x\n", "1:1: error: alias *x is refused (write the value out) [document.alias]"),
        ("*x : 1\n", "1:1: error: alias *x is refused (write the value out) [document.alias]"),
        ("<<: {a: 1}\n", "1:1: error: merge key << is refused (write the keys out) [document.merge-key]"),
        (
            "a: 1\nb: 2\na: 3\n",
            "3:1: error: key 'a' is already in line 1 (keep one) [document.duplicate-key]",
        ),
        (
            "x: {'a': 1, a: 3}\n",
            "1:13: error: key 'a' is already in line 1 (keep one) [document.duplicate-key]",
        ),
        (
            "a: 1\n---\nb: 2\n",
            "2:1: error: a second document in one file (remove the '---') [document.several]",
        ),
        (
            "[a, b]: 1\n",
            "1:1: error: a key must be a text (write one word or a quoted text) [document.key]",
        ),
        (
            "? {a: 1}\n: 1\n",
            "1:3: error: a key must be a text (write one word or a quoted text) [document.key]",
        ),
        ("%YAML 3.0\n---\na: 1\n", "1:1: error: a directive is refused (remove the line with the '%')"),
        ("# c\n\n%FOO\n---\na: 1\n", "3:1: error: a directive is refused (remove the line with the '%')"),
        ("a: b\x07\n", "1:5: error: the character U+0007 is not allowed (remove it) [document.character]"),
        ("é: 𝄞\x00\n", "1:5: error: the character U+0000 is not allowed (remove it) [document.character]"),
        ("a: 1\r\nb: \x7f\n", "2:4: error: the character U+007F is not allowed (remove it) [document.character]"),
        ("a: 1\nb: \ufeff\n", "2:4: error: the character U+FEFF is not allowed (remove it) [document.character]"),
        ("a: \uffff\n", "1:4: error: the character U+FFFF is not allowed (remove it) [document.character]"),
    ],
)
def test_refusal(write, text, expected):
    (finding,) = findings_of(write(text))

    assert str(finding).startswith(f"f.yaml:{expected}")


@pytest.mark.parametrize("text", ["", "\n\n", "# only a comment\n", "---\n", "--- # comment\n...\n", "null\n", "~\n"])
def test_empty(write, text):
    (finding,) = findings_of(write(text))

    assert (
        str(finding)
        == "f.yaml:1:1: error: the file is empty (give it the keys that its kind of file has) [document.empty]"
    )


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a: [1, 2\n", 2),
        ("a: {b: 1\n", 2),
        ("a: 'open\n", 2),
        ('a: "\\q"\n', 1),
        ("a: 1\n b: 2\n", 2),
        ("a: b: c\n", 1),
        ("\ta: 1\n", 1),
        ("a: 1\n\tb: 2\n", 2),
        ("a: @x\n", 1),
        ("a: %x\n", 1),
        ("- a\nb: 1\n", 2),
        ("a: ]\n", 1),
        ("a: !x!y 1\n", 1),
    ],
)
def test_syntax_error(write, text, line):
    (finding,) = findings_of(write(text))

    assert finding.rule == "document.syntax"
    assert finding.message.startswith("not valid YAML: ")
    assert "\n" not in finding.message
    assert finding.line == line


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("a:\n\tb: 1\n", "indent with spaces, not tabs"),
        ("a: 1\nb:\n\t- [", "indent with spaces, not tabs"),
        ("a:\n\tb: [\n", "indent with spaces, not tabs"),
        ("a: [", ""),
        ("a: 'b\n", ""),
    ],
)
def test_a_tab_is_told_from_other_mistakes(write, text, hint):
    (finding,) = findings_of(write(text))

    assert (finding.rule, finding.hint) == ("document.syntax", hint)


def test_half_of_a_surrogate_pair(write):
    (finding,) = findings_of(write('a: "\\ud800"\n'))

    assert finding.rule in ("document.syntax", "document.character")
    assert finding.line == 1


@pytest.mark.parametrize("opening", ["[", "- ", "{a: ", "? ", "{", "{? ", "[{", "a:\n"])
def test_nested_too_deep(write, opening):
    text = "".join(" " * level + opening for level in range(1400)) if opening.endswith("\n") else opening * 100_000
    findings = findings_of(write(text))

    assert "document.nesting" in {finding.rule for finding in findings}
    assert findings[-1].message == "nested more than 40 deep"


def test_alias_bomb_is_not_expanded(write):
    levels = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    levels += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    findings = findings_of(write("\n".join(levels)))

    assert {finding.rule for finding in findings} == {"document.alias"}
    assert len(findings) == 12 + 11 * 9


def test_all_problems_at_once_in_the_order_of_their_places(write):
    findings = findings_of(write("a: &x 1\nb: !t 2\na: 3\nc: *x\n<<: 4\nd: [1\n"))

    assert [(finding.line, finding.rule) for finding in findings] == [
        (1, "document.alias"),
        (2, "document.tag"),
        (3, "document.duplicate-key"),
        (4, "document.alias"),
        (5, "document.merge-key"),
        (7, "document.syntax"),
    ]


def test_what_stands_within_a_refused_key_is_looked_at_too(write):
    findings = findings_of(write("? [&x a]\n: *y\n"))

    assert [finding.rule for finding in findings] == ["document.key", "document.alias", "document.alias"]


def test_long_texts_are_shown_cut(write):
    key = "k" * 1000
    (finding,) = findings_of(write(f"{key}: 1\n{key}: 2\n"))

    assert len(finding.message) < 120
    assert "kkk…' is already in line 1" in finding.message
