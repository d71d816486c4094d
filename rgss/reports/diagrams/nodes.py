"""Sizes and drawing of the nodes of a diagram."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.graph import Node, Shape
from rgss.reports.diagrams.ports import ROW, draw_ports, port_rows, ports_width
from rgss.reports.diagrams.style import FONT, LINE, SMALL
from rgss.reports.diagrams.text import text_width, wrapped

_PAD_X, _PAD_Y = 10.0, 7.0
_BETWEEN = 5.0
_DOT, _BAR = 16.0, (70.0, 6.0)
_AWAY = 3.0
_FIGURE = (26.0, 44.0)
_SMALL_SHAPES = frozenset({Shape.INITIAL, Shape.FINAL, Shape.BAR})
"""Shapes without room for a text."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Content:
    """Lines of a node, with the size that they need.

    Attributes:
        stereotype: Lines of the stereotype.
        name: Lines of the name.
        texts: Lines of each further text or compartment.
        titles: The title of each of these; empty for none.
        width: Width of the node, in pixels.
        height: Height of the node, in pixels.
        beside: Lines beside the node, which has no room for them.
        rightwards: Edges come from the left and leave to the right; otherwise from above and downwards.
        stub: Distance of the symbol of a small shape from the border where edges arrive and leave.
    """

    stereotype: tuple[str, ...]
    name: tuple[str, ...]
    texts: tuple[tuple[str, ...], ...]
    titles: tuple[str, ...] = ()
    width: float
    height: float
    beside: tuple[str, ...] = ()
    rightwards: bool = False
    stub: float = 0.0


def content_of(node: Node, line_width: float, *, rightwards: bool = False) -> Content:
    """Wrap the texts of a node, and measure it.

    Args:
        node: The node.
        line_width: The greatest width of a line, in pixels.
        rightwards: Whether the edges of its diagram lead to the right.
    """
    if node.shape in _SMALL_SHAPES:
        return _small_content(node, line_width, rightwards=rightwards)
    stereotype = (f"«{node.stereotype}»",) if node.stereotype else ()
    name = wrapped(node.name, line_width, FONT, bold=True)
    texts = tuple(wrapped(text, line_width, SMALL) for text in node.texts)
    texts += tuple(
        tuple(part for line in each.lines for part in wrapped(line, line_width, SMALL)) for each in node.compartments
    )
    titles = ("",) * len(node.texts) + tuple(each.title for each in node.compartments)
    widths = [text_width(line, SMALL) for line in stereotype]
    widths += [text_width(line, FONT, bold=True) for line in name]
    widths += [text_width(line, SMALL) for lines in texts for line in lines]
    inner = max(widths, default=0.0)
    height = LINE * (SMALL * len(stereotype) + FONT * len(name))
    height += sum(LINE * SMALL * len(lines) + 2 * _BETWEEN for lines in texts)
    height += LINE * SMALL * sum(map(bool, titles))
    width, height = _outer(node.shape, inner, height)
    if node.ports:
        # Whole pixels, as the layout counts them.
        width, height = float(ceil(max(width, ports_width(node)))), float(ceil(height + port_rows(node) * ROW))
    return Content(stereotype=stereotype, name=name, texts=texts, titles=titles, width=width, height=height)


def draw_node(canvas: Canvas, node: Node, content: Content, centre: Point) -> None:
    """Draw a node about its centre."""
    x, y = centre
    width, height = content.width, content.height
    left, top = x - width / 2, y - height / 2
    style = f"shape {node.tint}".strip()
    texts = [*content.stereotype, " ".join(content.name), *map(" ".join, (*content.texts, content.beside))]
    with canvas.group(" ".join(part for part in texts if part) or node.shape.value):
        if node.shape is Shape.BOX:
            canvas.rectangle(left, top, width, height, style)
        elif node.shape is Shape.ROUND:
            canvas.rectangle(left, top, width, height, style, rounding=10)
        elif node.shape is Shape.ELLIPSE:
            canvas.ellipse(x, y, width, height, style)
        elif node.shape is Shape.DIAMOND:
            canvas.polygon([(x, top), (left + width, y), (x, top + height), (left, y)], style)
        elif node.shape is Shape.FREE:
            pass
        elif node.shape in _SMALL_SHAPES:
            _draw_small(canvas, node.shape, content, centre)
        else:
            _draw_figure(canvas, x, top)
            top += _FIGURE[1]
            height -= _FIGURE[1]
        _write(canvas, content, x, left, top, height - port_rows(node) * ROW, node.shape)
    if node.ports and node.shape is not Shape.FREE:
        draw_ports(canvas, node, (width, content.height), centre)


