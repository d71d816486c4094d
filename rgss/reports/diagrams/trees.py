"""Tree diagrams: the containment map, and block definition diagrams."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rgss.reports.diagrams.canvas import Canvas
from rgss.reports.diagrams.drawing import Drawing
from rgss.reports.diagrams.frame import ORIGIN, Heading
from rgss.reports.diagrams.graph import Node, Shape
from rgss.reports.diagrams.nodes import Content, content_of, draw_node
from rgss.reports.diagrams.properties import compartments_of
from rgss.reports.diagrams.style import FONT, SMALL
from rgss.reports.diagrams.text import shortened, text_width
from rgss.requirements import Block, BlockRelation, RequirementSet

MOST_IN_MAP = 400
"""Most requirements that a map shows one by one; a larger map shows the number in each group."""
MOST_IN_TREE = 30
"""Most blocks of one diagram; a larger tree is drawn in several."""

_MARGIN = 14.0
_INDENT, _ROW = 28.0, 28.0
_GAP_X, _GAP_Y = 84.0, 12.0
_TEXT_WIDTH = 770.0
_NODE_WIDTH = 200.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Line:
    depth: int
    name: str
    text: str
    tint: str


def containment_map(requirements: RequirementSet) -> Drawing:
    """Tree of the requirements by containment: sets, kinds and groups, requirements."""
    lines = list(_lines(requirements))
    canvas = Canvas(ORIGIN)
    # Where the line down from each depth begins.
    trunks: dict[int, float] = {}
    width = 0.0
    for index, line in enumerate(lines):
        x, y = _MARGIN + line.depth * _INDENT, _MARGIN + index * _ROW
        middle = y + _ROW / 2
        box = text_width(line.name, FONT, bold=True) + 14
        text = shortened(line.text, _TEXT_WIDTH, SMALL)
        with canvas.group(f"{line.name} {line.text}".strip()):
            if line.depth:
                trunk = x - _INDENT + 10
                canvas.line([(trunk, trunks[line.depth - 1]), (trunk, middle), (x, middle)], "line thin")
                trunks[line.depth - 1] = middle
            canvas.rectangle(x, y + 2, box, _ROW - 4, f"shape {line.tint}".strip())
            canvas.text(x + 7, middle + 0.35 * FONT, line.name, "name")
            canvas.text(x + box + 8, middle + 0.33 * SMALL, text, "soft")
        trunks[line.depth] = y + _ROW - 2
        if index + 1 < len(lines) and lines[index + 1].depth > line.depth:
            canvas.arrow((x + 10, y + _ROW - 2), (x + 10, y + _ROW + 8), "crosshair")
            trunks[line.depth] += 8
        width = max(width, x + box + 8 + text_width(text, SMALL))
    counts = f"{len(requirements.stakeholder)} stakeholder and {len(requirements.system)} system requirements"
    return Drawing(
        name="containment",
        title="Containment map",
        description=f"{counts}, each within what contains it.",
        text_alternative="",
        heading=Heading(kind="req", element="Package", subject="Requirements"),
        inner=(width + _MARGIN, len(lines) * _ROW + 2 * _MARGIN),
        canvas=canvas,
    )


def block_definition_diagrams(blocks: Sequence[Block]) -> tuple[Drawing, ...]:
    """Block definition diagrams: parts with a filled diamond at the whole, kinds with a triangle at the general block.

    A large structure is drawn from the top down; subtrees without room are drawn in their own diagrams.
    """
    children: dict[str | None, list[Block]] = {}
    known = {block.id for block in blocks}
    for block in blocks:
        children.setdefault(block.parent if block.parent in known else None, []).append(block)
    drawings = []
    queue = list(children.get(None, ()))
    for root in queue:  # The list grows during the iteration.
        shown = _shown_below(root, children)
        drawings.append(_tree(root, children, shown))
        queue.extend(
            block for block in _members(root, children, shown) if block.id not in shown and block.id != root.id
        )
    return tuple(drawings)


def _lines(requirements: RequirementSet) -> Iterator[_Line]:
    total = len(requirements.stakeholder) + len(requirements.system)
    whole = total <= MOST_IN_MAP
    sets = (
        ("Stakeholder requirements", "need", [(item, item.kind.value) for item in requirements.stakeholder]),
        ("System requirements", "requirement", [(item, item.group.value) for item in requirements.system]),
    )
    yield _Line(depth=0, name="Requirements", text="", tint="")
    for title, tint, items in sets:
        yield _Line(depth=1, name=title, text=f"{len(items)}", tint="")
        known = {item.id for item, _ in items}
        contained: dict[str | None, list[tuple[str, str, str]]] = {}
        groups: dict[str, None] = {}
        counts: dict[str, int] = {}
        for item, group in items:
            groups.setdefault(group)
            counts[group] = counts.get(group, 0) + 1
            owner = item.parent if item.parent in known else None
            contained.setdefault(owner, []).append((item.id, item.text, group))
        for group in groups:
            yield _Line(depth=2, name=group, text=f"{counts[group]}", tint="")
            tops = [entry for entry in contained.get(None, ()) if entry[2] == group] if whole else []
            pending = [(3, entry) for entry in reversed(tops)]
            while pending:
                depth, (name, text, _) = pending.pop()
                yield _Line(depth=depth, name=name, text=text, tint=tint)
                pending.extend((depth + 1, entry) for entry in reversed(contained.get(name, ())))


def _shown_below(root: Block, children: Mapping[str | None, list[Block]]) -> frozenset[str]:
    """Blocks whose children fit the diagram: complete levels, from the top."""
    opened: set[str] = set()
    level, count = [root], 1
    while level:
        below = [child for block in level for child in children.get(block.id, ())]
        if opened and count + len(below) > MOST_IN_TREE:
            break
        opened.update(block.id for block in level if block.id in children)
        count += len(below)
        level = below
    return frozenset(opened)


def _members(root: Block, children: Mapping[str | None, list[Block]], opened: frozenset[str]) -> list[Block]:
    """The blocks of a diagram that have children, in its order."""
    found, pending = [], [root]
    while pending:
        block = pending.pop()
        if block.id in children:
            found.append(block)
        if block.id in opened:
            pending.extend(reversed(children[block.id]))
    return found


def _tree(root: Block, children: Mapping[str | None, list[Block]], opened: frozenset[str]) -> Drawing:
    order: list[tuple[int, Block]] = []
    pending = [(0, root)]
    while pending:
        depth, block = pending.pop()
        order.append((depth, block))
        if block.id in opened:
            pending.extend((depth + 1, child) for child in reversed(children[block.id]))
    nodes = {
        block.id: _block_node(block, continued=block.id in children and block.id not in opened) for _, block in order
    }
    contents = {name: content_of(node, _NODE_WIDTH) for name, node in nodes.items()}
    columns = _columns(order, contents)
    middles = _middles(order, contents, children, opened)
    canvas = Canvas(ORIGIN)
    for depth, block in order:
        if block.id in opened:
            _connect(canvas, block, children[block.id], contents, columns, depth, middles)
    for depth, block in order:
        content = contents[block.id]
        draw_node(canvas, nodes[block.id], content, (columns[depth] + content.width / 2, middles[block.id]))
    last = max(middles[block.id] + contents[block.id].height / 2 for _, block in order)
    right = max(columns[depth] + contents[block.id].width for depth, block in order)
    parts = [
        f"{block.name} is a {'part' if block.relation is BlockRelation.PART else 'kind'} of {nodes[block.parent].name}"
        f"{f', {block.multiplicity} of it' if block.multiplicity else ''}."
        for _, block in order
        if block.parent in nodes
    ]
    return Drawing(
        name=f"blocks-{root.id}",
        title=f"Block definition diagram: {root.name}",
        description=f"{root.text} {len(order)} blocks; a diamond marks the whole, a triangle the general block.",
        text_alternative=" ".join(parts),
        heading=Heading(kind="bdd", element="Block", subject=root.name),
        inner=(right + _MARGIN, last + _MARGIN),
        canvas=canvas,
    )


def _block_node(block: Block, *, continued: bool) -> Node:
    stereotype = "actor" if block.actor else "block"
    text = f"{block.id} (its parts are drawn apart)" if continued else block.id
    return Node(
        id=block.id,
        shape=Shape.BOX,
        name=block.name,
        stereotype=stereotype,
        texts=(text,),
        compartments=compartments_of(block),
    )


def _columns(order: Sequence[tuple[int, Block]], contents: Mapping[str, Content]) -> dict[int, float]:
    """The left edge of each depth."""
    widest: dict[int, float] = {}
    for depth, block in order:
        widest[depth] = max(widest.get(depth, 0.0), contents[block.id].width)
    left, columns = _MARGIN, {}
    for depth in sorted(widest):
        columns[depth] = left
        left += widest[depth] + _GAP_X
    return columns


def _middles(
    order: Sequence[tuple[int, Block]],
    contents: Mapping[str, Content],
    children: Mapping[str | None, list[Block]],
    opened: frozenset[str],
) -> dict[str, float]:
    """Vertical position of each block: a whole midway between its first and last part; siblings do not overlap."""
    rooms: dict[str, float] = {}
    for _, block in reversed(order):
        below = children[block.id] if block.id in opened else []
        inner = sum(rooms[part.id] for part in below) + _GAP_Y * max(0, len(below) - 1)
        rooms[block.id] = max(contents[block.id].height, inner)
    tops = {order[0][1].id: _MARGIN}
    for _, block in order:
        below = children[block.id] if block.id in opened else []
        inner = sum(rooms[part.id] for part in below) + _GAP_Y * max(0, len(below) - 1)
        top = tops[block.id] + (rooms[block.id] - inner) / 2
        for part in below:
            tops[part.id] = top
            top += rooms[part.id] + _GAP_Y
    middles: dict[str, float] = {}
    for _, block in reversed(order):
        top, room, half = tops[block.id], rooms[block.id], contents[block.id].height / 2
        below = children[block.id] if block.id in opened else []
        wanted = (middles[below[0].id] + middles[below[-1].id]) / 2 if below else top + room / 2
        middles[block.id] = min(max(wanted, top + half), top + room - half)
    return middles


def _connect(
    canvas: Canvas,
    whole: Block,
    below: Sequence[Block],
    contents: Mapping[str, Content],
    columns: Mapping[int, float],
    depth: int,
    middles: Mapping[str, float],
) -> None:
    both = len({block.relation for block in below}) > 1
    right = columns[depth] + contents[whole.id].width
    for relation, head, aside in ((BlockRelation.PART, "diamond", 1), (BlockRelation.KIND, "triangle", -1)):
        mine = [block for block in below if block.relation is relation]
        start = middles[whole.id] + (aside * 9 if both else 0)
        trunk = columns[depth + 1] - _GAP_X + (40 if both and relation is BlockRelation.KIND else 28)
        if not mine:
            continue
        ends = [middles[block.id] for block in mine]
        canvas.line([(right, start), (trunk, start)], "line")
        canvas.line([(trunk, min(start, *ends)), (trunk, max(start, *ends))], "line")
        for block, end in zip(mine, ends, strict=True):
            canvas.line([(trunk, end), (columns[depth + 1], end)], "line")
            canvas.text(columns[depth + 1] - 4, end - 4, block.multiplicity or "", "", anchor="end")
        canvas.arrow((right, start), (right + 10, start), head)
