"""SVG writer: shapes, lines and escaped texts, with every coordinate in a fixed format."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from xml.sax.saxutils import escape, quoteattr

from rgss.documents import printable
from rgss.reports.diagrams.style import LINE, STYLE

Point = tuple[float, float]
"""Point on the canvas: pixels to the right, pixels down."""

_ARROW, _SPREAD = 9.0, 0.42


class Canvas:
    """Parts of one drawing; x grows to the right, y downwards, both in pixels."""

    def __init__(self, origin: Point = (0.0, 0.0)) -> None:
        """Begin without parts.

        Args:
            origin: Where the parts' own origin is on the paper.
        """
        self._parts: list[str] = []
        self._origin = origin

    def rectangle(self, x: float, y: float, width: float, height: float, style: str, *, rounding: float = 0) -> None:
        """Draw a rectangle from its upper left corner."""
        corner = f' rx="{_number(rounding)}"' if rounding else ""
        x, y = self._placed((x, y))
        place = f'x="{_number(x)}" y="{_number(y)}" width="{_number(width)}" height="{_number(height)}"'
        self._parts.append(f'<rect class="{style}" {place}{corner}/>')

    def ellipse(self, x: float, y: float, width: float, height: float, style: str) -> None:
        """Draw an ellipse about its centre."""
        x, y = self._placed((x, y))
        radii = f'rx="{_number(width / 2)}" ry="{_number(height / 2)}"'
        self._parts.append(f'<ellipse class="{style}" cx="{_number(x)}" cy="{_number(y)}" {radii}/>')

    def line(self, points: Sequence[Point], style: str) -> None:
        """Draw straight lines from point to point."""
        self._path("M" + " L".join(f"{_number(x)} {_number(y)}" for x, y in map(self._placed, points)), style)

    def curve(self, points: Sequence[Point], style: str) -> None:
        """Draw cubic Bézier curves: a start, then for each curve two control points and an end."""
        start, *rest = (f"{_number(x)} {_number(y)}" for x, y in map(self._placed, points))
        curves = " ".join(f"C{' '.join(rest[index : index + 3])}" for index in range(0, len(rest), 3))
        self._path(f"M{start} {curves}", style)

    def polygon(self, points: Iterable[Point], style: str) -> None:
        """Draw a closed figure."""
        places = " ".join(f"{_number(x)},{_number(y)}" for x, y in map(self._placed, points))
        self._parts.append(f'<polygon class="{style}" points="{places}"/>')

    def text(self, x: float, y: float, text: str, style: str, *, anchor: str = "start") -> None:
        """Write one line with its baseline at y; an empty text is not written."""
        if not text:
            return
        x, y = self._placed((x, y))
        where = f'x="{_number(x)}" y="{_number(y)}"' + ("" if anchor == "start" else f' text-anchor="{anchor}"')
        classes = f' class="{style}"' if style else ""
        self._parts.append(f"<text{classes} {where}>{escape(printable(text))}</text>")

    def lines(self, x: float, y: float, lines: Sequence[str], size: float, style: str, *, anchor: str) -> float:
        """Write lines below each other from their upper edge on; returns their lower edge."""
        for line in lines:
            self.text(x, y + 0.95 * size, line, style, anchor=anchor)
            y += LINE * size
        return y

    def arrow(self, tip: Point, behind: Point, head: str) -> None:
        """Draw the head of an arrow.

        Args:
            tip: Its tip.
            behind: A point on the line behind the tip.
            head: ``open``, ``filled``, ``triangle``, ``diamond``, ``crosshair`` or empty for none.
        """
        angle = math.atan2(tip[1] - behind[1], tip[0] - behind[0])

        def back(distance: float, turn: float) -> Point:
            return tip[0] - distance * math.cos(angle + turn), tip[1] - distance * math.sin(angle + turn)

        left, right = back(_ARROW, _SPREAD), back(_ARROW, -_SPREAD)
        if head == "open":
            self.line([left, tip, right], "line")
        elif head == "filled":
            self.polygon([tip, left, right], "solid")
        elif head == "triangle":
            self.polygon([tip, back(1.4 * _ARROW, _SPREAD), back(1.4 * _ARROW, -_SPREAD)], "hollow")
        elif head == "diamond":
            self.polygon([tip, left, back(2 * _ARROW * math.cos(_SPREAD), 0), right], "solid")

        elif head == "crosshair":
            x, y = back(_ARROW / 2, 0)
            self.ellipse(x, y, _ARROW, _ARROW, "hollow")
            self.line([(x - _ARROW / 2, y), (x + _ARROW / 2, y)], "line thin")
            self.line([(x, y - _ARROW / 2), (x, y + _ARROW / 2)], "line thin")

    @contextmanager
    def group(self, title: str) -> Iterator[None]:
        """Group the shapes of the block under a title, which is shown as a tooltip."""
        self._parts.append(f"<g><title>{escape(printable(title))}</title>")
        yield
        self._parts.append("</g>")

    def document(
        self, *, name: str, title: str, description: str, size: Point, with_style: bool, behind: Canvas
    ) -> str:
        """The drawing as one ``svg`` element.

        Args:
            name: A name that is unique on the page; letters, digits and hyphens.
            title: Its title.
            description: Its text alternative.
            size: Its width and height.
            with_style: True to include the style sheet, as a file needs it.
            behind: What is drawn before the parts, such as a frame.
        """
        width, height = size
        extent = f'width="{_number(width)}" height="{_number(height)}" viewBox="0 0 {_number(width)} {_number(height)}"'
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="rgss-diagram" role="img" {extent} '
            f"aria-labelledby={quoteattr(f'{name}-title {name}-description')}>"
            f"<title id={quoteattr(f'{name}-title')}>{escape(printable(title))}</title>"
            f"<desc id={quoteattr(f'{name}-description')}>{escape(printable(description))}</desc>"
        )
        style = f"<style>{escape(STYLE)}</style>" if with_style else ""
        paper = f'<rect class="paper" width="{_number(width)}" height="{_number(height)}"/>'
        return "\n".join([head + style, paper, *behind._parts, *self._parts, "</svg>"]) + "\n"

    def _placed(self, point: Point) -> Point:
        return point[0] + self._origin[0], point[1] + self._origin[1]

    def _path(self, course: str, style: str) -> None:
        self._parts.append(f'<path class="{style}" d="{course}"/>')


def _number(value: float) -> str:
    """Coordinate with one decimal, none if it is whole; never a negative zero."""
    text = f"{value:.1f}"
    return "0" if text == "-0.0" else text.removesuffix(".0")
