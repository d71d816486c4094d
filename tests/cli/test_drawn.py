"""Draws of a trial in the terminal: units of their values, and the quantity that a factor multiplies."""

from __future__ import annotations

from rgss.cli.drawn import print_drawn
from rgss.trials import DrawnValue


def test_a_factor_is_shown_as_what_it_multiplies(capsys):
    print_drawn(
        "full_cup",
        [
            DrawnValue(name="workpiece.mass_factor", unit="kg", nominal=0.6, drawn=0.51542),
            DrawnValue(name="workpiece.friction", unit="1", nominal=1.0, drawn=1.092),
            DrawnValue(name="perception.x", unit="m", nominal=0.0, drawn=0.002154),
        ],
    )
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]

    assert rows[0] == ["Case", "of", "the", "workload:", "full_cup"]
    assert rows[3:] == [
        ["workpiece.mass", "(by", "its", "factor)", "kg", "0.6", "0.5154"],
        ["workpiece.friction", "–", "1", "1.092"],
        ["perception.x", "mm", "0", "2.154"],
    ]
