"""Fingerprint of the code of a piece, by static analysis of imports.

The digest of a piece covers exactly the code that makes it: a change of a picture's colour or of the storage of records
must not make a plan stale. The relevant code is found by following the imports of a module, or those that one of its
functions uses. A package that only re-exports (its ``__init__`` contains only imports and ``__all__``) is followed name
by name, so that its other modules do not count, although Python loads them too; modules of this package have no
import-time effects, so that loading alone changes no result.

A module is digested by its canonical syntax, and an import by its target instead of its path: renaming or moving a
module changes neither its digest nor that of its users.
"""

from __future__ import annotations

import ast
import hashlib
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from rgss.trials.code.canonical_syntax import canonical_form, is_for_type_checkers

_PACKAGE = Path(__file__).resolve().parents[2]
_BLOCKS = ("body", "orelse", "handlers", "finalbody", "cases")


@dataclass(frozen=True, slots=True, kw_only=True)
class SourceClosure:
    """Source code on which modules depend.

    Attributes:
        modules: Names of the modules of the package, sorted.
        foreign: Top-level names of third-party imports, sorted.
        digest: SHA-256 of the canonical forms of the modules and of the targets of their imports; module names,
        comments, docstrings and layout are ignored.
    """

    modules: tuple[str, ...]
    foreign: tuple[str, ...]
    digest: str


@lru_cache(maxsize=1)
def own_sources() -> SourceTree:
    """Source tree of this package."""
    return SourceTree(_PACKAGE)


def source_digest(module: str) -> str:
    """Digest of the code of a module of this package and of its imports.

    Raises:
        ModuleNotFoundError: The module does not exist.
    """
    return own_sources().closure_of((module,)).digest


