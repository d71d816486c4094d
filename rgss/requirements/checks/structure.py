"""Consistency of blocks: multiplicities of parts, ids of values and ports, and what connectors connect."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.documents import LoadedDocument
from rgss.findings import Finding
from rgss.requirements.architecture import Block, BlockRelation, inherited_blocks
from rgss.requirements.checks.inner_ids import At, repeated, unknown
from rgss.requirements.files import ArchitectureFile
from rgss.requirements.hints import Hints
from rgss.requirements.references import Declaration, ElementKind
from rgss.requirements.structure import Connector, Port, PortDirection


def check_blocks(documents: Sequence[LoadedDocument[ArchitectureFile]], hints: Hints) -> Iterator[Finding]:
    """Findings inside of blocks.

    Args:
        documents: The files of the architecture.
        hints: Suggests the id that was probably meant.
    """
    blocks = {block.id: block for loaded in documents for block in loaded.value.blocks}
    for loaded in documents:
        for index, block in enumerate(loaded.value.blocks):
            declaration = Declaration(
                id=block.id, kind=ElementKind.BLOCK, document=loaded.document, location=("blocks", index)
            )
            yield from repeated(declaration, ("values",), [value.id for value in block.values])
            yield from repeated(declaration, ("ports",), [port.id for port in block.ports])
            if block.multiplicity is not None and (block.parent is None or block.relation is BlockRelation.KIND):
                message = f"block {block.id!r} has a multiplicity, but is no part of another block"
                yield declaration.finding("multiplicity", message, ("multiplicity",), hint="only parts are counted")
            for number, connector in enumerate(block.connectors):
                yield from _check_connector(declaration, block, connector, ("connectors", number), blocks, hints)


def _check_connector(
    declaration: Declaration, block: Block, connector: Connector, at: At, blocks: Mapping[str, Block], hints: Hints
) -> Iterator[Finding]:
    if connector.source == connector.target:
        message = f"a connector of {block.id!r} connects {connector.source!r} with itself"
        yield declaration.finding("connector", message, (*at, "target"), hint="name another part")
    owners = {one.id for one in inherited_blocks(block, blocks)}
    ends = (("source", connector.source, connector.source_port), ("target", connector.target, connector.target_port))
    for key, name, port in ends:
        if name not in blocks:
            continue  # a dangling reference, which is reported as one
        end = blocks[name]
        is_part = end.relation is BlockRelation.PART and end.parent in owners
        if not is_part and name != block.id:
            message = f"{key}: {name!r} is not a part of {block.id!r}"
            hint = "state the connector at the block that has both parts"
            yield declaration.finding("connector", message, (*at, key), hint=hint)
        elif port is not None:
            ports = {each.id: each for one in inherited_blocks(end, blocks) for each in one.ports}
            yield from unknown(declaration, (*at, f"{key}_port"), port, ports, f"port of {name!r}", hints)
            if port in ports:
                yield from _check_direction(
                    declaration, ports[port], (*at, f"{key}_port"), leaves=key == "source", outer=name == block.id
                )
        elif name == block.id:
            message = f"{key}: a connector to {name!r} itself names a port of it"
            yield declaration.finding("connector", message, (*at, key), hint=f"add '{key}_port'")


def _check_direction(declaration: Declaration, port: Port, at: At, *, leaves: bool, outer: bool) -> Iterator[Finding]:
    """Directions of flows: out of a part by an out port of it, into a block by an in port of its own border."""
    wanted = PortDirection.OUT if leaves != outer else PortDirection.IN
    if port.direction not in (wanted, PortDirection.INOUT):
        message = f"{at[-1]}: port {port.id!r} has the direction {port.direction.value!r}, not {wanted.value!r}"
        yield declaration.finding("connector", message, at, hint="turn the connector, or the port, round")
