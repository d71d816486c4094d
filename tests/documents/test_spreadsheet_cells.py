"""Texts that a spreadsheet shows and never computes."""

from __future__ import annotations

import pytest

from rgss.documents.spreadsheet_cells import neutralised, printable, restored, starts_like_a_formula


@pytest.mark.parametrize(
    "text",
    [
        "=1+1",
        "+1",
        "-1",
        "@SUM(A1)",
        "\t=1",
        "\r=1",
        "\n=1",
        "  =1",
        "\u00a0=1",
        "\uff1d1",
        "\uff20A",
        '=cmd|" /C calc"!A0',
    ],
)
def test_what_might_be_a_formula_gets_an_apostrophe(text):
    assert starts_like_a_formula(text)
    assert neutralised(text) == f"'{text}"


@pytest.mark.parametrize("text", ["", " ", "SYS-001", "a = b", "'", "'tis", "1-2", "–1", "☕ = 1"])
def test_any_other_text_stays(text):
    assert not starts_like_a_formula(text)
    assert neutralised(text) == text


@pytest.mark.parametrize("text", ["=1", "'=1", "''=1", "'", "''", "'a", "a'=", " =1", "' =1", "-5 mm", "plain", ""])
def test_every_text_comes_back(text):
    assert restored(neutralised(text)) == text
    assert not starts_like_a_formula(neutralised(text))


def test_what_xml_cannot_hold_is_replaced():
    assert printable("a\x00b\x1bc\ud800d\uffffe\x85f\tg\nh") == "a\ufffdb\ufffdc\ufffdd\ufffde\x85f\tg\nh"
    assert printable("é ☕ 𝔘 🤖") == "é ☕ 𝔘 🤖"
