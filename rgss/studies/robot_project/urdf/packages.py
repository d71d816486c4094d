"""Packages of robots, as ROS lays them out: folders with a package file, or with the package's name."""

from __future__ import annotations

import itertools
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
        yield from _at(folder, package)


def package_folder(package: str, urdf: Path) -> Path | None:
    """Folder of a package, seen from a URDF: the nearest one; None where it is not there.

    A folder that states the name comes before one farther away that merely has it.
    """
    for number, folder in enumerate(urdf.resolve().parents):
        inside = sorted(folder.glob("*/")) if number < FOLDERS_UP else []
        stating = (one for one in inside if package_name(one) == package)
        found = next((one for one in itertools.chain(_at(folder, package), stating) if one.is_dir()), None)
        if found is not None:
            return found
    return None


def package_name(folder: Path) -> str | None:
    """Name of the package that a folder states to be; None without one."""
    try:
        found = re.search(r"<name>\s*([^<\s]+)\s*</name>", (folder / _PACKAGE_FILE).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        return None
    return None if found is None else found[1]


def _at(folder: Path, package: str) -> Iterator[Path]:
    """Folders that a package may be by a folder above the URDF: that itself, and the one in it with the name."""
    if folder.name == package or package_name(folder) == package:
        yield folder
    yield folder / package
