"""Tornado as SVG for the HTML report; colours come from the page's style sheet."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from html import escape

from rgss.decision.sensitivity import Tornado, TornadoBar, TornadoEnd
from rgss.invisible_characters import visible
from rgss.reports.decision.words import amount, score, variants_text

MOST_BARS = 25
"""Most inputs that are drawn; the document has all."""

_BAR, _TOP, _LABEL = 16.0, 44.0, 18.0
_APART = 44.0
"""Least distance of the middles of two numbers on the axis."""
_FEWEST_STEPS = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TornadoLayout:
    """Layout of the picture, in its units, which are about pixels.

    Attributes:
        name: Its class in the style sheet.
        width: Width of the picture.
        left: Left end of the axis.
        right: Right end of the axis.
        label_above: True if the name of an input is above its bar, False if it is to the left.
    """

    name: str
    width: float
    left: float
    right: float
    label_above: bool

    @property
    def row(self) -> float:
        """Height of the row of an input."""
        return 26.0 + (_LABEL if self.label_above else 0.0)


WIDE = TornadoLayout(name="wide", width=960.0, left=330.0, right=930.0, label_above=False)
NARROW = TornadoLayout(name="narrow", width=360.0, left=16.0, right=340.0, label_above=True)
"""For the width of a telephone, where names to the left would leave no room for the bars."""


def tornado_svgs(tornado: Tornado, *, most_bars: int = MOST_BARS) -> str:
    """The picture in its narrow and its wide layout, of which the style sheet shows one; empty as `tornado_svg`.

    Args:
        tornado: The sensitivity of a choice.
        most_bars: Most bars, of the inputs that move the lead the most.
    """
    return "".join(tornado_svg(tornado, most_bars=most_bars, layout=layout) for layout in (NARROW, WIDE))


def tornado_svg(tornado: Tornado, *, most_bars: int = MOST_BARS, layout: TornadoLayout = WIDE) -> str:
    """Picture of the bars; empty if no input moves the lead, or there is none.

    Args:
        tornado: The sensitivity of a choice.
        most_bars: Most bars, of the inputs that move the lead the most.
        layout: Its layout.

    Returns:
        An ``svg`` element without scripts, references or style attributes.
    """
    bars = tornado.moving[:most_bars]
    leads = [end.lead for bar in bars for end in (bar.low, bar.high) if end.lead is not None]
    if not bars or not tornado.has_leads:
        return ""
    base = tornado.lead or 0.0
    least, most = min([0.0, base, *leads]), max([0.0, base, *leads])
    scale = (layout.right - layout.left) / ((most - least) or 1.0)

    def across(lead: float) -> float:
        return layout.left + (lead - least) * scale

    height = _TOP + layout.row * len(bars) + 12.0
    label = f"Tornado: lead of variant {tornado.chosen} over the range of each input; the table has the figures"
    parts = [
        (
            f'<svg class="tornado {layout.name}" viewBox="0 0 {layout.width:g} {height:g}" role="img" '
            f'aria-label="{label}">'
        ),
        _text(layout.left, 16.0, "lead, greater is better", "start"),
        _line(across(0.0), height, "none"),
    ]
    for tick in _ticks(least, most):
        parts.append(_line(across(tick), _TOP, "tick"))
        # The present lead has a label of its own, which a round number must not touch.
        if tornado.lead is None or abs(across(tick) - across(base)) > _APART:
            parts.append(_text(across(tick), 32.0, f"{tick:.3g}", "middle"))
    for row, bar in enumerate(bars):
        parts += _bar(bar, _TOP + row * layout.row, base, across, layout)
    if tornado.lead is not None:
        parts += [_line(across(base), height, "now"), _text(across(base), 32.0, score(base), "middle")]
    return "".join([*parts, "</svg>"])


def _bar(
    bar: TornadoBar, top: float, base: float, across: Callable[[float], float], layout: TornadoLayout
) -> Iterator[str]:
    middle = top + layout.row - 13.0
    ends = [(bar.low, "low"), (bar.high, "high")]
    if layout.label_above:
        yield _text(layout.left, top + _LABEL - 4.0, bar.id, "start")
    else:
        yield _text(layout.left - 12.0, middle + 4.0, bar.id, "end")
    for end, kind in sorted(ends, key=lambda one: -_length(one[0], base)):
        if end.lead is None and end.feasible:
            continue
        missed = end.lead is None
        reach = layout.left if end.lead is None else across(end.lead)
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
        yield _text(layout.left - 5.0, middle + 4.0, "✕", "middle")


def _ticks(least: float, most: float) -> list[float]:
    """Round numbers from the least to the most, among them 0."""
    power = 10.0 ** math.floor(math.log10((most - least) or 1.0))
    step = next((power * part for part in (1.0, 0.5) if (most - least) / (power * part) >= _FEWEST_STEPS), 0.2 * power)
    return [place * step for place in range(math.ceil(least / step - 1e-9), math.floor(most / step + 1e-9) + 1)]


def _length(end: TornadoEnd, base: float) -> float:
    return float("inf") if end.lead is None else abs(end.lead - base)


def _line(x: float, height: float, kind: str) -> str:
    first, last = (_TOP - 10.0, _TOP - 4.0) if kind == "tick" else (_TOP - 6.0, height - 6.0)
    return f'<line class="{kind}" x1="{x:.2f}" y1="{first:g}" x2="{x:.2f}" y2="{last:g}"/>'


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.2f}" y="{y:.2f}" text-anchor="{anchor}">{_safe(text)}</text>'


def _safe(text: str) -> str:
    return escape(visible(text))
