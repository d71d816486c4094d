"""Comments and hyperlinks of the cells of a workbook, which have no counterpart in a project."""

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


class CellLink(NamedTuple):
    """A hyperlink of a cell or a range.

    Attributes:
        cell: The cell, or the first of a range, such as ``C3``.
        target: The address, or the place in the workbook.
    """

    cell: str
    target: str


def cell_comments(content: bytes, sheet: str) -> Iterator[CellComment]:
    """Comments and notes of a sheet, in the file's order.

    Args:
        content: The workbook, whose XML has been checked for entities and document types.
        sheet: Path of the sheet in the workbook, such as ``xl/worksheets/sheet1.xml``.
    """
    folder = posixpath.dirname(sheet.lstrip("/"))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for relation in _relations(archive, sheet):
            if not relation.get("Type", "").endswith("/comments"):
                continue
            target = relation.get("Target", "")
            path = target.lstrip("/") if target.startswith("/") else posixpath.normpath(f"{folder}/{target}")
            if path in archive.namelist():
                yield from _comments(_parsed(archive, path))


def cell_links(content: bytes, sheet: str) -> Iterator[CellLink]:
    """Hyperlinks of a sheet, in the file's order; see `cell_comments`."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        with archive.open(sheet.lstrip("/")) as file:
            found = [dict(each.attrib) for _, each in ET.iterparse(file) if each.tag.endswith("}hyperlink")]  # noqa: S314
        if not found:
            return
        targets = {each.get("Id", ""): each.get("Target", "") for each in _relations(archive, sheet)}
    for link in found:
        named = next((value for name, value in link.items() if name.endswith("}id")), "")
        target = "#".join(part for part in (targets.get(named, ""), link.get("location", "")) if part)
        if target:
            yield CellLink(link.get("ref", "").partition(":")[0], target)


def _relations(archive: zipfile.ZipFile, sheet: str) -> Iterator[ET.Element]:
    folder, name = posixpath.split(sheet.lstrip("/"))
    related = f"{folder}/_rels/{name}.rels"
    if related in archive.namelist():
        yield from _parsed(archive, related)


def _parsed(archive: zipfile.ZipFile, member: str) -> ET.Element:
    return ET.fromstring(archive.read(member))  # noqa: S314 - entities and document types are refused before


def _comments(root: ET.Element) -> Iterator[CellComment]:
    for each in root.iterfind(".//{*}comment"):
        text = " ".join("".join(part.text or "" for part in each.iterfind(".//{*}t")).split())
        yield CellComment(each.get("ref", ""), text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…")
