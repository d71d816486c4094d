"""Text of the figures of a decision: ids, quantities, limits and changes of weights."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from rgss.currencies import is_currency
from rgss.trace.views import rounded_away, value_in_words

LONGEST_IDS = 12
"""Most runs of ids that are written out."""

UNKNOWN = "–"


def ids_text(variants: Iterable[int], *, longest: int = LONGEST_IDS, counted: bool = False) -> str:
    """Ids in ascending order, runs of three and more joined: ``28–30, 64``.

    Args:
        variants: The ids.
        longest: Runs that are written out; more are three dots.
        counted: Whether the number of the other ids takes the place of the dots, as at the end of a sentence.
    """
    runs: list[list[int]] = []
    for variant in sorted(variants):
        if runs and variant == runs[-1][-1] + 1:
            runs[-1].append(variant)
        else:
            runs.append([variant])
    parts: list[list[int]] = []
    for run in runs:
        parts += [run] if len(run) > 2 else [[variant] for variant in run]
    written = ", ".join(str(part[0]) if len(part) == 1 else f"{part[0]}–{part[-1]}" for part in parts[:longest])
    if len(parts) <= longest:
        return written
    return f"{written} and {sum(map(len, parts[longest:]))} more" if counted else f"{written} …"


def basis_text(*, shown_feasible: bool) -> str:
    """Basis of the statement that a variant meets a requirement: its estimates, or verdicts on them."""
    return "verdicts" if shown_feasible else "estimates"


def variants_text(variants: Sequence[int], *, counted: bool = False) -> str:
    """``variant 28``, ``variants 28–30``, or ``nothing``; see `ids_text`."""
    if not variants:
        return "nothing"
    return f"variant{'s' if len(variants) > 1 else ''} {ids_text(variants, counted=counted)}"


def amount(value: float, unit: str) -> str:
    """Quantity with its unit; money is rounded to whole units of it."""
    return f"{value:,.0f} {unit}" if is_currency(unit) else value_in_words(value, unit)


def quantity_text(value: float, unit: str) -> str:
    """Quantity in the notation of the study's YAML file."""
    return f"{value:g}" if unit == "1" else f"{value:g} {unit}"


def moved_limit(limit: float, needed: float, unit: str) -> str:
    """New value of a limit, rounded away from the present one, so that the rounded number suffices."""
    return amount(rounded_away(limit, needed, unit), unit)


def kept_amount(end: float, unit: str, *, is_least: bool) -> str:
    """End of a range within which something holds, rounded inwards, so that it holds at the rounded number too.

    Args:
        end: The end.
        unit: Its unit.
        is_least: Whether it is the least number of the range; the greatest otherwise.
    """
    return amount(rounded_away(-math.inf if is_least else math.inf, end, unit), unit)


def kept_share(share: float, digits: int) -> str:
    """Greatest share up to which something holds, in percent, rounded down to some digits after the point."""
    scale = 10.0**digits
    return f"{math.floor(100.0 * share * scale * (1.0 + 1e-12)) / scale:.{digits}f} %"


def moves_text(before: Mapping[str, float], after: Mapping[str, float]) -> str:
    """Changes of the weights, the largest first: ``C_total 0.25 → 0.17``."""
    # Rounded, so that equal moves stay in the measures' order.
    moved = sorted(before, key=lambda measure: -round(abs(after[measure] - before[measure]), 9))
    parts = [
        f"{measure} {before[measure]:.3g} → {after[measure]:.3g}"
        for measure in moved
        if abs(after[measure] - before[measure]) >= 5e-4
    ]
    return ", ".join(parts) or "no weight moves"


def score(value: float | None) -> str:
    """A weighted value, or a difference of two, with four places."""
    return UNKNOWN if value is None else f"{value:.4f}"


def share_text(share: float) -> str:
    """Text of a share, such as 5 %."""
    return f"{100.0 * share:.3g} %"
