"""Columns that are wider than the terminal stand in parts, or their cells go over several lines."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.cli.terminal.column_groups import GAP, column_groups, columns_with_room

WORDS = st.lists(st.text("abc0", min_size=1, max_size=9), max_size=4).map(" ".join)
TABLES = st.integers(1, 9).flatmap(
    lambda columns: st.lists(st.lists(WORDS, min_size=columns, max_size=columns), min_size=1, max_size=6)
)


def total(widths):
    return sum(widths) + GAP * (len(widths) - 1)


def longest_words(cells, part):
    return [max((len(word) for row in cells for word in row[column].split()), default=0) for column in part]


@given(cells=TABLES, width=st.integers(40, 100))
def test_every_column_is_shown_once_and_every_part_fits(cells, width):
    parts = column_groups(cells, width)
    shown = [column for part, _ in parts for column in part]
    first = 0 if len(cells[0]) > 1 else None
    assert [column for column in shown if column != first] == [one for one in range(len(cells[0])) if one != first]
    for part, widths in parts:
        assert first is None or part[0] == first
        assert len(part) == len(widths)
        assert total(widths) <= width


@given(cells=TABLES, width=st.integers(60, 100))
def test_no_word_is_broken(cells, width):
    """Words of nine letters in at most two columns always have room."""
    for part, widths in column_groups(cells, width):
        assert all(given >= least for given, least in zip(widths, longest_words(cells, part), strict=True))


@given(cells=TABLES)
def test_a_table_that_fits_stays_as_it_is(cells):
    natural = tuple(max(len(row[column]) for row in cells) for column in range(len(cells[0])))
    assert column_groups(cells, total(natural)) == ((tuple(range(len(natural))), natural),)


@pytest.mark.parametrize(
    ("cells", "parts"),
    [
        # Thirty rows of long texts: two lines each are more than a second part.
        ([["id", *["a long text here"] * 4]] * 30, [(0, 1, 2), (0, 3, 4)]),
        # One long text in one row: it goes over lines.
        ([["id", "text", "mark"], ["a", "word " * 12, "x"], *[["b", "word", "x"]] * 30], [(0, 1, 2)]),
    ],
)
def test_the_way_with_the_fewest_lines_is_taken(cells, parts):
    assert [part for part, _ in column_groups(cells, 44)] == parts


def test_a_word_that_is_wider_than_the_terminal_is_broken():
    ((part, widths),) = column_groups([["digest"], ["x" * 64]], 40)
    assert (part, widths) == ((0,), (40,))


@pytest.mark.parametrize(
    ("width", "kept"),
    [(80, (0, 1, 2)), (20, (0, 1)), (19, (0, 1)), (18, (0,)), (5, (0,))],
)
def test_a_narrow_terminal_omits_spare_columns_the_last_first(width, kept):
    cells = [["t_p", "total planning", "moe"], ["S", "success", "supplementary"]]
    # A column of 14 characters has room in 9 and a part, beside 3 and the gap.
    assert columns_with_room(cells, 3 + 2 + 9, spare=(1, 2)) == (0, 1)
    assert columns_with_room(cells, 3 + 2 + 8, spare=(1, 2)) == (0,)
    assert columns_with_room(cells, 80, spare=()) == (0, 1, 2)
    assert columns_with_room([[one[0] + 5 * "x", *one[1:]] for one in cells], width, spare=(1, 2)) == kept
