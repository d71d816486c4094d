"""Writing of small files of a project, which the reader must be able to read whole."""

from __future__ import annotations

from pathlib import Path

from rgss.documents.output_files import replaced_file, unwritable
from rgss.documents.reader import LARGEST_FILE_BYTES
from rgss.errors import DefinitionError


def write_small_source(path: Path, text: str, *, holds: str, hint: str) -> Path:
    """Write a file of the project that is read whole, atomically.

    Args:
        path: The file.
        text: Its content.
        holds: What it holds, such as "30000 records".
        hint: How to make it smaller.

    Returns:
        The file.

    Raises:
        DefinitionError: The file would exceed the size limit of the reader, or its folder cannot be written.
        StorageError: The disk is full.
    """
    content = text.encode("utf-8")
    if len(content) > LARGEST_FILE_BYTES:
        raise DefinitionError(f"{holds} take more than {LARGEST_FILE_BYTES // (1024 * 1024)} MiB", hint=hint)
    try:
        with replaced_file(path, replace_source=True) as part:
            part.write_bytes(content)
    except OSError as error:
        raise unwritable(Path(path.name), error) from error
    return path
