"""The frame of a diagram: its border and the header with kind, element and name, as SysML has it."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.style import FONT
from rgss.reports.diagrams.text import text_width

_EDGE, _HEADER, _CORNER = 8.0, 24.0, 9.0
_PAD = 8.0

ORIGIN: Point = (_EDGE, _EDGE + _HEADER)
"""Origin on the paper of what is within a frame."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Heading:
    """Header of a frame.

    Attributes:
        kind: The kind of diagram in SysML's short form, such as ``bdd``.
        element: The kind of the element that it shows, such as ``Block``.
        subject: The name of that element.
    """

    kind: str
    element: str
    subject: str

    @property
    def width(self) -> float:
        """Width of the header, in pixels."""
        return text_width(self.kind, FONT, bold=True) + text_width(f" {self._rest}", FONT) + 2 * _PAD + _CORNER

    @property
    def _rest(self) -> str:
        return f"[{self.element}] {' '.join(self.subject.split())}"

    def size(self, width: float, height: float) -> Point:
        """Width and height of the paper about what is within the frame."""
        return self.inner_width(width) + 2 * _EDGE, height + _HEADER + 2 * _EDGE

    def inner_width(self, width: float) -> float:
        """Width within the frame about what is of a width; the header may need more."""
        return max(width, self.width + _CORNER)

    def draw(self, size: Point) -> Canvas:
        """The frame about a paper's whole size."""
        canvas = Canvas()
        canvas.rectangle(_EDGE, _EDGE, size[0] - 2 * _EDGE, size[1] - 2 * _EDGE, "shape open")
        right, bottom = _EDGE + self.width, _EDGE + _HEADER
        corners = [(_EDGE, _EDGE), (right, _EDGE), (right, bottom - _CORNER), (right - _CORNER, bottom)]
        canvas.polygon([*corners, (_EDGE, bottom)], "shape")
        canvas.text(_EDGE + _PAD, _EDGE + 17, self.kind, "name")
        beside = _EDGE + _PAD + text_width(f"{self.kind} ", FONT, bold=True)
        canvas.text(beside, _EDGE + 17, self._rest, "plain")
        return canvas