def _small_content(node: Node, line_width: float, *, rightwards: bool) -> Content:
    """A small shape with its text on a side where no edge comes or goes.

    It is above an initial node, below a final one, and right of a bar or, where edges lead to the
    right, below it. The opposite side has the same room where edges would else miss the symbol's middle.
    """
    beside = tuple(line for text in (node.name, *node.texts) for line in wrapped(text, line_width, SMALL))
    text = max((text_width(line, SMALL) for line in beside), default=0.0)
    room = LINE * SMALL * len(beside) + _AWAY if beside else 0.0
    if node.shape is Shape.BAR and rightwards:
        width, height = max(_BAR[1], text), _BAR[0] + 2 * room
        stub = (width - _BAR[1]) / 2
    elif node.shape is Shape.BAR:
        width, height = _BAR[0] + (2 * (text + 6) if beside else 0), max(_BAR[1], LINE * SMALL * len(beside))
        stub = (height - _BAR[1]) / 2
    else:
        width, height = max(_DOT, text), _DOT + (2 * room if rightwards else room)
        stub = (width - _DOT) / 2 if rightwards else 0.0
    return Content(
        stereotype=(), name=(), texts=(), width=width, height=height, beside=beside, rightwards=rightwards, stub=stub
    )


def _draw_small(canvas: Canvas, shape: Shape, content: Content, centre: Point) -> None:
    x, y = centre
    top, bottom = y - content.height / 2, y + content.height / 2
    if shape is Shape.BAR and content.rightwards:
        canvas.rectangle(x - _BAR[1] / 2, y - _BAR[0] / 2, _BAR[1], _BAR[0], "solid")
        canvas.lines(x, y + _BAR[0] / 2 + _AWAY, content.beside, SMALL, "", anchor="middle")
    elif shape is Shape.BAR:
        canvas.rectangle(x - _BAR[0] / 2, y - _BAR[1] / 2, *_BAR, "solid")
        canvas.lines(x + _BAR[0] / 2 + 6, top, content.beside, SMALL, "", anchor="start")
    elif shape is Shape.INITIAL:
        canvas.lines(x, top, content.beside, SMALL, "", anchor="middle")
        middle = y if content.rightwards else bottom - _DOT / 2
        canvas.ellipse(x, middle, _DOT, _DOT, "solid")
    else:
        middle = y if content.rightwards else top + _DOT / 2
        canvas.ellipse(x, middle, _DOT, _DOT, "hollow")
        canvas.ellipse(x, middle, _DOT * 0.55, _DOT * 0.55, "solid")
        canvas.lines(x, middle + _DOT / 2 + _AWAY, content.beside, SMALL, "", anchor="middle")


def _outer(shape: Shape, inner: float, height: float) -> tuple[float, float]:
    if shape is Shape.ELLIPSE:
        # The rectangle of the text touches the ellipse at its corners.
        return 1.42 * inner + _PAD_X, 1.42 * height + _PAD_Y
    if shape is Shape.DIAMOND:
        return (2 * inner + _PAD_X, 2 * height + _PAD_Y) if inner else (24.0, 24.0)
    if shape is Shape.ACTOR:
        return max(inner, _FIGURE[0]) + 4, height + _FIGURE[1] + 2
    return inner + 2 * _PAD_X, height + 2 * _PAD_Y


def _write(canvas: Canvas, content: Content, x: float, left: float, top: float, height: float, shape: Shape) -> None:
    text = LINE * (SMALL * len(content.stereotype) + FONT * len(content.name))
    text += sum(LINE * SMALL * (len(lines) + bool(title)) + 2 * _BETWEEN for title, lines in _titled(content))
    y = top + (height - text) / 2
    y = canvas.lines(x, y, content.stereotype, SMALL, "soft", anchor="middle")
    y = canvas.lines(x, y, content.name, FONT, "name", anchor="middle")
    for title, lines in _titled(content):
        if shape is Shape.BOX and lines:
            canvas.line([(left, y + _BETWEEN / 2), (left + content.width, y + _BETWEEN / 2)], "line thin")
        inset, anchor = (left + _PAD_X, "start") if shape is Shape.BOX else (x, "middle")
        y = canvas.lines(x, y + _BETWEEN, [title] if title else [], SMALL, "soft italic", anchor="middle")
        y = canvas.lines(inset, y, lines, SMALL, "", anchor=anchor) + _BETWEEN


def _titled(content: Content) -> list[tuple[str, tuple[str, ...]]]:
    titles = content.titles or ("",) * len(content.texts)
    return list(zip(titles, content.texts, strict=True))


def _draw_figure(canvas: Canvas, x: float, top: float) -> None:
    """A stick figure."""
    canvas.ellipse(x, top + 7, 12, 12, "shape")
    canvas.line([(x, top + 13), (x, top + 28)], "line")
    canvas.line([(x - 12, top + 18), (x + 12, top + 18)], "line")
    canvas.line([(x - 10, top + 42), (x, top + 28), (x + 10, top + 42)], "line")
