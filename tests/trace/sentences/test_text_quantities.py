"""Numbers in sentences."""

from __future__ import annotations

import pytest

from rgss.trace.sentences.quantities import quantities_in


@pytest.mark.parametrize(
    ("sentence", "found"),
    [
        ("at least 0.8 kg.", [("0.8 kg", 0.8, "kg")]),
        ("at most 60000 USD", [("60000 USD", 60000.0, "USD")]),
        ("at most 60,000 USD", [("60,000 USD", 60000.0, "USD")]),
        ("a score of 0.9.", [("0.9", 0.9, "1")]),
        ("within 2 % of it", [("2 %", 2.0, "%")]),
        ("5 moves in 20 s, then 3", [("5", 5.0, "1"), ("20 s", 20.0, "s"), ("3", 3.0, "1")]),
        ("2 m/s^2 or 1.5e-3 N*m", [("2 m/s^2", 2.0, "m/s^2"), ("1.5e-3 N*m", 1.5e-3, "N*m")]),
        ("-5 mm", [("-5 mm", -5.0, "mm")]),
        ("10mm", [("10mm", 10.0, "mm")]),
        ("0.9 at 3 in 4 as 5 a", [("0.9", 0.9, "1"), ("3", 3.0, "1"), ("4", 4.0, "1"), ("5", 5.0, "1")]),
        ("the UR10 with KG-2 of section 4.6.2, SYS-012", []),
        ("no number", []),
    ],
)
def test_numbers_are_found_with_their_units(sentence, found):
    assert [(quantity.text, quantity.value, quantity.unit) for quantity in quantities_in(sentence)] == found
