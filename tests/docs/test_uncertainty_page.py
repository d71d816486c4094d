"""The table of docs/uncertainty.md as the registry has it."""

from __future__ import annotations

from pathlib import Path

from rgss.scenes.uncertainty import QUANTITIES, Application

PAGE = Path(__file__).parents[2] / "docs" / "uncertainty.md"
DRAWS = {Application.REPLACE: "replaces", Application.ADD: "is added", Application.SCALE: "multiplies"}


def test_every_quantity_is_in_the_table_as_it_is():
    rows = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| `")]

    assert rows == [
        f"| `{one.name}` | {'–' if one.unit == '1' else one.unit} | {DRAWS[one.application]} | {one.enters.value} "
        f"| {one.meaning} |"
        for one in QUANTITIES.values()
    ]
