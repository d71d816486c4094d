"""Constraints: what they mean against Python's own arithmetic, their units, and the mistakes in them."""

import operator
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rgss.designs.constraint_parsing import ConstraintProblem, parse_constraint

UNITS = {
    "design.d1": "1",
    "design.d2": "kg",
    "design.d7": "m/s",
    "design.d9": "s",
    "design.d8": "",
    "component.gripper.max_force": "N",
}
NUMBERS = {"a": "1", "b": "1", "c": "1"}
SIGNS = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne}

RULE = "rules:\n  - id: r\n    rationale: Because.\n    constraint: "


def holds(text, **values):
    return parse_constraint(text, UNITS).holds(values, {})


def sides(depth):
    leaf = st.sampled_from(["a", "b", "design.c", "1", "0.3", "2", "1e-1", "(50 %)"])
    if depth == 0:
        return leaf
    inner = sides(depth - 1)
    return st.one_of(
        leaf,
        st.tuples(inner, st.sampled_from([" + ", "-", " * ", "/"]), inner)
        .map("".join)
        .filter(lambda text: "--" not in text),
        inner.map(lambda text: f"({text})"),
        inner.map(lambda text: f"-({text})"),
        st.tuples(inner, st.integers(-2, 3)).map(lambda pair: f"({pair[0]})**{pair[1]}"),
    )


@given(sides(3), st.sampled_from(sorted(SIGNS)), sides(2), st.tuples(*[st.integers(-3, 3)] * 3))
@settings(max_examples=60, deadline=None)
def test_a_constraint_means_what_python_means(left, sign, right, numbers):
    # A name follows a minus sign only with a space, as ids may have hyphens.
    text = f"{left} {sign} {right}".replace("-", " - ").replace("e - ", "e-").replace("** - ", "**-")
    names = dict(zip("abc", (Fraction(number, 10) for number in numbers), strict=True))
    python = text.replace("design.c", "c").replace("50 %", "0.5")
    exact = {"0.3": "F(3,10)", "1e-1": "F(1,10)", "0.5": "F(1,2)"}
    for written, meant in exact.items():
        python = python.replace(written, meant)
    try:
        expected = eval(python, {"F": Fraction}, names)  # noqa: S307 - made by this test
    except ZeroDivisionError:
        expected = False
    units = {f"design.{name}": "1" for name in "abc"}
    if not set("abc") & set(python):
        with pytest.raises(ConstraintProblem, match="the constraint names no number of the design"):
            parse_constraint(text, units)
        return
    constraint = parse_constraint(text, units)
    assert constraint.holds({name: float(number) for name, number in names.items()}, {}) is bool(expected)


def test_binary_rounding_does_not_decide():
    assert 3 * 0.1 > 0.3
    assert holds("d1 * d2 <= 0.3 kg", d1=3, d2=0.1)
    assert holds("d1 * d2 - 300 g == 0 kg", d1=3, d2=0.1)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("d2 <= 250 g", True),
        ("d2 < 0.25 kg", False),
        ("0.2 kg <= d2 <= 0.3 kg", True),
        ("0.2 kg <= d2 < 0.25 kg", False),
        ("d7 * d9 <= 1 m", True),
        ("d7 > 72 km/h", False),
        ("d7/d9 == 0.25 m/s**2", True),
        ("1/d9 <= 1800 1/h", True),
        ("d2 * d7**2 / 2 <= 0.03125 J", True),
        ("-d1 + 4 >= 50 %", True),
        ("2 ** 2 * d1 == 12", True),
        ("1 / (d1 - 3) > 0", False),
    ],
)
def test_units_count(text, expected):
    assert holds(text, d1=3, d2=0.25, d7=0.5, d9=2.0) is expected


def test_a_name_without_a_component_breaks_nothing():
    assert holds("d2 * 9.81 m/s**2 <= component.gripper.max_force", d2=1e9)


