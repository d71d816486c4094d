"""Parser of constraints, with a check of units and positions of errors.

The grammar, from the weakest binding to the strongest::

    constraint  side (comparison side)+          comparison: <= >= < > == !=
    side        term (("+" | "-") term)*
    term        factor (("*" | "/") factor)*
    factor      "-" factor | base ["**" whole number]
    base        quantity | name | "(" side ")"
    quantity    a number, with its unit if it has one: 1.2 m/s, 50 %, 90 1/h

A unit has no space in it, so that ``1 m/s * limit`` is a speed times ``limit``. A name is that of a parameter, such as
``finger_force`` or ``design.finger_force``, of the quantity set by a parameter, such as ``gripper.finger.force``, or of
a property of a component, such as ``component.gripper.max_force``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from rgss.designs.constraints import COMPARISONS, Amount, Constraint, Node, Operation, Raised, Symbol
from rgss.designs.design_values import DESIGN_PREFIX
from rgss.designs.factors import exact
from rgss.designs.findings import near_hint
from rgss.designs.parameters import read_magnitude, si_unit, unit_of
from rgss.errors import QuantityError
from rgss.findings import shown
from rgss.quantities import dimension

LONGEST_CONSTRAINT = 500
DEEPEST_NESTING = 40
LARGEST_EXPONENT = 6

_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?)"
    r"(?:[ ]*(?P<unit>(?:(?<=[ ])1/)?[A-Za-zµμ°%$][A-Za-z0-9µμ°%$*/^·⁻¹²³_]*(?:\*\*-[1-9])?))?"
    r"|(?P<name>[A-Za-z_][A-Za-z0-9_.-]*[A-Za-z0-9_]|[A-Za-z_])"
    r"|(?P<sign><=|>=|==|!=|\*\*|[-+*/()<>])"
)

Dimension = tuple[tuple[str, float], ...]


class ConstraintProblem(Exception):  # noqa: N818 - it never leaves the room: it becomes a finding
    """Error in a constraint, with its position.

    Attributes:
        rule: The id of the violated rule.
        offset: Its position, in characters from the start of the text.
        message: The problem.
        hint: Advice.
    """

    def __init__(self, rule: str, offset: int, message: str, hint: str) -> None:
        """Store the problem."""
        super().__init__(message)
        self.rule = rule
        self.offset = offset
        self.message = message
        self.hint = hint


@dataclass(frozen=True, slots=True, kw_only=True)
class _Token:
    kind: str
    text: str
    offset: int
    unit: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """Part of the text: its tree, dimension and start."""

    node: Node
    dimension: Dimension
    offset: int


def parse_constraint(text: str, units: Mapping[str, str], aliases: Mapping[str, str] | None = None) -> Constraint:
    """Parse a constraint.

    Args:
        text: The text.
        units: The SI unit of each value of the design by its name, such as ``design.finger_force``; empty for a name.
        aliases: Aliases of such names, such as ``gripper.finger.force``, with the original name.

    Raises:
        ConstraintProblem: The text is not a constraint.
    """
    if len(text) > LONGEST_CONSTRAINT:
        raise _problem(0, f"longer than {LONGEST_CONSTRAINT} characters", "split it into several rules")
    return _Reader(text, units, aliases or {}).read()


class _Reader:
    def __init__(self, text: str, units: Mapping[str, str], aliases: Mapping[str, str]) -> None:
        self._text = text
        self._units = units
        self._aliases = aliases
        self._tokens = _tokens(text)
        self._at = 0
        self._depth = 0
        self._names: list[str] = []

    def read(self) -> Constraint:
        parts, signs = [self._side()], []
        while self._next().text in COMPARISONS:
            sign = self._take()
            part = self._side()
            if part.dimension != parts[-1].dimension:
                message = f"a value in {_unit(parts[-1])} is compared with one in {_unit(part)}"
                raise _problem(sign.offset, message, "compare values with the same dimension", rule="design.unit")
            signs.append(sign.text)
            parts.append(part)
        token = self._next()
        if token.kind != "end":
            raise _problem(token.offset, f"unexpected {token.text!r}", "write it like fingers * force <= 40 N")
        if not signs:
            raise _problem(0, "the constraint has no comparison", "write it like fingers * force <= 40 N")
        if not self._names:
            raise _problem(0, "the constraint names no number of the design", "name a parameter, such as finger_force")
        return Constraint(
            text=self._text,
            sides=tuple(part.node for part in parts),
            signs=tuple(signs),
            names=tuple(dict.fromkeys(self._names)),
        )

    def _next(self) -> _Token:
        return self._tokens[self._at]

    def _take(self) -> _Token:
        token = self._tokens[self._at]
        self._at += 1
        return token

    def _side(self) -> _Part:
        left = self._term()
        while self._next().text in ("+", "-"):
            sign = self._take()
            right = self._term()
            if left.dimension != right.dimension:
                verb = "added to" if sign.text == "+" else "subtracted from"
                message = f"a value in {_unit(right)} is {verb} one in {_unit(left)}"
                raise _problem(
                    sign.offset, message, "add and subtract values with the same dimension", rule="design.unit"
                )
            node = Operation(sign=sign.text, left=left.node, right=right.node)
            left = _Part(node=node, dimension=left.dimension, offset=left.offset)
        return left

    def _term(self) -> _Part:
        left = self._factor()
        while self._next().text in ("*", "/"):
            sign = self._take()
            right = self._factor()
            power = 1 if sign.text == "*" else -1
            node = Operation(sign=sign.text, left=left.node, right=right.node)
            left = _Part(node=node, dimension=_product(left.dimension, right.dimension, power), offset=left.offset)
        return left

    def _factor(self) -> _Part:
        self._depth += 1
        if self._depth > DEEPEST_NESTING:
            raise _problem(self._next().offset, f"nested more than {DEEPEST_NESTING} deep", "simplify the nesting")
        if self._next().text == "-":
            sign = self._take()
            part = self._factor()
            node = Operation(sign="-", left=Amount(value=Fraction(0)), right=part.node)
            found = _Part(node=node, dimension=part.dimension, offset=sign.offset)
        else:
            found = self._raised(self._base())
        self._depth -= 1
        return found

    def _raised(self, base: _Part) -> _Part:
        if self._next().text != "**":
            return base
        self._take()
        negative = self._next().text == "-" and self._take() is not None
        token = self._take()
        if token.kind != "number" or token.unit or not token.text.isdecimal() or int(token.text) > LARGEST_EXPONENT:
            hint = f"write a whole number up to {LARGEST_EXPONENT}"
            raise _problem(token.offset, f"{_shown(token)} is not an exponent", hint)
        exponent = -int(token.text) if negative else int(token.text)
        dimension = tuple((name, power * exponent) for name, power in base.dimension if exponent)
        return _Part(node=Raised(base=base.node, exponent=exponent), dimension=dimension, offset=base.offset)

    def _base(self) -> _Part:
        token = self._take()
        if token.kind == "number":
            return _amount(token)
        if token.kind == "name":
            return self._symbol(token)
        if token.text == "(":
            inner = self._side()
            closing = self._take()
            if closing.text != ")":
                raise _problem(closing.offset, f"{_shown(closing)} is found where ')' is expected", "close the bracket")
            return inner
        raise _problem(
            token.offset, f"{_shown(token)} is found where a value is expected", "write a quantity or a name"
        )

    def _symbol(self, token: _Token) -> _Part:
        own = f"{DESIGN_PREFIX}{token.text}"
        name = own if own in self._units else self._aliases.get(token.text, token.text)
        unit = self._units.get(name)
        if unit is None:
            known = [*(one.removeprefix(DESIGN_PREFIX) for one, of in self._units.items() if of)]
            known += [alias for alias, source in self._aliases.items() if self._units.get(source)]
            hint = near_hint(token.text, known, "known numbers")
            if "-" in token.text:
                hint = "leave spaces around a minus sign"
            message = f"the design has no number {token.text!r}"
            raise _problem(token.offset, message, hint, rule="design.unknown-source")
        if not unit:
            hint = "write a rule with 'exclude' or 'require' for names"
            raise _problem(token.offset, f"{token.text} is a name and not a number", hint, rule="design.unit")
        self._names.append(name)
        return _Part(node=Symbol(name=name), dimension=dimension(unit), offset=token.offset)


def _tokens(text: str) -> list[_Token]:
    tokens = []
    at = 0
    while at < len(text):
        if text[at] == " ":
            at += 1
            continue
        match = _TOKEN.match(text, at)
        if match is None:
            hint = "write quantities, names, + - * / **, comparisons and brackets"
            raise _problem(at, f"{text[at]!r} is not allowed in a constraint", hint)
        kind = match.lastgroup if match.lastgroup != "unit" else "number"
        tokens.append(_Token(kind=kind or "", text=match[kind or 0], offset=at, unit=(match["unit"] or "")))
        at = match.end()
    return [*tokens, _Token(kind="end", text="", offset=len(text))]


def _amount(token: _Token) -> _Part:
    written = f"{token.text} {token.unit}".strip()
    try:
        unit = si_unit(token.unit) if token.unit else "1"
        value = read_magnitude(written, unit)
    except QuantityError as error:
        hint = "write the unit without spaces, and '*' before a name"
        raise _problem(token.offset, f"{shown(written)}: {error.message}", hint, rule="design.value") from error
    return _Part(node=Amount(value=exact(value)), dimension=dimension(unit), offset=token.offset)


def _shown(token: _Token) -> str:
    return repr(token.text) if token.text else "the end"


def _unit(part: _Part) -> str:
    return unit_of(part.dimension) if part.dimension else "pure numbers"


def _product(left: Dimension, right: Dimension, sign: int) -> Dimension:
    powers = dict(left)
    for name, power in right:
        powers[name] = powers.get(name, 0.0) + sign * power
    return tuple(sorted((name, power) for name, power in powers.items() if power))


def _problem(offset: int, message: str, hint: str, *, rule: str = "design.constraint") -> ConstraintProblem:
    return ConstraintProblem(rule, offset, message, hint)