class SourceTree:
    """Source files of a package, each read once."""

    def __init__(self, folder: Path) -> None:
        """Start without any source read.

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
        self._digests: dict[str, str] = {}

    @property
    def folder(self) -> Path:
        """The package's folder."""
        return self._folder

    def closure_of(self, entries: Sequence[str]) -> SourceClosure:
        """Transitive closure of imports, at any place in a module.

        Args:
            entries: Modules of the package, such as ``rgss.trials.planning.plan``, with all of their imports;
                functions, such as ``rgss.trials.pieces.pieces:make_plan``, with their whole module but only the imports
                that the function uses, directly or through others of its module; and modules followed by a colon,
                without their imports.

        Raises:
            ModuleNotFoundError: A module does not exist.
            LookupError: A function does not exist.
        """
        followed: set[str] = set()
        modules: set[str] = set()
        foreign: set[str] = set()
        links: set[tuple[str, str, str, str]] = set()
        waiting: list[str] = []

        def follow(module: str, imports: Iterable[_Import]) -> None:
            modules.add(module)
            for imported in imports:
                if self._is_ours(imported.module):
                    definer = self._definer(imported.module, imported.name)
                    waiting.append(definer)
                    leads_to = self.module_digest(definer)
                    links.add((self.module_digest(module), imported.alias, imported.name, leads_to))
                else:
                    foreign.add(imported.module.partition(".")[0])

        for entry in entries:
            module, colon, function = entry.partition(":")
            if colon:
                follow(module, self._imports_used_by(module, function) if function else ())
            else:
                waiting.append(module)
        while waiting:
            module = waiting.pop()
            if module not in followed:
                followed.add(module)
                follow(module, self._imports_of(module))
        forms = sorted(self.module_digest(module) for module in modules)
        content = repr((forms, sorted(links))).encode()
        return SourceClosure(
            modules=tuple(sorted(modules)),
            foreign=tuple(sorted(foreign - sys.stdlib_module_names)),
            digest=hashlib.sha256(content).hexdigest(),
        )

    def module_digest(self, module: str) -> str:
        """SHA-256 of the canonical form of a module, without its imports from this package.

        Raises:
            ModuleNotFoundError: The module does not exist.
        """
        if module not in self._digests:
            tree = self._tree(module)
            ours = frozenset(node for node in _import_statements(tree.body) if self._imports_ours(node))
            form = canonical_form(tree, leave_out=ours)
            self._digests[module] = hashlib.sha256(form.encode("utf-8", "surrogatepass")).hexdigest()
        return self._digests[module]

    def _imports_ours(self, node: ast.Import | ast.ImportFrom) -> bool:
        if isinstance(node, ast.ImportFrom):
            return bool(node.level) or self._is_ours(node.module or "")
        return all(self._is_ours(alias.name) for alias in node.names)

    def _imports_used_by(self, module: str, function: str) -> tuple[_Import, ...]:
        """Imports that a function of a module uses, directly or through other definitions of the module."""
        tree = self._tree(module)
        defined: dict[str, ast.stmt] = {}
        for node in tree.body:
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
                defined[node.name] = node
            elif isinstance(node, (ast.Assign, ast.AnnAssign)):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                defined.update(
                    {part.id: node for one in targets for part in ast.walk(one) if isinstance(part, ast.Name)}
                )
        if function not in defined:
            raise LookupError(f"{module} defines no {function}")
        names: set[str] = set()
        waiting = [function]
        package = self._package_of(module)
        found = list[_Import]()
        while waiting:
            name = waiting.pop()
            if name in names:
                continue
            names.add(name)
            definition = defined.get(name)
            if definition is not None:
                found += _imports_below([definition], package)
                waiting += [part.id for part in ast.walk(definition) if isinstance(part, ast.Name)]
        top = _imports_below((node for node in tree.body if node not in defined.values()), package)
        return (*found, *(one for one in top if one.alias.partition(".")[0] in names))

    def _is_ours(self, module: str) -> bool:
        return module.partition(".")[0] == self._package

    def _definer(self, module: str, name: str) -> str:
        """Module that defines a name imported from a module or package."""
        asked = (module, name)
        if asked not in self._definers:
            self._definers[asked] = self._found_definer(module, name)
        return self._definers[asked]

    def _found_definer(self, module: str, name: str) -> str:
        if name and self._file(f"{module}.{name}") is not None:
            return f"{module}.{name}"
        if name and self._only_hands_on(module):
            for handed in self._handed_on(module):
                if handed.alias == name and self._is_ours(handed.module):
                    return self._definer(handed.module, handed.name)
        return module

    def _only_hands_on(self, module: str) -> bool:
        """True if a module is a package's ``__init__`` with only a docstring, imports and ``__all__``.

        The imports may be deferred (``rgss.lazy_exports``), which leaves a condition for type checkers.
        """
        return self._is_package(module) and all(
            (isinstance(node, ast.ImportFrom) and [name.name for name in node.names] != ["*"])
            or isinstance(node, ast.Import)
            or (isinstance(node, ast.If) and is_for_type_checkers(node.test))
            or (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant))
            or (isinstance(node, ast.Assign) and [getattr(t, "id", "") for t in node.targets] == ["__all__"])
            for node in self._tree(module).body
        )

    def _handed_on(self, module: str) -> Iterator[_Import]:
        """Imports of a re-exporting package, including deferred ones."""
        for node in self._tree(module).body:
            yield from _imports_below(node.body if isinstance(node, ast.If) else [node], module)

    def _imports_of(self, module: str) -> tuple[_Import, ...]:
        if module not in self._imports:
            self._imports[module] = tuple(_imports_below(self._tree(module).body, self._package_of(module)))
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

    def _package_of(self, module: str) -> str:
        return module if self._is_package(module) else module.rpartition(".")[0]

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
    """One imported name; the name is empty if the whole module is imported."""

    module: str
    name: str
    alias: str


def _imports_below(statements: Iterable[ast.AST], package: str) -> Iterator[_Import]:
    """Imports in statements and nested statements; expressions contain none and are skipped."""
    for node in statements:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield _Import(module=alias.name, name="", alias=alias.asname or alias.name)
        elif isinstance(node, ast.ImportFrom):
            source = _absolute(node, package)
            for alias in node.names:
                yield _Import(module=source, name=alias.name, alias=alias.asname or alias.name)
        elif isinstance(node, ast.If) and is_for_type_checkers(node.test):
            yield from _imports_below(node.orelse, package)
        else:
            for name in _BLOCKS:
                yield from _imports_below(getattr(node, name, ()), package)


def _absolute(node: ast.ImportFrom, package: str) -> str:
    """Imported module, with relative imports resolved."""
    if not node.level:
        return node.module or ""
    parts = package.split(".")
    above = parts[: len(parts) - node.level + 1]
    return ".".join([*above, *([node.module] if node.module else [])])


def _import_statements(statements: Iterable[ast.AST]) -> Iterator[ast.Import | ast.ImportFrom]:
    """All import statements in statements and nested statements."""
    for node in statements:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            yield node
        else:
            for name in _BLOCKS:
                yield from _import_statements(getattr(node, name, ()))