MISTAKES = {
    "d1 * d2": (0, "the constraint has no comparison"),
    "1 <= 2": (0, "the constraint names no number of the design"),
    "d1 <= ": (6, "the end is found where a value is expected"),
    "d1 <= 3 d2": (6, "'3 d2': 'd2' is not a unit"),
    "d1 <= 3 3": (8, "unexpected '3'"),
    "(d1 <= 3": (4, "'<=' is found where ')' is expected"),
    "d1 = 3": (3, "'=' is not allowed in a constraint"),
    "d1 ** d1 <= 3": (6, "'d1' is not an exponent"),
    "d1 ** 7 <= 3": (6, "'7' is not an exponent"),
    "d22 <= 3": (0, "the design has no number 'd22'"),
    "d1-d2 <= 3": (0, "the design has no number 'd1-d2'"),
    "d8 <= 3": (0, "d8 is a name and not a number"),
    "d1 <= 3 kg": (3, "a value in pure numbers is compared with one in kg"),
    "d2 + d9 <= 3 kg": (3, "a value in s is added to one in kg"),
    "d2 - d7*d9 <= 3 kg": (3, "a value in m is subtracted from one in kg"),
    "d2 * d7 <= 3 N": (8, "a value in m*kg*s**-1 is compared with one in N"),
    "d1 <= 3 parsecs*d2": (6, "'3 parsecs*d2': "),
    "(" * 41 + "d1" + ")" * 41 + " <= 3": (40, "nested more than 40 deep"),
    "d1 <= " + "1" * 500: (0, "longer than 500 characters"),
    "__import__('os') <= d1": (11, '"\'" is not allowed in a constraint'),
    "__import__(d2) <= d1": (0, "the design has no number '__import__'"),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistakes_are_told_with_their_place(text):
    offset, message = MISTAKES[text]
    with pytest.raises(ConstraintProblem) as caught:
        parse_constraint(text, UNITS)
    assert caught.value.offset == offset
    assert caught.value.message.startswith(message)
    assert caught.value.hint


@pytest.mark.parametrize("written", ["d2 * ¦d5 <= 1 N", '"d2 * ¦d5 <= 1 N"', "'d2 * ¦d5 <= 1 N'"])
def test_a_mistake_in_a_file_is_found_at_its_character(project, written):
    project.space_text += RULE + written + "\n"
    assert project.findings() == [
        (
            f"{project.marks()[0]}: error: the design has no number 'd5' "
            "(known numbers: component.gripper.cost, component.gripper.force, component.planner.cost, "
            "d1, d2, d4, fingers, force, mass) "
            "[design.unknown-source]"
        )
    ]


def test_a_mistake_in_folded_text_is_found_at_its_beginning(project):
    project.space_text += RULE + "¦>-\n      d2 *\n      d5 <= 1 N\n"
    (finding,) = project.findings()
    assert finding.startswith(f"{project.marks()[0]}: error: the design has no number 'd5'")


def test_combinations_that_break_a_constraint_make_no_variant(project):
    project.space_text += RULE + "design.d1 * d2 < 0.4 kg\n"
    space = project.load()
    masses, fingers = [0.1, 0.2], [2, 3]
    broken = {
        1 + 4 * i + 2 * j + k
        for i, mass in enumerate(masses)
        for j, finger in enumerate(fingers)
        for k in range(2)
        if round(mass * finger, 9) >= 0.4
    }
    assert broken
    assert {one.id: one.rules for one in space.excluded()} == dict.fromkeys(broken, ("r",))
    assert {variant.id for variant in space.expand()} == set(range(1, 9)) - broken


def test_a_constraint_may_have_a_condition_and_name_components(project):
    project.space_text += RULE + "d2 * d4 <= component.gripper.force\n    when: {d3: RRT}\n"
    excluded = {one.id for one in project.load().excluded()}
    assert excluded == {1, 3}
