"""Tornado as SVG for the HTML report; colours come from the page's style sheet."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape

from rgss.decision.sensitivity import Tornado, TornadoBar, TornadoEnd
from rgss.invisible_characters import visible
from rgss.reports.decision.words import amount, score, variants_text

MOST_BARS = 25
"""Most inputs that are drawn; the document has all."""

_WIDTH, _ROW, _BAR, _TOP = 960.0, 26.0, 16.0, 44.0
_LEFT, _RIGHT = 330.0, 930.0


def tornado_svg(tornado: Tornado, *, most_bars: int = MOST_BARS) -> str:
    """Picture of the bars; empty if no input moves the lead, or there is none.

    Args:
        tornado: The sensitivity of a choice.
        most_bars: Most bars, of the inputs that move the lead the most.

    Returns:
        An ``svg`` element without scripts, references or style attributes.
    """
    bars = tornado.moving[:most_bars]
    leads = [end.lead for bar in bars for end in (bar.low, bar.high) if end.lead is not None]
    if not bars or not tornado.has_leads:
        return ""
    base = tornado.lead or 0.0
    least, most = min([0.0, base, *leads]), max([0.0, base, *leads])
    scale = (_RIGHT - _LEFT) / ((most - least) or 1.0)

    def across(lead: float) -> float:
        return _LEFT + (lead - least) * scale

    height = _TOP + _ROW * len(bars) + 12.0
    label = f"Tornado: lead of variant {tornado.chosen} over the range of each input; the table has the figures"
    parts = [
        f'<svg class="tornado" viewBox="0 0 {_WIDTH:g} {height:g}" role="img" aria-label="{label}">',
        _text(_LEFT, 16.0, f"lead {least:+.4f}", "start"),
        _text(_RIGHT, 16.0, f"{most:+.4f}", "end"),
        _line(across(0.0), height, "none"),
        _text(across(0.0), 32.0, "0", "middle"),
    ]
    for row, bar in enumerate(bars):
        parts += _bar(bar, _TOP + row * _ROW, base, across)
    if tornado.lead is not None:
        parts += [_line(across(base), height, "now"), _text(across(base), 32.0, score(base), "middle")]
    return "".join([*parts, "</svg>"])


def _bar(bar: TornadoBar, top: float, base: float, across: Callable[[float], float]) -> Iterator[str]:
    middle = top + _ROW / 2.0
    ends = [(bar.low, "low"), (bar.high, "high")]
    yield _text(_LEFT - 12.0, middle + 4.0, bar.id, "end")
    for end, kind in sorted(ends, key=lambda one: -_length(one[0], base)):
        if end.lead is None and end.feasible:
            continue
        missed = end.lead is None
        reach = _LEFT if end.lead is None else across(end.lead)
        left, right = min(reach, across(base)), max(reach, across(base))
        thickness = 3.0 if missed else _BAR
        wins = variants_text(end.winners) if end.winners else "nothing is feasible"
        title = f"{bar.id} at {amount(end.value, bar.unit)}: " + (
            "the choice is infeasible" if missed else f"lead {score(end.lead)}"
        )
        yield (
            f'<rect class="{"missed" if missed else kind}" x="{left:.2f}" y="{middle - thickness / 2.0:.2f}" '
            f'width="{right - left:.2f}" height="{thickness:g}"><title>{_safe(f"{title}; {wins}")}</title></rect>'
        )
    if not all(end.feasible for end, _ in ends):
        yield _text(_LEFT - 5.0, middle + 4.0, "✕", "middle")


def _length(end: TornadoEnd, base: float) -> float:
    return float("inf") if end.lead is None else abs(end.lead - base)


def _line(x: float, height: float, kind: str) -> str:
    return f'<line class="{kind}" x1="{x:.2f}" y1="{_TOP - 6.0:g}" x2="{x:.2f}" y2="{height - 6.0:g}"/>'


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.2f}" y="{y:.2f}" text-anchor="{anchor}">{_safe(text)}</text>'


def _safe(text: str) -> str:
    return escape(visible(text))
