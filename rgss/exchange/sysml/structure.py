"""Blocks as SysML v2 part definitions and parts."""

from __future__ import annotations

from rgss.exchange.sysml.notation import body, declared, documentation, name
from rgss.requirements import Architecture, Block, BlockRelation

STRUCTURE = "Structure"
PARTS = "Part definitions"


class Parts:
    """Paths of the blocks' parts.

    A block that is one kind of its parent is not a piece of it: its definition specialises the
    parent's, and its part subsets the parent's part, beside which it stands.
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
            lines += body(f"{declared('part def', block.id, block.name)}{general}", [documentation(block.text)])
        return lines

    def parts(self) -> list[str]:
        """The parts, each within the one that it is a piece of."""
        return [line for block in self._owned.get(None, ()) for line in self._part(block)]

    def _part(self, block: Block) -> list[str]:
        general = f" :> {name(block.parent)}" if block.parent and block.relation is BlockRelation.KIND else ""
        head = f"part {name(block.id)} : {name(PARTS)}::{name(block.id)}{general}"
        return body(head, (line for child in self._owned.get(block.id, ()) for line in self._part(child)))

    def _owner(self, block: Block) -> str | None:
        while block.parent is not None and block.relation is BlockRelation.KIND:
            block = self._blocks[block.parent]
        return block.parent
