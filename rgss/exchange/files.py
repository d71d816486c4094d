"""Reading of files of other tools, with a bound of their size."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rgss.documents import MOST_PROBLEMS
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity

LARGEST_FILE_BYTES = 64 * 1024 * 1024
LARGEST_REQIF_BYTES = 128 * 1024 * 1024
"""Bytes: thirty thousand requirements of 4.3 KiB each; the reader needs some 13 bytes of memory for each byte."""


def problem(
    file: str,
    rule: str,
    message: str,
    *,
    line: int = 1,
    column: int = 1,
    hint: str = "",
    severity: Severity = Severity.ERROR,
) -> Finding:
    """Finding in a file of another tool.

    Args:
        file: Its name.
        rule: The broken rule, without ``exchange.``.
        message: The problem.
        line: The line, or the row of a sheet.
        column: The column.
        hint: How to resolve it.
        severity: An error makes the file unusable.
    """
    return Finding(
        file=file,
        line=line,
        column=column,
        rule=f"exchange.{rule}",
        severity=severity,
        # It may quote content of the file, whose control characters are escaped.
        message="".join(each if each.isprintable() else "\ufffd" for each in " ".join(message.split())),
        hint=hint,
    )


def refusal_of(findings: Sequence[Finding]) -> DocumentError:
    """Error with the findings of a file in the order of their positions, limited in number."""
    first = sorted(findings)[:MOST_PROBLEMS]
    if len(findings) > MOST_PROBLEMS:
        message = f"more than {MOST_PROBLEMS} problems; the first {MOST_PROBLEMS} are shown"
        first.insert(0, problem(first[0].file, "many", message, hint="correct these first"))
    return DocumentError(first)


def read_bytes(path: Path, *, limit: int = LARGEST_FILE_BYTES) -> bytes:
    """The content of a file.

    Args:
        path: The file.
        limit: The greatest size in bytes.

    Raises:
        DocumentError: It does not exist, cannot be read, or is too large.
    """
    try:
        if path.is_dir():
            raise DocumentError([problem(str(path), "unreadable", "is a folder, not a file")])
        with path.open("rb") as file:
            content = file.read(limit + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not the name of a file"
        raise DocumentError([problem(str(path), "unreadable", f"cannot be read: {reason}")]) from None
    if len(content) > limit:
        message = f"is too large: at most {limit // (1024 * 1024)} MiB are read"
        raise DocumentError([problem(str(path), "size", message)])
    return content
