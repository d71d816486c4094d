"""Tornado as bars of characters for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.counted import counted
from rgss.decision.sensitivity import Tornado, TornadoBar, TornadoEnd
from rgss.reports.decision.sensitivity_sentences import no_rival_clause
from rgss.reports.decision.words import UNKNOWN, amount, score, variants_text
from rgss.reports.plain_text import aligned_table

PAGE_WIDTH = 80
MOST_BARS = 15
"""Most inputs that are drawn; --json has the others."""

_NARROWEST, _WIDEST = 16, 40
_LOW, _HIGH, _BASE, _ZERO, _MISSED, _TO_MISSED = "▒", "█", "│", "┊", "✕", "─"


def tornado_lines(tornado: Tornado) -> Iterator[str]:
    """The bars, their legend, and the values at which the choice changes."""
    moving = tornado.moving
    if tornado.lead is None:
        yield f"Tornado: {no_rival_clause(tornado)}."
    else:
        are = "is" if len(tornado.tied) == 1 else "are"
        tied = f" that is not tied with it ({variants_text(tornado.tied)} {are})" if tornado.tied else ""
        yield (
            f"Tornado: lead of variant {tornado.chosen} over the best other design{tied}; as it is, "
            f"{score(tornado.lead)} over variant {tornado.rival}"
        )
    drawn = moving[:MOST_BARS] if tornado.has_leads else ()
    yield from _bars(tornado, drawn)
    if len(drawn) < len(moving) and drawn:
        yield f"And {len(moving) - MOST_BARS} more that move it less (--json has them)."
    if tornado.still:
        inputs = counted(len(tornado.still), "more input" if drawn else "input")
        moves = "moves nothing within its range" if len(tornado.still) == 1 else "move nothing within their ranges"
        yield f"{inputs} {moves} (--json names them)."
    if tornado.without_range:
        names = ", ".join(tornado.without_range)
        yield f"Not moved, for a share of 0 is no range: {names}; state one in 'sensitivity'."
    yield from _flips(moving)


def _bars(tornado: Tornado, bars: tuple[TornadoBar, ...]) -> Iterator[str]:
    if not bars:
        return
    leads = [end.lead for bar in bars for end in (bar.low, bar.high) if end.lead is not None]
    base = tornado.lead or 0.0
    least, most = min([0.0, base, *leads]), max([0.0, base, *leads])
    names = max(len(bar.id) for bar in bars)
    ends = [[amount(end.value, bar.unit) for end in (bar.low, bar.high)] for bar in bars]
    numbers = [max(len("high"), *(len(pair[place]) for pair in ends)) for place in (0, 1)]
    width = max(_NARROWEST, min(_WIDEST, PAGE_WIDTH - names - sum(numbers) - 6))
    scale = _Scale(least=least, most=most, width=width)
    head = f"{least:+.4f}".ljust(width - 7) + f"{most:+.4f}".rjust(7)
    rows = [[bar.id, *pair, scale.drawn(bar, base)] for bar, pair in zip(bars, ends, strict=True)]
    yield from aligned_table(["input", "low", "high", head], rows, right=(1, 2))
    missed = f"; {_MISSED} it is infeasible" if any(not _is_kept(bar) for bar in bars) else ""
    yield f"({_LOW} low end, {_HIGH} high end, {_BASE} as it is, {_ZERO} no lead: left of it another wins{missed})"


class _Scale:
    """Scale that maps leads to columns of characters."""

    def __init__(self, *, least: float, most: float, width: int) -> None:
        self._least, self._span, self._width = least, (most - least) or 1.0, width

    def drawn(self, bar: TornadoBar, base: float) -> str:
        cells = [" "] * self._width
        cells[self._place(0.0)] = _ZERO
        middle = self._place(base)
        ends = [(bar.low, _LOW), (bar.high, _HIGH)]
        # The longer one first, so that the shorter one is seen on it.
        for end, sign in sorted(ends, key=lambda one: -self._length(one[0], middle)):
            if end.feasible and end.lead is None:
                continue
            place = self._place(end.lead) if end.lead is not None else 0
            for cell in range(min(place, middle), max(place, middle) + 1):
                cells[cell] = sign if end.lead is not None else _TO_MISSED
        if not _is_kept(bar):
            cells[0] = _MISSED
        cells[middle] = _BASE
        return "".join(cells).rstrip()

    def _length(self, end: TornadoEnd, middle: int) -> int:
        if end.lead is None:
            return 0 if end.feasible else self._width
        return abs(self._place(end.lead) - middle)

    def _place(self, lead: float) -> int:
        return round((lead - self._least) / self._span * (self._width - 1))


def _is_kept(bar: TornadoBar) -> bool:
    return bar.low.feasible and bar.high.feasible


def _flips(bars: tuple[TornadoBar, ...]) -> Iterator[str]:
    rows = []
    for bar in bars:
        for end, word in ((bar.low, "below"), (bar.high, "above")):
            if end.flip is not None:
                about = "" if bar.exact else "≈ "
                wins = variants_text(end.flip_winners) if end.flip_winners else "nothing is feasible"
                rows.append([bar.id, f"{word} {about}{amount(end.flip, bar.unit)}", wins])
    if rows:
        yield ""
        yield from aligned_table(["within its range", "changes the choice", "then wins"], rows)
    else:
        yield f"Within these ranges no input by itself changes the choice {UNKNOWN} all ends were decided anew."
