"""Internal block diagrams: the parts of a block, their ports, and what flows between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.reports.diagrams.drawing import Drawing, draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Edge, Graph, Node, NodePort, Shape
from rgss.requirements import Block, Connector, Port, PortDirection, inherited_blocks

_BORDER = "border "


def internal_block_diagrams(blocks: Sequence[Block]) -> tuple[Drawing, ...]:
    """Draw each block that has connectors.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    known = {block.id: block for block in blocks}
    return tuple(_diagram(block, known) for block in blocks if block.connectors)


def _diagram(owner: Block, blocks: Mapping[str, Block]) -> Drawing:
    names = dict.fromkeys(name for each in owner.connectors for name in (each.source, each.target))
    owners = {block.id for block in inherited_blocks(owner, blocks)}
    names |= dict.fromkeys(block.id for block in blocks.values() if block.parent in owners and _is_counted(block))
    parts = [blocks[name] for name in names if name != owner.id]
    nodes = [_part_node(part, owner, blocks) for part in parts]
    nodes += list(_border_nodes(owner, blocks))
    edges = tuple(_edge(each, owner, blocks) for each in owner.connectors)
    return draw_graph(
        Graph(nodes=tuple(nodes), edges=edges, rightwards=True, node_width=200.0),
        heading=Heading(kind="ibd", element="Block", subject=owner.name),
        name=f"internal-{owner.id}",
        title=f"Internal block diagram: {owner.name}",
        description=f"The {len(parts)} parts of {owner.id} and {len(edges)} connections; squares are ports.",
        text_alternative=" ".join(
            f"{blocks[each.source].name} to {blocks[each.target].name}: {_flow(each, blocks) or 'connected'}."
            for each in owner.connectors
        ),
    )


def _is_counted(block: Block) -> bool:
    return block.relation.value == "part"


def _part_node(part: Block, owner: Block, blocks: Mapping[str, Block]) -> Node:
    count = f" [{part.multiplicity}]" if part.multiplicity else ""
    ports = tuple(
        NodePort(id=port.id, label=port.id, right=_is_right(port, part, owner), sign=_sign(port))
        for port in _ports(part, blocks).values()
    )
    return Node(id=part.id, shape=Shape.BOX, name=f": {part.name}{count}", texts=(part.id,), ports=ports)


def _ports(block: Block, blocks: Mapping[str, Block]) -> dict[str, Port]:
    return {port.id: port for one in inherited_blocks(block, blocks) for port in one.ports}


def _is_right(port: Port, part: Block, owner: Block) -> bool:
    """The side of a port: what leaves is on the right; of what goes both ways, its connectors decide."""
    if port.direction is PortDirection.INOUT:
        return any(each.source == part.id and each.source_port == port.id for each in owner.connectors)
    return port.direction is PortDirection.OUT


def _sign(port: Port) -> str:
    return "both" if port.direction is PortDirection.INOUT else "right"


def _border_nodes(owner: Block, blocks: Mapping[str, Block]) -> Iterator[Node]:
    """A node for each port of the diagram's own frame: its label, to which the frame's square is joined."""
    for port in _ports(owner, blocks).values():
        is_source = any(each.source == owner.id and each.source_port == port.id for each in owner.connectors)
        is_target = any(each.target == owner.id and each.target_port == port.id for each in owner.connectors)
        if is_source or is_target:
            rank = "max" if is_target else "min"
            sign = "both" if port.direction is PortDirection.INOUT else "right"
            inner = NodePort(id=port.id, label="", right=not is_target, sign=sign)
            yield Node(
                id=_BORDER + port.id,
                shape=Shape.FREE,
                name="",
                texts=(f"{port.id} : {port.flow}",),
                ports=(inner,),
                rank=rank,
            )


def _edge(connector: Connector, owner: Block, blocks: Mapping[str, Block]) -> Edge:
    flow = _flow(connector, blocks)
    source, source_port = _end(connector.source, connector.source_port, owner)
    target, target_port = _end(connector.target, connector.target_port, owner)
    return Edge(
        source=source,
        target=target,
        head="",
        labels=(flow,) if flow else (),
        source_port=source_port,
        target_port=target_port,
        flows=bool(flow),
    )


def _end(name: str, port: str | None, owner: Block) -> tuple[str, str]:
    return (_BORDER + str(port) if name == owner.id else name), port or ""


def _flow(connector: Connector, blocks: Mapping[str, Block]) -> str:
    """The flow: as the connector says it, or else the port where it begins, or the one where it ends."""
    if connector.flow is not None:
        return connector.flow
    for name, port in ((connector.source, connector.source_port), (connector.target, connector.target_port)):
        ports = _ports(blocks[name], blocks)
        if port in ports:
            return ports[port].flow
    return ""
