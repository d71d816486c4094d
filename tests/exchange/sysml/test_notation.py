"""Names, strings, numbers and comments of the textual notation."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.exchange.sysml.notation import body, comment, declared, documentation, name, real, string


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.0, "1.0"), (0.145, "0.145"), (1e-9, "1.0e-09"), (1e22, "1.0e22"), (-2.5, "-2.5"), (0.0, "0.0")],
)
def test_numbers(value, text):
    assert real(value) == text


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_reads_back_as_itself(value):
    assert float(real(value)) == value


def test_quotes_are_escaped():
    assert name('it\'s "so" \\ now') == "'it\\'s \"so\" \\\\ now'"
    assert string('it\'s "so"\n') == '"it\'s \\"so\\"\\n"'


def test_a_comment_cannot_be_ended_by_its_text():
    assert documentation("a */ b\n  c") == "doc /* a * / b c */"
    assert comment("m", "x*/") == "comment about 'm' /* x* / */"


def test_a_declaration_has_a_short_name_if_it_is_called_something():
    assert declared("part def", "BLK-1", "Arm") == "part def <'BLK-1'> 'Arm'"
    assert declared("part def", "BLK-1") == "part def 'BLK-1'"


def test_a_body_is_indented():
    assert body("part a", []) == ["part a;"]
    assert body("part a", ["part b;"]) == ["part a {", "    part b;", "}"]
