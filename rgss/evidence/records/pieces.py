"""Stored pieces of trials: plans, timings, executions, benches."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.documents import digest as digest_of
from rgss.errors import EvidenceError
from rgss.evidence.records.digests import is_digest, text_digest
from rgss.evidence.records.packing import pack, unpack
from rgss.findings import shown


class PieceKind(str, Enum):
    """Kinds of pieces that trials share."""

    PLAN = "plan"
    TIMING = "timing"
    EXECUTION = "execution"
    BENCH = "bench"


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """Piece shared by trials.

    Attributes:
        digest: SHA-256 of exactly its inputs, its key.
        kind: Its kind.
        text: Its content as JSON.
    """

    digest: str
    kind: PieceKind
    text: str


def piece_row(piece: Piece) -> tuple[str, str, str, str, bytes]:
    """Row of a piece: digest, kind, digest of the content, seal, packed content.

    Raises:
        EvidenceError: Its digest is malformed, or its text is too long.
    """
    if not is_digest(piece.digest):
        raise EvidenceError(
            f"the digest of a piece must be a SHA-256, got {shown(piece.digest)}", hint="use the SHA-256 of its inputs"
        )
    kind, content = PieceKind(piece.kind).value, text_digest(piece.text)
    return (piece.digest, kind, content, _seal(piece.digest, kind, content), pack(piece.text, "piece"))


def read_piece(row: tuple[object, ...]) -> Piece:
    """Piece from a row of `piece_row`.

    Raises:
        EvidenceError: The row is damaged; the message names the problem.
    """
    name, kind, content_digest, seal, content = row
    if not (is_digest(name) and isinstance(name, str)):
        raise EvidenceError("its digest is none")
    if kind not in {known.value for known in PieceKind}:
        raise EvidenceError(f"unknown kind {shown(kind)}")
    text = unpack(content, "content")
    if text_digest(text) != content_digest:
        raise EvidenceError("its content is not the one that was put")
    if _seal(name, str(kind), str(content_digest)) != seal:
        raise EvidenceError("its content belongs to another piece")
    return Piece(digest=name, kind=PieceKind(kind), text=text)


def _seal(name: str, kind: str, content: str) -> str:
    """Seal of a row: a digest that binds its columns to each other."""
    return digest_of([name, kind, content])
