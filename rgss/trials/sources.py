"""Which modules of this package the making of a piece runs, found without running anything.

The digest of a piece covers the code that makes it, no less and no more: another colour of a
picture or another way to store records must not make a plan stale. What counts is found by
following the imports of a module. A package that only hands on what its modules define (its
``__init__`` holds nothing but imports and ``__all__``) is followed name by name, so that a module
beside the one that is wanted does not count, although Python loads it too; modules of this package
do nothing when they are loaded, so that loading alone changes no result.
"""

from __future__ import annotations

import ast
import hashlib
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent.parent
_BLOCKS = ("body", "orelse", "handlers", "finalbody", "cases")


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceClosure:
    """The code that some modules need.

    Attributes:
        modules: Names of the modules of the package, sorted.
        foreign: Top-level names of what is imported from elsewhere, the standard library left out, sorted.
        digest: SHA-256 of the modules' names and texts; line ends do not count.
    """

    modules: tuple[str, ...]
    foreign: tuple[str, ...]
    digest: str


@lru_cache(maxsize=1)
def own_sources() -> SourceTree:
    """The sources of this package."""
    return SourceTree(_PACKAGE)


class SourceTree:
    """The sources of a package as files, each read once."""

    def __init__(self, folder: Path) -> None:
        """Read nothing yet.

        Args:
            folder: The package's folder, whose name is the package's.
        """
        self._folder = folder
        self._package = folder.name
        self._files: dict[str, Path | None] = {}
        self._definers: dict[tuple[str, str], str] = {}
        self._texts: dict[str, bytes] = {}
        self._trees: dict[str, ast.Module] = {}
        self._imports: dict[str, tuple[_Import, ...]] = {}

    def closure_of(self, entries: Sequence[str]) -> SourceClosure:
        """Follow the imports of modules, wherever in them they stand.

        Args:
            entries: Names of modules of the package.

        Raises:
            ModuleNotFoundError: One of them is not there.
        """
        modules: set[str] = set()
        foreign: set[str] = set()
        waiting = list(entries)
        while waiting:
            module = waiting.pop()
            if module in modules:
                continue
            modules.add(module)
            for imported in self._imports_of(module):
                if self._is_ours(imported.module):
                    waiting.append(self._definer(imported.module, imported.name))
                else:
                    foreign.add(imported.module.partition(".")[0])
        content = hashlib.sha256()
        for module in sorted(modules):
            content.update(module.encode() + b"\0" + self._text(module) + b"\0")
        return SourceClosure(
            modules=tuple(sorted(modules)),
            foreign=tuple(sorted(foreign - sys.stdlib_module_names)),
            digest=content.hexdigest(),
        )

    def module_digest(self, module: str) -> str:
        """The SHA-256 of the text of a module.

        Args:
            module: Its name.

        Raises:
            ModuleNotFoundError: It is not there.
        """
        return hashlib.sha256(self._text(module)).hexdigest()

    def _is_ours(self, module: str) -> bool:
        return module.partition(".")[0] == self._package

    def _definer(self, module: str, name: str) -> str:
        """The module that defines a name which is imported from a module or package."""
        asked = (module, name)
        if asked not in self._definers:
            self._definers[asked] = self._found_definer(module, name)
        return self._definers[asked]

    def _found_definer(self, module: str, name: str) -> str:
        if name and self._file(f"{module}.{name}") is not None:
            return f"{module}.{name}"
        if name and self._only_hands_on(module):
            for handed in self._imports_of(module):
                if handed.alias == name and self._is_ours(handed.module):
                    return self._definer(handed.module, handed.name)
        return module

    def _only_hands_on(self, module: str) -> bool:
        """Tell whether a module is a package's ``__init__`` of nothing but a docstring, imports and ``__all__``."""
        return self._is_package(module) and all(
            (isinstance(node, ast.ImportFrom) and [name.name for name in node.names] != ["*"])
            or isinstance(node, ast.Import)
            or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
            or (isinstance(node, ast.Assign) and [getattr(t, "id", "") for t in node.targets] == ["__all__"])
            for node in self._tree(module).body
        )

    def _imports_of(self, module: str) -> tuple[_Import, ...]:
        if module not in self._imports:
            package = module if self._is_package(module) else module.rpartition(".")[0]
            self._imports[module] = tuple(_imports_below(self._tree(module).body, package))
        return self._imports[module]

    def _tree(self, module: str) -> ast.Module:
        if module not in self._trees:
            self._trees[module] = ast.parse(self._text(module))
        return self._trees[module]

    def _text(self, module: str) -> bytes:
        if module not in self._texts:
            file = self._file(module)
            if file is None:
                raise ModuleNotFoundError(f"there is no module {module}", name=module)
            self._texts[module] = file.read_bytes().replace(b"\r\n", b"\n")
        return self._texts[module]

    def _is_package(self, module: str) -> bool:
        file = self._file(module)
        return file is not None and file.name == "__init__.py"

    def _file(self, module: str) -> Path | None:
        if module not in self._files:
            path = self._folder.joinpath(*module.split(".")[1:])
            files = (path / "__init__.py", path.with_suffix(".py"))
            self._files[module] = next((file for file in files if file.is_file()), None)
        return self._files[module]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Import:
    """One imported name; the name is empty where the module as a whole is imported."""

    module: str
    name: str
    alias: str


def _imports_below(statements: Iterable[ast.AST], package: str) -> Iterator[_Import]:
    """The imports among statements and the statements within them; expressions hold none and are passed over."""
    for node in statements:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield _Import(module=alias.name, name="", alias=alias.asname or alias.name)
        elif isinstance(node, ast.ImportFrom):
            source = _absolute(node, package)
            for alias in node.names:
                yield _Import(module=source, name=alias.name, alias=alias.asname or alias.name)
        elif isinstance(node, ast.If) and _is_for_types(node.test):
            yield from _imports_below(node.orelse, package)
        else:
            for name in _BLOCKS:
                yield from _imports_below(getattr(node, name, ()), package)


def _absolute(node: ast.ImportFrom, package: str) -> str:
    """The module that is imported from, relative imports resolved."""
    if not node.level:
        return node.module or ""
    parts = package.split(".")
    above = parts[: len(parts) - node.level + 1]
    return ".".join([*above, *([node.module] if node.module else [])])


def _is_for_types(test: ast.expr) -> bool:
    """Tell whether a condition holds for type checkers alone."""
    return (isinstance(test, ast.Name) and test.id == "TYPE_CHECKING") or (
        isinstance(test, ast.Attribute) and test.attr == "TYPE_CHECKING"
    )
