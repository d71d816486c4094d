"""Failures of a run, as opposed to failures of the robot: pieces or trials that could not be computed."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.documents import digest as digest_of
from rgss.errors import EvidenceError
from rgss.evidence.records.digests import is_digest
from rgss.findings import printable, shown

LONGEST_DETAIL = 500
"""Greatest length of a detail in characters."""


class RunFailureKind(str, Enum):
    """Kind of failure of a run."""

    CRASHED = "crashed"
    TIMED_OUT = "timed_out"
    OUT_OF_MEMORY = "out_of_memory"
    RAISED = "raised"
    WRONG_ANSWER = "wrong_answer"


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFailure:
    """Piece or trial that could not be computed.

    Attributes:
        key: Digest of the piece, or key of the trial.
        what: Its kind, such as ``execution`` or ``trial``.
        kind: Kind of the failure.
        detail: One line: the signal, the limit in seconds, the line of the exception; see `detail_line`.
        attempts: Number of attempts.
    """

    key: str
    what: str
    kind: RunFailureKind
    detail: str
    attempts: int


def failure_row(failure: RunFailure) -> tuple[str, str, str, str, int, str]:
    """Row of a failure, with its detail truncated to one line.

    Raises:
        EvidenceError: Its key or its number of attempts is invalid.
    """
    if not is_digest(failure.key):
        raise EvidenceError(
            f"the key of a trial or piece must be a SHA-256, got {shown(failure.key)}",
            hint="use the digest of its inputs",
        )
    if not (type(failure.attempts) is int and 0 < failure.attempts < 2**31):
        raise EvidenceError(f"the number of attempts must be from 1 to 2147483647, got {shown(failure.attempts)}")
    kind = RunFailureKind(failure.kind).value
    row = (failure.key, detail_line(failure.what), kind, detail_line(failure.detail), failure.attempts)
    return (*row, digest_of(list(row)))


def read_failure(row: tuple[object, ...]) -> RunFailure:
    """Failure from a row of `failure_row`.

    Raises:
        EvidenceError: It is not as it was made; the message names the problem.
    """
    key, what, kind, detail, attempts, seal = row
    if not (
        is_digest(key)
        and isinstance(key, str)
        and isinstance(what, str)
        and isinstance(detail, str)
        and type(attempts) is int
        and kind in {known.value for known in RunFailureKind}
    ):
        raise EvidenceError("it is not of a key, texts and a count")
    if digest_of([key, what, kind, detail, attempts]) != seal:
        raise EvidenceError("it is not the one that was put")
    return RunFailure(key=key, what=what, kind=RunFailureKind(kind), detail=detail, attempts=attempts)


def detail_line(text: str) -> str:
    """Text of a process, an engine or a file for messages: one line of bounded length, without control characters.

    Characters that are not printable, such as escapes and bidirectional controls, are replaced.
    """
    # Text far beyond the bound is not processed.
    line = printable(" ".join(text[: 20 * LONGEST_DETAIL].split()))
    return line if len(line) <= LONGEST_DETAIL else line[: LONGEST_DETAIL - 1] + "…"
