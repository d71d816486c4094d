"""Source closures of the pieces, kept beside the compiled code: parsing the sources takes longer than most commands.

The file is found by the content of every source file of the package, the finding of closures included, so that it
never says anything else than the sources do. Like Python's own files of compiled code it is written where the folder
of the package can be written and Python keeps compiled code, and it may be deleted at any time.
"""

from __future__ import annotations

import contextlib
import hashlib
import importlib.util
import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rgss.documents import replaced_file
from rgss.trials.code.code_fingerprint import SourceClosure

_NAME = "piece_closures"


@dataclass(frozen=True, slots=True, kw_only=True)
class PieceSources:
    """Source code of all pieces.

    Attributes:
        closures: Closure of each piece, by its name.
        modules: SHA-256 of the canonical form of each module of a closure, by its name.
    """

    closures: Mapping[str, SourceClosure]
    modules: Mapping[str, str]


def cached_sources(folder: Path, compute: Callable[[], PieceSources], *, file: Path | None = None) -> PieceSources:
    """The sources of pieces as found before for the same source files, or found now.

    Args:
        folder: The package's folder.
        compute: Function that finds them.
        file: The file that keeps them; by default beside the compiled code of this module.
    """
    kept_in = file or _file()
    if kept_in is None:
        return compute()
    key = _key_of(folder)
    found = _read(kept_in, key)
    if found is None:
        found = compute()
        # Sources that changed meanwhile may have been read before or after the change.
        if not sys.dont_write_bytecode and _key_of(folder) == key:
            _write(kept_in, key, found)
    return found


def _file() -> Path | None:
    try:
        compiled = Path(importlib.util.cache_from_source(__file__))
    except NotImplementedError:
        return None
    return compiled.with_name(f"{_NAME}.{sys.implementation.cache_tag}.json")


def _key_of(folder: Path) -> str:
    """SHA-256 of the names and contents of all source files, and of the version of Python, whose grammar reads them."""
    key = hashlib.sha256(sys.version.encode())
    for path in sorted(_sources_below(str(folder))):
        content = Path(path).read_bytes()
        key.update(f"{os.path.relpath(path, folder)}\0{len(content)}\0".encode("utf-8", "surrogateescape"))
        key.update(content)
    return key.hexdigest()


def _sources_below(folder: str) -> Iterator[str]:
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(".py"):
                yield entry.path
            elif entry.is_dir() and entry.name != "__pycache__":
                yield from _sources_below(entry.path)


def _read(file: Path, key: str) -> PieceSources | None:
    """Entry of a key; None if the file has none, or is not as it was written."""
    try:
        kept = json.loads(file.read_bytes())
        if kept["key"] != key or kept["checksum"] != _checksum(kept["sources"]):
            return None
        closures = {
            piece: SourceClosure(
                modules=tuple(closure["modules"]), foreign=tuple(closure["foreign"]), digest=closure["digest"]
            )
            for piece, closure in kept["sources"]["closures"].items()
        }
        return PieceSources(closures=closures, modules=kept["sources"]["modules"])
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None


def _write(file: Path, key: str, found: PieceSources) -> None:
    """Replace the file as a whole, if its folder can be written: other processes may read it, or write it too."""
    sources = {
        "closures": {piece: asdict(closure) for piece, closure in found.closures.items()},
        "modules": dict(found.modules),
    }
    text = json.dumps({"key": key, "checksum": _checksum(sources), "sources": sources})
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        with replaced_file(file) as part:
            part.write_text(text, encoding="utf-8")


def _checksum(sources: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(sources, sort_keys=True).encode()).hexdigest()
