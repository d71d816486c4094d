"""Blocks as SysML v2 part definitions and parts."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.exchange.sysml.notation import body, declared, documentation, name, real
from rgss.quantities import parse_quantity
from rgss.requirements import Architecture, Block, BlockRelation

STRUCTURE = "Structure"
PARTS = "Part definitions"


class Parts:
    """Paths of the blocks' parts.

    A block that is a kind of its parent is not a part of it: its definition specialises the
    parent's, and its part subsets the parent's part, as a sibling.
    """

    def __init__(self, architecture: Architecture) -> None:
        """Index the position of every block."""
        self._blocks = {block.id: block for block in architecture.blocks}
        self._owned: dict[str | None, list[Block]] = {}
        for block in architecture.blocks:
            self._owned.setdefault(self._owner(block), []).append(block)

    def path(self, block_id: str) -> str:
        """The feature chain to the part of a block, from outside of the package of the structure."""
        chain: list[str] = []
        step: str | None = block_id
        while step is not None:
            chain.append(name(step))
            step = self._owner(self._blocks[step])
        return f"{name(STRUCTURE)}::{'.'.join(reversed(chain))}"

    def definitions(self) -> list[str]:
        """A part definition for each block."""
        lines: list[str] = []
        for block in self._blocks.values():
            general = f" :> {name(block.parent)}" if block.parent and block.relation is BlockRelation.KIND else ""
            inner = [documentation(block.text), *_values(block), *_ports(block)]
            lines += body(f"{declared('part def', block.id, block.name)}{general}", inner)
        return lines

    def parts(self) -> list[str]:
        """The parts, each nested in its whole."""
        return [line for block in self._owned.get(None, ()) for line in self._part(block)]

    def _part(self, block: Block) -> list[str]:
        general = f" :> {name(block.parent)}" if block.parent and block.relation is BlockRelation.KIND else ""
        count = f"[{block.multiplicity}]" if block.multiplicity else ""
        head = f"part {name(block.id)} : {name(PARTS)}::{name(block.id)}{count}{general}"
        inner = [line for child in self._owned.get(block.id, ()) for line in self._part(child)]
        return body(head, [*inner, *_connections(block)])

    def _owner(self, block: Block) -> str | None:
        while block.parent is not None and block.relation is BlockRelation.KIND:
            block = self._blocks[block.parent]
        return block.parent


def _values(block: Block) -> Iterator[str]:
    """The values as attributes, each in its own unit."""
    for value in block.values:
        text = " ".join(part for part in (value.text or "", _unit(value.unit), _bound(value.symbol)) if part)
        fixed = "" if value.value is None else f" = {real(parse_quantity(value.value, value.unit))}"
        yield from body(f"attribute {name(value.id)} : Real{fixed}", [documentation(text)])


def _unit(unit: str) -> str:
    return "A pure number." if unit == "1" else f"In {unit}."


def _bound(symbol: str | None) -> str:
    return "" if symbol is None else f"The symbol {symbol} of the measures."


def _ports(block: Block) -> Iterator[str]:
    for port in block.ports:
        yield from body(f"port {name(port.id)}", [f"{port.direction.value} item {name(port.flow)};"])


def _connections(block: Block) -> Iterator[str]:
    """The connectors between the parts; an interface where both ends are ports."""
    for connector in block.connectors:
        ends = [
            _end(block, connector.source, connector.source_port),
            _end(block, connector.target, connector.target_port),
        ]
        keyword = "interface" if connector.source_port and connector.target_port else "connection"
        text = [documentation(connector.flow)] if connector.flow else []
        yield from body(f"{keyword} connect {ends[0]} to {ends[1]}", text)


def _end(owner: Block, part: str, port: str | None) -> str:
    """A part's port from within the owner, whose own ports are its features."""
    steps = [] if part == owner.id else [name(part)]
    return ".".join([*steps, *([name(port)] if port else [])])
