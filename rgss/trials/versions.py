"""Versions of the code and the engines that a trial's result depends on."""

from __future__ import annotations

import hashlib
import importlib.metadata
from functools import lru_cache
from pathlib import Path

ENGINES = ("pybullet", "ompl", "pin", "coal", "eaik", "toppra", "numpy", "scipy")
_ROOMS = ("scenes", "kinematics", "motion", "physics", "grasping", "trials")


@lru_cache(maxsize=1)
def versions() -> dict[str, str]:
    """Installed version of each engine, and a digest of the source of the rooms that make trials.

    The source is digested so that evidence of other code is never taken for evidence of this.
    """
    found = {name: importlib.metadata.version(name) for name in ENGINES}
    found["rgss-source"] = _source_digest()
    return found


def _source_digest() -> str:
    package = Path(__file__).resolve().parent.parent
    content = hashlib.sha256()
    for room in _ROOMS:
        for file in sorted((package / room).rglob("*.py")):
            content.update(file.relative_to(package).as_posix().encode())
            content.update(b"\0")
            content.update(file.read_bytes().replace(b"\r\n", b"\n"))
            content.update(b"\0")
    return content.hexdigest()
