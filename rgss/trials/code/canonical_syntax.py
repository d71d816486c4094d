"""Canonical form of Python source, independent of layout and comments.

Two texts have the same form if they differ only in layout, comments, docstrings, annotations of functions and of their
local variables, imports for type checkers, or the texts of the arguments named in `PROSE`. Annotations in the body of a
class and of a module count, because dataclasses and readers of records evaluate them.

The form is the same on every Python version that can parse the text: it omits unused fields that a later grammar has
added, and joins nodes that only some grammars split.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from typing import Any

_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
PROSE = frozenset({"meaning", "phase_meaning"})
"""Keyword arguments whose literal texts are only descriptions, such as those of a metric's descriptor."""

_NOT_COUNTED = frozenset({"ctx", "kind", "type_comment", "returns", "type_ignores"})


def canonical_form(tree: ast.Module, *, leave_out: frozenset[ast.stmt] = frozenset()) -> str:
    """Canonical text of a syntax tree.

    Args:
        tree: The tree.
        leave_out: Ignored statements, such as imports that are recorded elsewhere.
    """
    parts: list[str] = []
    _write_block(tree.body, parts, leave_out, in_function=False)
    return "".join(parts)


def is_for_type_checkers(test: ast.expr) -> bool:
    """True if a condition holds only for type checkers."""
    return (isinstance(test, ast.Name) and test.id == "TYPE_CHECKING") or (
        isinstance(test, ast.Attribute) and test.attr == "TYPE_CHECKING"
    )


def _write_block(
    statements: Iterable[ast.stmt], parts: list[str], leave_out: frozenset[ast.stmt], *, in_function: bool
) -> None:
    parts.append("[")
    for statement in _effective(statements):
        if statement not in leave_out:
            _write(statement, parts, leave_out, in_function)
    parts.append("]")


def _effective(statements: Iterable[ast.stmt]) -> Iterator[ast.stmt]:
    """Statements with an effect; a bare string and ``pass`` have none."""
    for statement in statements:
        if isinstance(statement, ast.Pass) or (
            isinstance(statement, ast.Expr)
            and isinstance(statement.value, ast.Constant)
            and isinstance(statement.value.value, str)
        ):
            continue
        if isinstance(statement, ast.If) and is_for_type_checkers(statement.test):
            yield from _effective(statement.orelse)
            continue
        yield statement


def _write(node: ast.AST, parts: list[str], leave_out: frozenset[ast.stmt], in_function: bool) -> None:  # noqa: FBT001
    kind = type(node)
    if kind is ast.Constant:
        parts.append(f"{type(node.value).__name__}:{node.value!r};")  # type: ignore[attr-defined]
        return
    if kind is ast.Name:
        parts.append(f"${node.id};")  # type: ignore[attr-defined]
        return
    if isinstance(node, ast.keyword) and node.arg in PROSE and _text_of(node.value) is not None:
        return
    if isinstance(node, ast.AnnAssign) and in_function:
        if node.value is not None:
            _write(ast.Assign(targets=[node.target], value=node.value), parts, leave_out, in_function)
        return
    parts.append(kind.__name__)
    parts.append("(")
    inside = in_function or kind in _FUNCTIONS
    inside = inside and kind is not ast.ClassDef
    for name in node._fields:
        if name in _NOT_COUNTED or (name == "annotation" and kind is ast.arg):
            continue
        value = getattr(node, name, None)
        # An unused field may not exist in an earlier grammar.
        if value is None or (value == [] and type(value) is list):
            continue
        parts.append(name)
        parts.append("=")
        if not isinstance(value, list):
            _write_item(value, parts, leave_out, inside)
        elif value and isinstance(value[0], ast.stmt):
            _write_block(value, parts, leave_out, in_function=inside)
        else:
            parts.append("[")
            for item in _joined(value) if kind is ast.JoinedStr else value:
                _write_item(item, parts, leave_out, inside)
            parts.append("]")
    parts.append(")")


def _write_item(item: Any, parts: list[str], leave_out: frozenset[ast.stmt], in_function: bool) -> None:  # noqa: FBT001
    if isinstance(item, ast.AST):
        _write(item, parts, leave_out, in_function)
    else:
        parts.append(f"{item!r};")


def _joined(values: list[ast.expr]) -> list[ast.expr]:
    """Parts of a formatted string, with adjacent texts joined and empty ones removed."""
    found: list[ast.expr] = []
    for value in values:
        text = _text_of(value)
        before = _text_of(found[-1]) if found else None
        if text is not None and before is not None:
            found[-1] = ast.Constant(value=before + text)
        elif text != "":
            found.append(value)
    return found


def _text_of(value: ast.expr) -> str | None:
    return value.value if isinstance(value, ast.Constant) and isinstance(value.value, str) else None
