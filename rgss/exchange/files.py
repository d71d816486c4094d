"""Files of other tools, read within a bound."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rgss.documents.refusals import MOST_PROBLEMS
from rgss.errors import DocumentError
from rgss.findings import Finding, Severity

LARGEST_FILE_BYTES = 64 * 1024 * 1024


def problem(file: str, rule: str, message: str, *, line: int = 1, column: int = 1, hint: str = "") -> Finding:
    """What makes a file of another tool unusable.

    Args:
        file: Its name.
        rule: The broken rule, without ``exchange.``.
        message: What is wrong.
        line: The line, or the row of a sheet.
        column: The column.
        hint: How to mend it.
    """
    return Finding(
        file=file,
        line=line,
        column=column,
        rule=f"exchange.{rule}",
        severity=Severity.ERROR,
        # It may show what the file holds, which must not steer a terminal.
        message="".join(each if each.isprintable() else "\ufffd" for each in " ".join(message.split())),
        hint=hint,
    )


def refusal_of(findings: Sequence[Finding]) -> DocumentError:
    """What is wrong with a file, in the order of its places; of very many only the first."""
    first = sorted(findings)[:MOST_PROBLEMS]
    if len(findings) > MOST_PROBLEMS:
        message = f"more than {MOST_PROBLEMS} problems; the first {MOST_PROBLEMS} are shown"
        first.insert(0, problem(first[0].file, "many", message, hint="mend these first"))
    return DocumentError(first)


def read_bytes(path: Path) -> bytes:
    """The content of a file.

    Raises:
        DocumentError: It is not there, cannot be read, or is too large.
    """
    try:
        if path.is_dir():
            raise DocumentError([problem(str(path), "unreadable", "is a folder, not a file")])
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "not the name of a file"
        raise DocumentError([problem(str(path), "unreadable", f"cannot be read: {reason}")]) from None
    if len(content) > LARGEST_FILE_BYTES:
        limit = LARGEST_FILE_BYTES // (1024 * 1024)
        raise DocumentError([problem(str(path), "size", f"is too large: at most {limit} MiB are read")])
    return content
