"""Choosing some of the variants of a design space by a text, as ``--only`` takes it."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Sequence

from rgss.designs.balance import balanced_part, binned
from rgss.designs.constraint_parsing import ConstraintProblem, parse_constraint
from rgss.designs.design_values import COMPONENT_PREFIX, DESIGN_PREFIX, set_names, source_units
from rgss.designs.findings import near_hint
from rgss.designs.parameters import ParameterKind
from rgss.designs.space import DesignSpace
from rgss.designs.variants import DesignVariant
from rgss.errors import DefinitionError, QuantityError
from rgss.findings import shown

_FRACTION = re.compile(r"([0-9]{1,6})\s*/\s*([0-9]{1,6})", re.ASCII)
_RANGE = re.compile(r"([0-9]{1,12})(?:\s*-\s*([0-9]{1,12}))?", re.ASCII)
_EQUALS = re.compile(r"(?P<name>[A-Za-z][A-Za-z0-9_.-]*)\s*(?P<sign>!=|==|=)\s*(?P<value>[^=<>!]+)")
_COMPARISON = re.compile(r"[<>]|==|!=")

Filter = Callable[[DesignVariant], bool]


def picked(space: DesignSpace, terms: Sequence[str], *, option: str = "--only") -> tuple[DesignVariant, ...]:
    """The variants that every one of some terms chooses.

    A term is one of

    - ids and filters with commas between them, which choose what any of them does: ``1,5,60-72``,
      ``planning.planner=RRT,planning.planner=TRRT``. A filter compares a parameter (by its id or by what
      it sets), a factor's level or a component with a value (``planning.planner=RRT``, ``fingers=two``,
      ``gripper!=kg-2-light``), whatever its capitals, a component also with a level that chooses it
      (``gripper=three``), or is a constraint as in the file of the design space
      (``robot.tool_speed <= 0.8 m/s``);
    - a fraction such as ``1/4``: so many of the variants that the terms before it choose, balanced
      over the levels of their factors.

    Args:
        space: The design space.
        terms: The terms, in order.
        option: What the user knows them by.

    Raises:
        DefinitionError: A term is unknown, or no variant is left.
    """
    variants = space.expand()
    for term in terms:
        fraction = _FRACTION.fullmatch(term.strip())
        before = variants
        if fraction is not None:
            variants = _fraction(space, variants, int(fraction[1]), int(fraction[2]), option)
        else:
            filters = [_filter(space, part.strip(), option) for part in term.split(",")]
            variants = tuple(one for one in variants if any(holds(one) for holds in filters))
        if before and not variants:
            raise DefinitionError(
                f"{option}: no variant is left at {term.strip()!r}", hint="'rgss variants' lists all of them"
            )
    return variants


def _fraction(
    space: DesignSpace, variants: tuple[DesignVariant, ...], part: int, of: int, option: str
) -> tuple[DesignVariant, ...]:
    if not 0 < part < of:
        raise DefinitionError(
            f"{option}: {part}/{of} is not a part of the variants", hint="write a fraction such as 1/4"
        )
    count = max(1, (2 * len(variants) * part + of) // (2 * of))
    rows = [_codes(space, variant) for variant in variants]
    return tuple(variants[place] for place in balanced_part(rows, min(count, len(variants))))


def _codes(space: DesignSpace, variant: DesignVariant) -> list[int]:
    """The level of each factor as a number; of a range, the quarter of it."""
    codes = []
    for factor in space.factors:
        if factor.span is not None:
            span = factor.span
            codes.append(binned((float(variant.parameters[span.parameter]) - span.low) / (span.high - span.low)))
        else:
            codes.append(next(place for place, one in enumerate(factor.levels) if one.id == variant.levels[factor.id]))
    return codes


def _filter(space: DesignSpace, text: str, option: str) -> Filter:
    if _RANGE.fullmatch(text):
        return _ids(space, text, option)
    if _FRACTION.fullmatch(text):
        raise DefinitionError(
            f"{option}: the fraction {text!r} must be the only term", hint=f"give it its own {option}"
        )
    equals = _EQUALS.fullmatch(text)
    if equals is not None:
        found = _equals(space, equals["name"], equals["value"].strip(), option)
        if found is not None:
            return found if equals["sign"] != "!=" else lambda variant: not found(variant)
    if _COMPARISON.search(text):
        try:
            units, aliases = source_units(space.parameters, space.catalogue), set_names(space.parameters)
            constraint = parse_constraint(text, units, aliases)
        except ConstraintProblem as problem:
            raise DefinitionError(f"{option}: {shown(text)}: {problem.message}", hint=problem.hint) from None
        return lambda variant: constraint.holds(variant.parameters, variant.components)
    if equals is not None:
        hint = near_hint(equals["name"], _known_names(space), "known names")
        raise DefinitionError(f"{option}: nothing is named {equals['name']!r}", hint=hint)
    raise DefinitionError(f"{option}: {text!r} is not an id or a range", hint="write ids such as 1,5,60-72")


def _ids(space: DesignSpace, text: str, option: str) -> Filter:
    match = _RANGE.fullmatch(text)
    first = int(match[1]) if match else 0
    last = int(match[2]) if match and match[2] else first
    known = {variant.id for variant in space.expand()}
    excluded = {one.id: one.rules for one in space.excluded()}
    repeats = space.sample.repeats if space.sample is not None else {}
    looked_at = {*known, *excluded, *repeats}
    unknown = next((number for number in range(first, last + 1) if number not in looked_at), None)
    if unknown is not None or first > last:
        raise DefinitionError(
            f"{option}: unknown variant {text if unknown is None else unknown}",
            hint=f"ids go from {min(known)} to {max(known)}",
        )
    if first == last and first not in known:
        why = f"repeats variant {repeats[first]}" if first in repeats else f"breaks rule {excluded[first][0]!r}"
        raise DefinitionError(f"{option}: {first} is not a variant: it {why}", hint="'rgss variants' lists all of them")
    return lambda variant: first <= variant.id <= last


def _equals(space: DesignSpace, name: str, value: str, option: str) -> Filter | None:
    """A filter on one name and its value; None if nothing has the name."""
    bare = set_names(space.parameters).get(name, name).removeprefix(DESIGN_PREFIX)
    parameter = next((one for one in space.parameters if one.id == bare), None)
    if parameter is not None:
        try:
            counted = parameter.kind is ParameterKind.COUNT and value.isdecimal()
            wanted = parameter.read(int(value) if counted else value)
        except QuantityError as error:
            raise DefinitionError(f"{option}: {name}: {error.message}", hint=error.hint) from error
        if parameter.kind is ParameterKind.NAME:
            wanted = _known_value(option, name, value, {str(one.parameters[bare]) for one in space.expand()})
        return lambda variant: variant.parameters[bare] == wanted
    factor = next((one for one in space.factors if one.id == name), None)
    if factor is not None:
        level = value
        if factor.span is None:
            level = _known_value(option, name, value, {level.id for level in factor.levels})
        return lambda variant: variant.levels[name] == level
    role = name.removeprefix(COMPONENT_PREFIX)
    if role in {one.id for one in space.catalogue.roles}:
        choosing = _levels_that_choose(space, role)
        component = _known_value(
            option, name, value, {one.id for one in space.catalogue.of_role(role)}, others=frozenset(choosing)
        )
        if component in choosing:
            return lambda variant: any(variant.levels[one] == component for one in choosing[component])
        return lambda variant: variant.components[role].id == component
    return None


def _levels_that_choose(space: DesignSpace, role: str) -> dict[str, list[str]]:
    """The levels by which the component of a role is chosen, such as the numbers of fingers, each with its factors."""
    parameters = {name for one in space.catalogue.of_role(role) for name in space.selectors.get(one.id, {})}
    found: dict[str, list[str]] = {}
    for factor in space.factors:
        for level in factor.levels:
            if parameters & set(level.values):
                found.setdefault(level.id, []).append(factor.id)
    return found


def _known_value(option: str, name: str, value: str, known: set[str], *, others: frozenset[str] = frozenset()) -> str:
    """The value as it is spelt; capitals make no difference where only one value is meant.

    Args:
        option: What the user knows the filter by.
        name: What is compared.
        value: The value as the user wrote it.
        known: The values that there are.
        others: Further ones, which are taken if none of these is meant.

    Raises:
        DefinitionError: There is no such value.
    """
    for some in (known, others):
        if value in some:
            return value
        alike = [one for one in some if one.lower() == value.lower()]
        if len(alike) == 1:
            return alike[0]
    near = difflib.get_close_matches(value.lower(), {*known, *others}, n=1)
    hint = near_hint(value, {*near} or known, f"known values of {name}")
    raise DefinitionError(f"{option}: {name} is never {value!r}", hint=hint)


def _known_names(space: DesignSpace) -> set[str]:
    parameters, factors = ({one.id for one in some} for some in (space.parameters, space.factors))
    return parameters | factors | set(set_names(space.parameters)) | {role.id for role in space.catalogue.roles}
