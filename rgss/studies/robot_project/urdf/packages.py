"""Packages of robots, as ROS lays them out: folders with a package file, or with the package's name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

FOLDERS_UP = 4
"""Folders above a file that are searched for what it names, where its package goes by another name."""

_PACKAGE_FILE = "package.xml"


def package_folders(package: str, urdf: Path) -> Iterator[Path]:
    """Folders that a package may be, the nearest to a URDF first, whether they are there or not.

    Args:
        package: The name of the package.
        urdf: The URDF, resolved.
    """
    for folder in urdf.parents:
        if folder.name == package or package_name(folder) == package:
            yield folder
        yield folder / package


def package_folder(package: str, urdf: Path) -> Path | None:
    """Folder of a package, seen from a URDF: the nearest one; None where it is not there.

    A folder that states the name comes before one farther away that merely has it.
    """
    urdf = urdf.resolve()
    for number, folder in enumerate(urdf.parents):
        if folder.name == package or package_name(folder) == package:
            return folder
        if (folder / package).is_dir():
            return folder / package
        beside = sorted(folder.glob("*/")) if number < FOLDERS_UP else []
        stating = next((inside for inside in beside if package_name(inside) == package), None)
        if stating is not None:
            return stating
    return None


def package_name(folder: Path) -> str | None:
    """Name of the package that a folder states to be; None without one."""
    try:
        found = re.search(r"<name>\s*([^<\s]+)\s*</name>", (folder / _PACKAGE_FILE).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        return None
    return None if found is None else found[1]
