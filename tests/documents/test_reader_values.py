"""What the reader accepts: plain data that means what it seems to mean, and where each part stands."""

from __future__ import annotations

import math

import pytest

from rgss.documents import read_document

pytestmark = pytest.mark.usefixtures("parser")


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("12", 12),
        ("-3", -3),
        ("+4", 4),
        ("0", 0),
        ("999999999999999999", 999_999_999_999_999_999),
        ("1.5", 1.5),
        ("1.", 1.0),
        (".5", 0.5),
        ("-.5", -0.5),
        ("1e3", 1000.0),
        ("1.5E-3", 0.0015),
        ("0.0", 0.0),
        ("true", True),
        ("false", False),
        ("null", None),
        ("~", None),
        ("", None),
        ("plain words", "plain words"),
        ("'12'", "12"),
        ('"true"', "true"),
        ("''", ""),
        ('"a\\nb"', "a\nb"),
        ("𝄞 é", "𝄞 é"),
        ("[]", []),
        ("{}", {}),
        ("[1, a, [2.5]]", [1, "a", [2.5]]),
        ("{b: 1, 2: x}", {"b": 1, "2": "x"}),
    ],
)
def test_value(write, written, value):
    data = read_document(write(f"key: {written}\n")).data

    assert data == {"key": value}
    assert type(data["key"]) is type(value)


@pytest.mark.parametrize(
    "written",
    [
        *("yes", "no", "on", "off", "y", "n", "Yes", "NO", "True", "TRUE", "False", "Null", "NULL"),
        *("1:30", "12:30:45", "190:20:30.15"),
        *("0o7", "0x1F", "0b101", "010", "007", "00", "0123.5"),
        *("1_000", "1,000", "1e", "e3", ".", "-1-", "+", "1.2.3", "--1"),
        *(".inf", "-.inf", ".nan", "inf", "nan", "1e999", "-1e400"),
        *("2001-12-14", "2001-12-14t21:59:43.10-05:00"),
        *("1234567890123456789012345", "="),
        "<",
        "120 mm",
        "١٢",
    ],
)
def test_text_that_other_readers_take_for_something_else(write, written):
    assert read_document(write(f"key: {written}\n")).data == {"key": written}


def test_no_number_is_infinite(write):
    data = read_document(write("[1e308, 1e309, -1e309, 1e-400]\n")).data

    assert data == [1e308, "1e309", "-1e309", 0.0]
    assert all(math.isfinite(value) for value in data if isinstance(value, float))


def test_keys_are_texts(write):
    assert read_document(write("1: a\ntrue: b\nnull: c\n1.5: d\n'<<': e\n")).data == {
        "1": "a",
        "true": "b",
        "null": "c",
        "1.5": "d",
        "<<": "e",
    }


def test_block_texts(write):
    data = read_document(write("folded: >\n  two\n  lines\nkept: |\n  12\n")).data

    assert data == {"folded": "two lines\n", "kept": "12\n"}


def test_explicit_document_and_directive(write):
    assert read_document(write("%YAML 1.1\n---\na: 1\n...\n")).data == {"a": 1}


def test_positions_of_keys_and_values(write):
    document = read_document(write("first: 1\nlist:\n  - name: a\n    size: 2\n  - {name: b}\n"))

    assert document.keys[("first",)] == (1, 1)
    assert document.values[("first",)] == (1, 8)
    assert document.values[("list",)] == (3, 3)
    assert document.values[("list", 0)] == (3, 5)
    assert document.keys[("list", 0, "size")] == (4, 5)
    assert document.values[("list", 0, "size")] == (4, 11)
    assert document.values[("list", 1)] == (5, 5)
    assert document.values[("list", 1, "name")] == (5, 12)


def test_columns_count_characters_not_bytes(write):
    assert read_document(write("{é𝄞ö: 1, b: 2}\n")).keys[("b",)] == (1, 10)


@pytest.mark.parametrize("line_break", ["\n", "\r\n", "\r"])
def test_line_breaks(write, line_break):
    document = read_document(write(line_break.join(["a: 1", "b: two", ""])))

    assert document.data == {"a": 1, "b": "two"}
    assert document.values[("b",)] == (2, 4)


def test_byte_order_mark_is_not_a_column(write):
    document = read_document(write(b"\xef\xbb\xbfa: 1\n"))

    assert document.data == {"a": 1}
    assert document.values[("a",)] == (1, 4)


def test_nesting_up_to_the_limit(write):
    data = read_document(write("[" * 40 + "]" * 40)).data

    for _ in range(39):
        assert len(data) == 1
        data = data[0]
    assert data == []


def test_label_is_the_path_unless_given(write):
    path = write("a: 1\n")

    assert read_document(path).label == str(path)
    assert read_document(path, label="designs/catalogue.yaml").label == "designs/catalogue.yaml"


def test_finding_at_a_location_or_the_nearest_around_it(write):
    document = read_document(write("top:\n  - size: 1\n"), label="f.yaml")

    exact = document.finding("rule.id", "bad", ("top", 0, "size"), hint="mend it")
    at_key = document.finding("rule.id", "bad", ("top", 0, "size"), at_key=True)
    around = document.finding("rule.id", "bad", ("top", 0, "missing"))
    passed_over = document.finding("rule.id", "bad", ("top", "tag-of-a-union", 0, "size"))
    whole = document.finding("rule.id", "bad")

    assert str(exact) == "f.yaml:2:11: error: bad (mend it) [rule.id]"
    assert (at_key.line, at_key.column) == (2, 5)
    assert (around.line, around.column) == (2, 5)
    assert (passed_over.line, passed_over.column) == (2, 11)
    assert (whole.line, whole.column) == (1, 1)
    assert document.finding("rule.id", "bad", ("top", 0), at_key=True).column == 5
    assert document.nearest(("top", "x", 0, "y")) == ("top", 0)


def test_positions_are_mappings_in_the_order_of_the_file(write):
    document = read_document(write("b: [1, {c: 2}]\na: 3\n"))

    assert list(document.values) == [(), ("b",), ("b", 0), ("b", 1), ("b", 1, "c"), ("a",)]
    assert list(document.keys) == [("b",), ("b", 1, "c"), ("a",)]
    assert (len(document.values), len(document.keys)) == (6, 3)
    assert dict(document.keys.items()) == {("b",): (1, 1), ("b", 1, "c"): (1, 9), ("a",): (2, 1)}


@pytest.mark.parametrize("location", [("x",), ("b", 2), ("b", -1), ("b", "0"), ("a", 0), (0,), ("b", 0, "c")])
def test_what_is_not_there_has_no_position(write, location):
    document = read_document(write("b: [1, {c: 2}]\na: 3\n"))

    assert location not in document.values
    assert location not in document.keys


def test_the_whole_file_and_entries_of_lists_have_no_key(write):
    document = read_document(write("b: [1]\n"))

    assert () not in document.keys
    assert ("b", 0) not in document.keys


def test_lines_of_more_than_a_million_columns(write):
    document = read_document(write("a: [" + "x" * 1_100_000 + ", y]\n"))

    assert document.values["a", 1] == (1, 1_100_007)
