"""Lazy package exports: a module of a package is loaded on the first use of one of its names."""

from __future__ import annotations

import ast
import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any


def lazy_exports(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """Module-level ``__getattr__`` and ``__dir__`` (PEP 562) of a package that exports names of its modules.

    The names are those imported under ``if TYPE_CHECKING:`` in the package's ``__init__``, so that type checkers,
    import-linter and Python use the same list. A command then loads only the modules that it uses.

    Args:
        package: Name of the package.
        file: Its ``__init__`` file.

    Returns:
        The two functions; the first also knows ``__all__`` and raises ``AttributeError`` for a name that is not
        exported.
    """
    definers: dict[str, tuple[str, str]] = {}

    def load(name: str) -> Any:
        if not definers:
            definers.update(_definers(Path(file)))
        if name == "__all__":  # asked for by `from package import *`
            return sorted(definers)
        if name not in definers:
            raise AttributeError(f"module {package!r} has no attribute {name!r}", name=name, obj=sys.modules[package])
        module, original = definers[name]
        value = getattr(importlib.import_module(module), original)
        setattr(sys.modules[package], name, value)
        return value

    def names() -> list[str]:
        return sorted({*vars(sys.modules[package]), *_definers(Path(file))})

    return load, names


def _definers(file: Path) -> dict[str, tuple[str, str]]:
    """Defining module and original name of each exported name."""
    return {
        imported.asname or imported.name: (node.module or "", imported.name)
        for block in ast.parse(file.read_bytes()).body
        if isinstance(block, ast.If)
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for imported in node.names
    }
