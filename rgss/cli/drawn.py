"""Draws of a trial for display: nominal value and drawn value of each quantity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.trials import DrawnValue

_FACTOR = "_factor"
_SHOWN_AS = {"m": ("mm", 1e3), "rad": ("deg", 57.29577951308232), "s": ("ms", 1e3)}


def drawn_as_json(workload: str, drawn: Sequence[DrawnValue]) -> dict[str, Any]:
    """The draws and the case of the workload, for a JSON document.

    Args:
        workload: Id of the case; empty where there is none.
        drawn: The draws.
    """
    return {
        "workload": workload or None,
        "draws": [
            {"quantity": one.name, "unit": one.unit, "nominal": one.nominal, "drawn": one.drawn} for one in drawn
        ],
    }


def print_drawn(workload: str, drawn: Sequence[DrawnValue]) -> None:
    """Print the case and a line for each draw; nothing where nothing was drawn.

    Args:
        workload: Id of the case; empty where there is none.
        drawn: The draws.
    """
    from rgss.cli.output import number, print_table

    if workload:
        print(f"Case of the workload: {workload}")
    if not drawn:
        return
    rows = []
    for one in drawn:
        unit, factor = _SHOWN_AS.get(one.unit, (one.unit, 1.0))
        shown = unit if unit != "1" else "–"
        rows.append([_acted_on(one), shown, number(factor * one.nominal, 4), number(factor * one.drawn, 4)])
    print_table(["uncertain quantity", "unit", "nominal", "drawn"], rows, right=(2, 3))


def _acted_on(one: DrawnValue) -> str:
    """Name of a draw; of a factor, whose values are those of the quantity that it multiplies, with that quantity."""
    if not one.name.endswith(_FACTOR) or one.unit == "1":
        return one.name
    return f"{one.name.removesuffix(_FACTOR)} (by its factor)"
