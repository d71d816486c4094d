"""Failures of a run, as opposed to failures of the robot: pieces or trials that could not be made."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.documents import digest as digest_of
from rgss.errors import EvidenceError
from rgss.evidence.records.digests import is_digest
from rgss.findings import printable, shown

LONGEST_DETAIL = 500
"""Characters of a detail that are kept."""


class RunFailureKind(str, Enum):
    """Kind of failure of a run."""

    CRASHED = "crashed"
    TIMED_OUT = "timed_out"
    OUT_OF_MEMORY = "out_of_memory"
    RAISED = "raised"
    WRONG_ANSWER = "wrong_answer"


@dataclass(frozen=True, slots=True, kw_only=True)
class RunFailure:
    """A piece or a trial that could not be made.

    Attributes:
        key: Digest of the piece, or key of the trial.
        what: What it is, such as ``execution`` or ``trial``.
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
    """The row that keeps a failure; its detail is cut to one line.

    Raises:
        EvidenceError: Its key or its number of attempts is invalid.
    """
    if not is_digest(failure.key):
        raise EvidenceError(f"{shown(failure.key)} is not the key of a trial or piece", hint="it is a SHA-256")
    if not (type(failure.attempts) is int and 0 < failure.attempts < 2**31):
        raise EvidenceError(f"a run cannot fail after {shown(failure.attempts)} attempts")
    kind = RunFailureKind(failure.kind).value
    row = (failure.key, detail_line(failure.what), kind, detail_line(failure.detail), failure.attempts)
    return (*row, digest_of(list(row)))


def read_failure(row: tuple[object, ...]) -> RunFailure:
    """Read a row that `failure_row` made.

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
    """A text from a process, an engine or a file as messages show it: one line, of bounded length, that steers nothing.

    Characters that are not printable, such as escapes and controls of the direction of text, are replaced.

    Args:
        text: The text.
    """
    # Text far beyond the bound is not examined.
    line = printable(" ".join(text[: 20 * LONGEST_DETAIL].split()))
    return line if len(line) <= LONGEST_DETAIL else line[: LONGEST_DETAIL - 1] + "…"
