from __future__ import annotations

import ast

import pytest

from rgss.measures.expressions import Expression, ExpressionProblem
from rgss.measures.parsing import parse_expression


def problems_of(text: str) -> tuple[ExpressionProblem, ...]:
    parsed = parse_expression(text)
    assert not isinstance(parsed, Expression), f"{text!r} was accepted"
    return parsed


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("1 + a.b", 4, "attribute access is not allowed in an expression"),
        ("1 + a.__class__", 4, "attribute access is not allowed in an expression"),
        ("a[0]", 1, "'[' is not allowed in an expression"),
        ("{a}", 0, "'{' is not allowed in an expression"),
        ("lambda: 1", 6, "':' is not allowed in an expression"),
        ("(a := 1)", 3, "':' is not allowed in an expression"),
        ("'text'", 0, '"\'" is not allowed in an expression'),
        ('"text"', 0, "'\"' is not allowed in an expression"),
        ("a < b", 2, "'<' is not allowed in an expression"),
        ("a == b", 2, "'=' is not allowed in an expression"),
        ("a % b", 2, "'%' is not allowed in an expression"),
        ("a @ b", 2, "'@' is not allowed in an expression"),
        ("a ^ b", 2, "'^' is not allowed in an expression"),
        ("a | b", 2, "'|' is not allowed in an expression"),
        ("a & b", 2, "'&' is not allowed in an expression"),
        ("~a", 0, "'~' is not allowed in an expression"),
        ("a; b", 1, "';' is not allowed in an expression"),
        ("a # b", 2, "'#' is not allowed in an expression"),
        ("a\nb", 1, "'\\n' is not allowed in an expression"),
        ("µ * 2", 0, "'µ' is not allowed in an expression"),
        ("a if b else c", 0, "a conditional is not allowed in an expression"),
        ("a and b", 0, "a logical operator is not allowed in an expression"),
        ("not a", 0, "this sign is not allowed in an expression"),
        ("+a", 0, "this sign is not allowed in an expression"),
        ("a in b", 0, "a comparison is not allowed in an expression"),
        ("a is b", 0, "a comparison is not allowed in an expression"),
        ("(a, b)", 0, "a list of values is not allowed in an expression"),
        ("(x for x in y)", 0, "a comprehension is not allowed in an expression"),
        ("sum(*a)", 4, "unpacking is not allowed in an expression"),
        ("sum(**a)", 0, "unpacking is not allowed in an expression"),
        ("await a", 0, "'Await' is not allowed in an expression"),
        ("(yield a)", 1, "'Yield' is not allowed in an expression"),
        ("a // b", 0, "this operator is not allowed in an expression"),
        ("1j", 0, "'1j' is not a number"),
        ("0x10", 0, "'0x10' is not a number"),
        ("1_000", 0, "'1_000' is not a number"),
        ("1if a else b", 0, "'1if' is not a number"),
        ("1e400", 0, "the number is too large"),
        ("9" * 400, 0, "the number is too large"),
        ("True", 0, "True is not a number"),
        ("None", 0, "None is not a number"),
        ("...", 0, "... is not a number"),
        ("a ** b", 5, "an exponent must be a plain number"),
        ("a ** (1 + 1)", 6, "an exponent must be a plain number"),
        ("2 ** 2 ** 2", 5, "an exponent must be a plain number"),
        ("a ** 7", 5, "exponent 7 is not allowed"),
        ("a ** -7", 5, "exponent -7 is not allowed"),
        ("a ** 0.3", 5, "exponent 0.3 is not allowed"),
        ("a ** 1e400", 5, "the number is too large"),
        ("2 * sum", 4, "sum is a function; it needs its arguments"),
        ("sum(a)(b)", 0, "only a function's name can be called"),
        ("", 0, "the expression is empty"),
        ("   ", 0, "the expression is empty"),
        ("x" * 501, 0, "longer than 500 characters"),
        ("-" * 60 + "1", 40, "nested more than 40 deep"),
        ("-" * 499 + "1", 40, "nested more than 40 deep"),
        ("+".join(["a"] * 60), 0, "nested more than 40 deep"),
    ],
)
def test_what_is_not_listed_is_refused_where_it_stands(text: str, offset: int, message: str) -> None:
    (problem,) = problems_of(text)
    assert (problem.rule, problem.offset, problem.message) == ("measures.expression", offset, message)


@pytest.mark.parametrize(
    ("text", "rule", "message", "hint"),
    [
        ("summ(a)", "measures.unknown-function", "unknown function 'summ'", "did you mean 'sum'?"),
        (
            "__import__(a)",
            "measures.unknown-function",
            "unknown function '__import__'",
            "functions: abs, count, first_known, max, mean, min, norm, sqrt, sum",
        ),
        ("sum(a, b)", "measures.arguments", "sum() takes one argument, not 2", ""),
        ("sqrt()", "measures.arguments", "sqrt() takes one argument, not 0", ""),
        ("max()", "measures.arguments", "max() needs a row or several numbers", ""),
        (
            "first_known(a)",
            "measures.arguments",
            "first_known() needs several numbers, such as first_known(x, y)",
            "",
        ),
    ],
)
def test_calls_are_checked(text: str, rule: str, message: str, hint: str) -> None:
    assert problems_of(text) == (ExpressionProblem(rule=rule, offset=0, message=message, hint=hint),)


def test_every_problem_is_found_at_once() -> None:
    problems = problems_of("sum(a.b) + foo(c ** d) - min()")
    assert [problem.offset for problem in problems] == [4, 11, 20, 25]


@pytest.mark.parametrize("text", ["a +", "1 2", "(a", "a)", "(" * 250 + "1" + ")" * 249, "print a", "* a"])
def test_bad_syntax_is_one_problem_within_the_text(text: str) -> None:
    (problem,) = problems_of(text)
    assert problem.message.startswith("not an expression: ")
    assert 0 <= problem.offset <= len(text)


@pytest.mark.parametrize(
    ("text", "offset", "quantity", "unit"),
    [("options * 600 USD", 10, "600 USD", "USD"), ("2 * (a + 1.5e3 mm) / b", 9, "1.5e3 mm", "mm")],
)
def test_a_quantity_in_an_expression_is_named_as_one(text: str, offset: int, quantity: str, unit: str) -> None:
    (problem,) = problems_of(text)
    assert (problem.rule, problem.offset) == ("measures.expression", offset)
    assert problem.message == f"'{quantity}' is a quantity, and numbers here have no unit"
    assert problem.hint == f"state it under 'constants', with 'unit: {unit}', and write its id"


def test_a_number_before_a_name_that_is_no_unit_is_bad_syntax() -> None:
    (problem,) = problems_of("2 grippers")
    assert problem.message.startswith("not an expression: ")


@pytest.mark.parametrize("error", [RecursionError, MemoryError])
def test_a_parser_that_runs_out_of_stack_is_a_problem(
    monkeypatch: pytest.MonkeyPatch, error: type[BaseException]
) -> None:
    def overflow(*args: object, **kwargs: object) -> None:
        raise error

    monkeypatch.setattr(ast, "parse", overflow)
    (problem,) = problems_of("1")
    assert problem.message == "nested more than 40 deep"


def test_names_are_listed_once_with_their_first_place() -> None:
    parsed = parse_expression("b + a * b - sum(c)")
    assert isinstance(parsed, Expression)
    assert list(parsed.names.items()) == [("b", 0), ("a", 4), ("c", 16)]
