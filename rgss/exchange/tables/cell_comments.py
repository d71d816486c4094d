"""Comments of the cells of a workbook, which have no counterpart in a project."""

from __future__ import annotations

import io
import posixpath
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterator
from typing import NamedTuple

_LONGEST_TEXT = 120


class CellComment(NamedTuple):
    """A comment of a cell.

    Attributes:
        cell: The cell, such as ``C3``.
        text: The comment in one line, cut if it is long.
    """

    cell: str
    text: str


def cell_comments(content: bytes, sheet: str) -> Iterator[CellComment]:
    """Comments and notes of a sheet, in the file's order.

    Args:
        content: The workbook, whose XML has been checked for entities and document types.
        sheet: Path of the sheet in the workbook, such as ``xl/worksheets/sheet1.xml``.
    """
    sheet = sheet.lstrip("/")
    folder, name = posixpath.split(sheet)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        members = set(archive.namelist())
        related = f"{folder}/_rels/{name}.rels"
        if related not in members:
            return
        for relation in _parsed(archive, related):
            if not relation.get("Type", "").endswith("/comments"):
                continue
            target = relation.get("Target", "")
            path = target.lstrip("/") if target.startswith("/") else posixpath.normpath(f"{folder}/{target}")
            if path in members:
                yield from _comments(_parsed(archive, path))


def _parsed(archive: zipfile.ZipFile, member: str) -> ET.Element:
    return ET.fromstring(archive.read(member))  # noqa: S314 - entities and document types are refused before


def _comments(root: ET.Element) -> Iterator[CellComment]:
    for each in root.iterfind(".//{*}comment"):
        text = " ".join("".join(part.text or "" for part in each.iterfind(".//{*}t")).split())
        yield CellComment(each.get("ref", ""), text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…")
