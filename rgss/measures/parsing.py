"""Parser of expressions, with a finding for every rejected construct."""

from __future__ import annotations

import ast
import difflib
import math
import re
from functools import lru_cache

from rgss.errors import QuantityError
from rgss.measures.expressions import (
    DEEPEST_NESTING,
    LARGEST_EXPONENT,
    LONGEST_EXPRESSION,
    Binary,
    Call,
    Expression,
    ExpressionProblem,
    Name,
    Negative,
    Node,
    Number,
    Power,
)
from rgss.measures.functions import FUNCTIONS, Shape
from rgss.quantities import dimension

_RULE = "measures.expression"
_REFUSED_CHARACTER = re.compile(r"[^A-Za-z0-9_ .,+\-*/()]")
_NUMBER_LIKE = re.compile(r"(?<![\w.])\.?[0-9](?:[\w.]|(?<=[eE])[+-](?=[0-9]))*")
_NUMBER = re.compile(r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_NUMBER_AND_NAME = re.compile(rf"(?<![\w.]){_NUMBER.pattern}\s+(?P<name>[A-Za-z]+)(?!\w)")
_FEWEST_CHOICES = 2
_KEPT = 512
_ALLOWED = f"numbers, symbols, + - * / **, parentheses, and calls of {', '.join(FUNCTIONS)}"
_TOO_DEEP = f"nested more than {DEEPEST_NESTING} deep"
_SPLIT = "split it into several measures"
_OPERATORS: tuple[tuple[type[ast.operator], str], ...] = (
    (ast.Add, "+"),
    (ast.Sub, "-"),
    (ast.Mult, "*"),
    (ast.Div, "/"),
)
_REFUSED: tuple[tuple[type[ast.AST], str], ...] = (
    (ast.Attribute, "attribute access"),
    (ast.Starred, "unpacking"),
    (ast.Tuple, "a list of values"),
    (ast.GeneratorExp, "a comprehension"),
    (ast.IfExp, "a conditional"),
    (ast.BoolOp, "a logical operator"),
    (ast.Compare, "a comparison"),
    (ast.UnaryOp, "this sign"),
)


@lru_cache(maxsize=_KEPT)
def parse_expression(text: str) -> Expression | tuple[ExpressionProblem, ...]:
    """Parse an expression.

    Args:
        text: One line: numbers, symbols, ``+ - * /``, ``**`` with a small number as exponent, unary minus, parentheses,
            and calls of the listed functions.

    Returns:
        The expression, or every problem found in it.
    """
    text = text.strip(" ")
    problem = _unreadable(text)
    if problem is not None:
        return (problem,)
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError as error:
        quantity = _quantity_in(text)
        if quantity is not None:
            return (quantity,)
        offset = min(max((error.offset or 1) - 1, 0), len(text))
        return (_problem(offset, f"not an expression: {error.msg}"),)
    except (RecursionError, MemoryError):
        return (_problem(0, _TOO_DEEP, _SPLIT),)
    reader = _Reader()
    root = reader.read(tree.body, 0)
    if root is None or reader.problems:
        return tuple(reader.problems)
    names: dict[str, int] = {}
    for name, offset in reader.names:
        names.setdefault(name, offset)
    return Expression(text=text, root=root, names=names)


def _unreadable(text: str) -> ExpressionProblem | None:
    if len(text) > LONGEST_EXPRESSION:
        return _problem(0, f"longer than {LONGEST_EXPRESSION} characters", _SPLIT)
    refused = _REFUSED_CHARACTER.search(text)
    if refused is not None:
        return _problem(refused.start(), f"{refused.group()!r} is not allowed in an expression", f"write {_ALLOWED}")
    if not text:
        return _problem(0, "the expression is empty")
    for number in _NUMBER_LIKE.finditer(text):
        if not _NUMBER.fullmatch(number.group()):
            return _problem(number.start(), f"{number.group()!r} is not a number", "write it like 12, 0.5 or 1e-3")
    return None


def _quantity_in(text: str) -> ExpressionProblem | None:
    """Problem of a number with a unit, such as ``600 USD``, which Python's parser refuses without a reason."""
    for match in _NUMBER_AND_NAME.finditer(text):
        try:
            dimension(match["name"])
        except QuantityError:
            continue
        hint = f"state it under 'constants', with 'unit: {match['name']}', and write its id"
        return _problem(match.start(), f"{match.group()!r} is a quantity, and numbers here have no unit", hint)
    return None


class _Reader:
    """Converter of Python's syntax tree, which collects problems and names."""

    def __init__(self) -> None:
        self.problems: list[ExpressionProblem] = []
        self.names: list[tuple[str, int]] = []
        self._too_deep = False

    def read(self, node: ast.expr, depth: int) -> Node | None:
        if depth >= DEEPEST_NESTING:
            if not self._too_deep:
                self._refuse(node, _TOO_DEEP, _SPLIT)
            self._too_deep = True
            return None
        if isinstance(node, ast.Constant):
            number = self._number(node)
            return None if number is None else Number(offset=node.col_offset, value=number)
        if isinstance(node, ast.Name):
            return self._name(node)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            operand = self.read(node.operand, depth + 1)
            return None if operand is None else Negative(offset=node.col_offset, operand=operand)
        if isinstance(node, ast.BinOp):
            return self._binary(node, depth)
        if isinstance(node, ast.Call):
            return self._call(node, depth)
        name = next((name for kind, name in _REFUSED if isinstance(node, kind)), f"'{type(node).__name__}'")
        self._refuse(node, f"{name} is not allowed in an expression", f"write {_ALLOWED}")
        return None

    def _number(self, node: ast.Constant) -> float | None:
        value = node.value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self._refuse(node, f"{ast.unparse(node)} is not a number")
            return None
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if math.isinf(number):
            self._refuse(node, "the number is too large")
            return None
        return number

    def _name(self, node: ast.Name) -> Node | None:
        if node.id in FUNCTIONS:
            self._refuse(node, f"{node.id} is a function; it needs its arguments", f"write {node.id}(…)")
            return None
        self.names.append((node.id, node.col_offset))
        return Name(offset=node.col_offset, id=node.id)

    def _binary(self, node: ast.BinOp, depth: int) -> Node | None:
        if isinstance(node.op, ast.Pow):
            base, exponent = self.read(node.left, depth + 1), self._exponent(node.right)
            if base is None or exponent is None:
                return None
            return Power(offset=node.col_offset, base=base, exponent=exponent)
        symbol = next((symbol for kind, symbol in _OPERATORS if isinstance(node.op, kind)), None)
        if symbol is None:
            self._refuse(node, "this operator is not allowed in an expression", f"write {_ALLOWED}")
            return None
        left, right = self.read(node.left, depth + 1), self.read(node.right, depth + 1)
        if left is None or right is None:
            return None
        return Binary(offset=node.col_offset, symbol=symbol, left=left, right=right)

    def _exponent(self, node: ast.expr) -> float | None:
        sign, digits = 1.0, node
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            sign, digits = -1.0, node.operand
        hint = f"use a whole or half number from -{LARGEST_EXPONENT} to {LARGEST_EXPONENT}"
        if not isinstance(digits, ast.Constant):
            self._refuse(node, "an exponent must be a plain number", hint)
            return None
        number = self._number(digits)
        if number is None:
            return None
        if number > LARGEST_EXPONENT or not (2 * number).is_integer():
            self._refuse(node, f"exponent {ast.unparse(node)} is not allowed", hint)
            return None
        return sign * number

    def _call(self, node: ast.Call, depth: int) -> Node | None:
        if not isinstance(node.func, ast.Name):
            self._refuse(node, "only a function's name can be called", f"functions: {', '.join(FUNCTIONS)}")
            return None
        name = node.func.id
        function = FUNCTIONS.get(name)
        if function is None:
            near = difflib.get_close_matches(name, FUNCTIONS, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"functions: {', '.join(FUNCTIONS)}"
            self._refuse(node, f"unknown function {name!r}", hint, "measures.unknown-function")
        if node.keywords:
            self._refuse(node, "unpacking is not allowed in an expression", f"write {_ALLOWED}")
            return None
        arguments = [self.read(argument, depth + 1) for argument in node.args]
        if function is None:
            return None
        given = len(arguments)
        if function.shape is Shape.EXTREME:
            if given == 0:
                self._refuse(node, f"{name}() needs a row or several numbers", "", "measures.arguments")
                return None
        elif function.shape is Shape.CHOICE:
            if given < _FEWEST_CHOICES:
                self._refuse(node, f"{name}() needs several numbers, such as {name}(x, y)", "", "measures.arguments")
                return None
        elif given != 1:
            self._refuse(node, f"{name}() takes one argument, not {given}", "", "measures.arguments")
            return None
        known = tuple(argument for argument in arguments if argument is not None)
        if len(known) < given:
            return None
        return Call(offset=node.col_offset, function=name, arguments=known)

    def _refuse(self, node: ast.AST, message: str, hint: str = "", rule: str = _RULE) -> None:
        self.problems.append(_problem(getattr(node, "col_offset", 0), message, hint, rule))


def _problem(offset: int, message: str, hint: str = "", rule: str = _RULE) -> ExpressionProblem:
    return ExpressionProblem(rule=rule, offset=offset, message=message, hint=hint)
