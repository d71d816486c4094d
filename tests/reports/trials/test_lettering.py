"""What pictures say in words."""

from __future__ import annotations

from dataclasses import replace

from rgss.reports.trials.lettering import font, headline, words


def test_names_become_words():
    assert words("move_to_grasp_departure") == "move to grasp departure"


def test_headline_of_a_success(succeeded):
    assert headline(succeeded) == "Variant 7, seed 3: done in 12.3 s, of which 4.3 s are planning"


def test_headline_of_a_success_of_unknown_time(succeeded):
    assert headline(replace(succeeded, metrics={})) == "Variant 7, seed 3: done"


def test_headline_of_a_failure(failed):
    assert headline(failed) == "Variant 7, seed 3: failed at lift, object dropped"


def test_the_typeface_has_the_letters_that_are_used():
    for bold in (False, True):
        face = font(20, bold=bold)
        unknown = bytes(face.getmask("\uffff"))
        assert all(bytes(face.getmask(letter)) != unknown for letter in "Aa09.:/,°")
