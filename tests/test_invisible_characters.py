"""Characters that reorder or hide text."""

from __future__ import annotations

import unicodedata

import pytest

from rgss.invisible_characters import code_point, invisible_places, visible, visible_throughout


@pytest.mark.parametrize("character", [*map(chr, range(0x202A, 0x202F)), *map(chr, range(0x2066, 0x206A))])
def test_control_of_direction_is_shown(character):
    assert visible(f"a{character}b") == f"a[{code_point(character)}]b"
    assert invisible_places(f"a{character}b") == [1]


@pytest.mark.parametrize(
    "character", ["\u200b", "\u200e", "\u200f", "\u061c", "\u2060", "\ufeff", "\u00ad", "\U000e0041"]
)
def test_what_has_no_width_is_shown(character):
    assert visible(f"a{character}") == f"a[{code_point(character)}]"


def test_every_character_of_a_direction_without_a_shape_is_known():
    """By the character database instead of a list: bidirectional classes of the explicit controls."""
    explicit = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
    controls = [chr(each) for each in range(0x110000) if unicodedata.bidirectional(chr(each)) in explicit]

    assert len(controls) == 9
    assert all(invisible_places(each) for each in controls)


@pytest.mark.parametrize(
    "text", ["", "plain", "Größe ≤ 5 µm", "می\u200cخواهم", "👩\u200d🔧", "שלום", "क्\u200dष", "a\tb\nc"]
)
def test_scripts_are_left_alone(text):
    assert visible(text) == text
    assert invisible_places(text) == []


@pytest.mark.parametrize("text", ["pass\u200dword", "\u200cx", "x\u200d"])
def test_joiners_elsewhere_are_shown(text):
    assert visible(text) != text


def test_plain_data_is_made_visible_throughout():
    assert visible_throughout({"a\u202e": ["\u2066b", 1, None, {"c": "d"}]}) == {
        "a[U+202E]": ["[U+2066]b", 1, None, {"c": "d"}]
    }
