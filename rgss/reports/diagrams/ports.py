"""Ports of nodes: rows of small squares at the left and right border, each with its label within the node."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.reports.diagrams.canvas import Canvas, Point
from rgss.reports.diagrams.graph import Node, NodePort
from rgss.reports.diagrams.style import SMALL
from rgss.reports.diagrams.text import text_width

ROW = 24.0
SQUARE = 12.0
_GAP, _PAD = 26.0, 6.0


def port_rows(node: Node) -> int:
    """Number of rows of ports."""
    right = sum(port.right for port in node.ports)
    return max(right, len(node.ports) - right)


def ports_width(node: Node) -> float:
    """Width that the labels of a node's ports need, in pixels."""
    widths = {False: 0.0, True: 0.0}
    for port in node.ports:
        widths[port.right] = max(widths[port.right], text_width(port.label, SMALL))
    sides = sum(SQUARE / 2 + _PAD + width for width in widths.values())
    return sides + (_GAP if all(widths.values()) else _PAD)


def port_places(node: Node, size: tuple[float, float], centre: Point) -> dict[str, Point]:
    """Centre of each port, on the border of its node.

    Args:
        node: The node.
        size: Its width and height.
        centre: Its centre.
    """
    top = centre[1] + size[1] / 2 - port_rows(node) * ROW
    counts = {False: 0, True: 0}
    places = {}
    for port in node.ports:
        x = centre[0] + (size[0] / 2 if port.right else -size[0] / 2)
        places[port.id] = (x, top + (counts[port.right] + 0.5) * ROW)
        counts[port.right] += 1
    return places


def table_of_ports(node: Node, size: tuple[float, float]) -> str:
    """A node for Graphviz as a table without texts whose cells are its ports.

    Args:
        node: The node.
        size: Its width and height.
    """
    sides: Mapping[bool, list[int]] = {
        right: [index for index, port in enumerate(node.ports) if port.right is right] for right in (False, True)
    }
    width, height = round(size[0]), round(size[1])
    rows = port_rows(node)
    head = height - rows * round(ROW)
    cells = [f'<TR><TD COLSPAN="2" FIXEDSIZE="TRUE" WIDTH="{width}" HEIGHT="{head}"></TD></TR>']
    for row in range(rows):
        halves = []
        for right, share in ((False, width // 2), (True, width - width // 2)):
            name = f' PORT="p{sides[right][row]}"' if row < len(sides[right]) else ""
            halves.append(f'<TD{name} FIXEDSIZE="TRUE" WIDTH="{share}" HEIGHT="{round(ROW)}"></TD>')
        cells.append(f"<TR>{''.join(halves)}</TR>")
    return f'<<TABLE BORDER="0" CELLBORDER="0" CELLPADDING="0" CELLSPACING="0">{"".join(cells)}</TABLE>>'


def port_of(node: Node, port_id: str) -> str:
    """Name of a port in the layout, with the side that edges come to; empty for none."""
    for index, port in enumerate(node.ports):
        if port.id == port_id:
            return f"p{index}:{'e' if port.right else 'w'}"
    return ""


def draw_ports(canvas: Canvas, node: Node, size: tuple[float, float], centre: Point) -> None:
    """Draw the ports of a node with their labels."""
    places = port_places(node, size, centre)
    for port in node.ports:
        x, y = places[port.id]
        _draw_square(canvas, port, (x, y))
        beside, anchor = (x - SQUARE / 2 - _PAD, "end") if port.right else (x + SQUARE / 2 + _PAD, "start")
        canvas.text(beside, y + 0.35 * SMALL, port.label, "", anchor=anchor)


def draw_frame_port(canvas: Canvas, node: Node, size: tuple[float, float], centre: Point, width: float) -> None:
    """Draw the port of a diagram's frame, joined to the node that stands for it within.

    Args:
        canvas: What is within the frame.
        node: The node, with one port at the side where edges come.
        size: Its width and height.
        centre: Its centre.
        width: Width of what is within the frame.
    """
    (port,) = node.ports
    x, y = port_places(node, size, centre)[port.id]
    border = 0.0 if port.right else width
    canvas.line([(border, y), (x, y)], "line")
    _draw_square(canvas, port, (border, y))


def _draw_square(canvas: Canvas, port: NodePort, centre: Point) -> None:
    canvas.rectangle(centre[0] - SQUARE / 2, centre[1] - SQUARE / 2, SQUARE, SQUARE, "hollow open-port")
    _draw_sign(canvas, port, centre)


def _draw_sign(canvas: Canvas, port: NodePort, centre: Point) -> None:
    x, y = centre
    if port.sign in ("right", "left", "both"):
        canvas.line([(x - 4, y), (x + 4, y)], "line thin")
    if port.sign in ("right", "both"):
        canvas.line([(x + 1, y - 3), (x + 4, y), (x + 1, y + 3)], "line thin")
    if port.sign in ("left", "both"):
        canvas.line([(x - 1, y - 3), (x - 4, y), (x - 1, y + 3)], "line thin")
