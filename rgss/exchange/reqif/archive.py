"""ReqIF archives (``.reqifz``): ReqIF files with their attachments in one ZIP file."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterator
from pathlib import PurePosixPath

from rgss.errors import DocumentError
from rgss.exchange.files import LARGEST_REQIF_BYTES, problem

ARCHIVE_ENDING = ".reqifz"

_MOST_MEMBERS = 10_000
_SIGNATURES = (b"PK\x03\x04", b"PK\x05\x06")
_EPOCH = (1980, 1, 1, 0, 0, 0)
_OF_MACOS = "._"
"""Beginning of the name of a file that macOS adds to an archive for the attributes of another one."""
_AT_ONCE = 1024 * 1024
_DAMAGED = (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, ValueError, OSError)


def is_archive(content: bytes) -> bool:
    """True if a file is a ZIP file, independent of its suffix."""
    return content.startswith(_SIGNATURES)


def archive_of(text: str, name: str) -> bytes:
    """An archive with one ReqIF file; the same text gives the same bytes."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        entry = zipfile.ZipInfo(name, date_time=_EPOCH)
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = 0o644 << 16
        archive.writestr(entry, text.encode("utf-8"))
    return out.getvalue()


def reqif_members(content: bytes, file: str) -> Iterator[tuple[str, bytes]]:
    """Name and content of each ReqIF file in an archive, in the order of their names.

    Nothing is unpacked to disk; attachments are not read.

    Args:
        content: The archive.
        file: Its name in messages.

    Raises:
        DocumentError: It is damaged, encrypted, has no ReqIF file, a member name that leads out of it, or
            would unpack to too much.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = sorted(_members(archive, file), key=lambda member: member.filename)
            left = LARGEST_REQIF_BYTES
            for member in members:
                # The stated sizes of the members of an archive may be wrong.
                with archive.open(member) as source:
                    parts = []
                    while part := source.read(_AT_ONCE):
                        left -= len(part)
                        if left < 0:
                            raise _too_large(file)
                        parts.append(part)
                yield member.filename, b"".join(parts)
    except _DAMAGED:
        message = "is not a ReqIF archive (.reqifz) that can be read: damaged, or encrypted"
        raise DocumentError([problem(file, "syntax", message, hint="export it again")]) from None


def _members(archive: zipfile.ZipFile, file: str) -> list[zipfile.ZipInfo]:
    members = archive.infolist()
    if len(members) > _MOST_MEMBERS:
        raise DocumentError([problem(file, "size", f"has more than {_MOST_MEMBERS} files, and is refused")])
    for member in members:
        path = PurePosixPath(member.filename.replace("\\", "/"))
        if path.is_absolute() or ".." in path.parts:
            message = f"has a file {member.filename[:100]!r}, whose name leads out of the archive, and is refused"
            raise DocumentError([problem(file, "refused", message)])
    found = [
        member
        for member in members
        if member.filename.lower().endswith(".reqif")
        and not member.is_dir()
        and not PurePosixPath(member.filename).name.startswith(_OF_MACOS)
    ]
    if not found:
        raise DocumentError([problem(file, "empty", "is an archive without a .reqif file")])
    names = [member.filename for member in found]
    if len(set(names)) < len(names):
        raise DocumentError([problem(file, "refused", "has two files of one name, and is refused")])
    if sum(member.file_size for member in found) > LARGEST_REQIF_BYTES:
        raise _too_large(file)
    return found


def _too_large(file: str) -> DocumentError:
    limit = LARGEST_REQIF_BYTES // (1024 * 1024)
    return DocumentError([problem(file, "size", f"would unpack to more than {limit} MiB, and is refused")])
