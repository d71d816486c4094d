"""How wide texts are, held against the font itself."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.reports.diagrams.text import shortened, text_width, wrapped


@pytest.mark.parametrize("bold", [False, True])
@pytest.mark.parametrize(
    "text", ["".join(map(chr, range(32, 127))), "The gripper shall lift 0.8 kg.", "BLK-finger_joint"]
)
def test_widths_are_those_of_the_font(text, bold):
    from matplotlib import get_data_path
    from PIL import ImageFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    # As many pixels as the font has units, so that nothing is rounded; without kerning, as the table is.
    font = ImageFont.truetype(f"{get_data_path()}/fonts/ttf/{name}", 2048, layout_engine=ImageFont.Layout.BASIC)
    units = sum(font.getlength(character) for character in text)

    assert text_width(text, 1.0, bold=bold) == pytest.approx(1.02 * units / 2048, rel=2e-3)


def test_other_letters_are_not_narrower_than_they_are():
    assert text_width("漢字", 10) >= 20
    assert text_width("e\u0301", 10) == text_width("e", 10)


@given(st.text(max_size=200), st.floats(20, 300))
def test_lines_fit_and_hold_every_word(text, width):
    lines = wrapped(text, width, 10)

    assert "".join("".join(lines).split()) == "".join(text.split())
    assert all(text_width(line, 10) <= width or len(line) == 1 for line in lines)


def test_lines_break_between_words_and_long_words_where_they_may():
    assert wrapped("one two three", text_width("one two", 10), 10) == ("one two", "three")
    assert wrapped("BLK-manipulator-revolute-joint", text_width("BLK-manipulator-revo", 10), 10) == (
        "BLK-manipulator-",
        "revolute-joint",
    )
    assert wrapped("  ", 50, 10) == ()


def test_what_does_not_fit_on_one_line_is_cut():
    assert shortened("one two three", 1000, 10) == "one two three"
    cut = shortened("one two three", text_width("one two t…", 10), 10)
    assert cut == "one two t…"
