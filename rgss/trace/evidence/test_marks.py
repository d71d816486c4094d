"""The tests that are marked as verifying requirements, read from their source without running them."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from rgss.errors import EvidenceError

MARK = "verifies"
"""The mark: ``@pytest.mark.verifies("SYS-030")``."""

LARGEST_FILE_BYTES = 4 * 1024 * 1024

_Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkedTest:
    """A test function with the requirements that it is marked with.

    Attributes:
        id: Its id, such as ``tests/trace/test_links.py::test_a_cycle``, without parameters.
        requirements: Ids of the requirements that it verifies, as they are written.
        file: Its file, relative to the project.
        line: Line of the mark, from 1.
        column: Column of the mark, from 1.
    """

    id: str
    requirements: tuple[str, ...]
    file: str
    line: int
    column: int


def marked_tests(project: Path, *, folder: str = "tests") -> tuple[MarkedTest, ...]:
    """Read the marks of a project's tests.

    Marks on functions, on classes (they hold for each test in them) and in the ``pytestmark`` of a file are read.
    Nothing is imported or executed.

    Args:
        project: The project's folder.
        folder: The folder of its tests, relative to it, which may be missing.

    Returns:
        The marked tests in the order of files and lines.

    Raises:
        EvidenceError: A file of tests cannot be read.
    """
    found: list[MarkedTest] = []
    for path in sorted((project / folder).rglob("test_*.py")):
        label = path.relative_to(project).as_posix()
        source = _read(path, label)
        # Parsing is what takes time, and most files have no mark.
        if MARK in source:
            found.extend(_marked_in(source, label))
    return tuple(found)


def _read(path: Path, label: str) -> str:
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE_BYTES + 1)
        if len(content) > LARGEST_FILE_BYTES:
            raise EvidenceError(f"{label} is too large to be a file of tests", hint="split it")
        return content.decode("utf-8")
    except OSError as error:
        raise EvidenceError(f"{label} cannot be read: {error.strerror}", hint="check its permissions") from error
    except UnicodeDecodeError as error:
        raise EvidenceError(f"{label} is not UTF-8", hint="save the file as UTF-8") from error


@lru_cache(maxsize=4096)
def _marked_in(source: str, label: str) -> tuple[MarkedTest, ...]:
    """The marked tests of a file; cached, since each study of a project asks for those of all files."""
    try:
        module = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        line = getattr(error, "lineno", None) or 1
        raise EvidenceError(f"{label}:{line} is not Python", hint="correct it; its marks cannot be read") from error
    marks = [mark for statement in module.body for mark in _assigned_marks(statement)]
    return tuple(_marked_below(module.body, marks, label, label))


def _marked_below(body: Iterable[ast.stmt], outer: list[ast.Call], prefix: str, label: str) -> Iterator[MarkedTest]:
    for statement in body:
        if isinstance(statement, ast.ClassDef) and statement.name.startswith("Test"):
            inner = [*outer, *_decorator_marks(statement.decorator_list)]
            inner += [mark for each in statement.body for mark in _assigned_marks(each)]
            yield from _marked_below(statement.body, inner, f"{prefix}::{statement.name}", label)
        elif isinstance(statement, _Function) and statement.name.startswith("test"):
            marks = [*outer, *_decorator_marks(statement.decorator_list)]
            if marks:
                names = dict.fromkeys(name for mark in marks for name in _texts(mark))
                yield MarkedTest(
                    id=f"{prefix}::{statement.name}",
                    requirements=tuple(names),
                    file=label,
                    line=marks[-1].lineno,
                    column=marks[-1].col_offset + 1,
                )


def _decorator_marks(decorators: Iterable[ast.expr]) -> list[ast.Call]:
    return [decorator for decorator in decorators if _is_mark(decorator)]  # type: ignore[misc]


def _assigned_marks(statement: ast.stmt) -> list[ast.Call]:
    """The marks of ``pytestmark = …``, which hold for a whole file or class."""
    if not isinstance(statement, ast.Assign):
        return []
    if not any(isinstance(target, ast.Name) and target.id == "pytestmark" for target in statement.targets):
        return []
    return _decorator_marks(
        statement.value.elts if isinstance(statement.value, (ast.List, ast.Tuple)) else [statement.value]
    )


def _is_mark(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == MARK


def _texts(mark: ast.Call) -> Iterator[str]:
    for argument in mark.args:
        if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
            yield argument.value
