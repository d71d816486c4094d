"""Selection of variants of a design space by a text, the argument of ``--only``."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet

from rgss.designs.balance import balanced_part, binned
from rgss.designs.choosing.filter_names import FilterNames, respelt
from rgss.designs.constraint_parsing import ConstraintProblem, parse_constraint
from rgss.designs.design_values import number_aliases, source_units
from rgss.designs.findings import near_hint, value_hint
from rgss.designs.parameters import DesignParameter, ParameterKind
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
    """Variants selected by all of the terms.

    A term is one of

    - ids and filters separated by commas, which select the union: ``1,5,60-72``,
      ``planning.planner=RRT,planning.planner=TRRT``. A filter compares a parameter (by its id, its name or what it
      sets), a factor's level or a component with a value (``planning.planner=RRT``, ``fingers=two``,
      ``gripper!=kg-2-light``), case-insensitive, a component also with a level that selects it (``gripper=three``), or
      is a constraint as in the file of the design space (``robot.tool_speed <= 0.8 m/s``);
    - a fraction such as ``1/4``: that share of the variants selected by the terms before it, balanced over the levels
    of their factors.

    Args:
        space: The design space.
        terms: The terms, in order.
        option: Name of the option in messages.

    Raises:
        DefinitionError: A term is unknown, or no variant is selected.
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
                f"{option}: no variant is left at {term.strip()!r}", hint="run 'rgss variants' to list them"
            )
    return variants


def _fraction(
    space: DesignSpace, variants: tuple[DesignVariant, ...], part: int, of: int, option: str
) -> tuple[DesignVariant, ...]:
    if not 0 < part < of:
        raise DefinitionError(
            f"{option}: the fraction must be above 0 and below 1, got {part}/{of}",
            hint="write a fraction such as 1/4",
        )
    count = max(1, (2 * len(variants) * part + of) // (2 * of))
    rows = [_codes(space, variant) for variant in variants]
    return tuple(variants[place] for place in balanced_part(rows, min(count, len(variants))))


def _codes(space: DesignSpace, variant: DesignVariant) -> list[int]:
    """Level of each factor as a number; the quarter for a range."""
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
            units, aliases = source_units(space.parameters, space.catalogue), number_aliases(space.parameters)
            constraint = parse_constraint(text, units, aliases)
        except ConstraintProblem as problem:
            raise DefinitionError(f"{option}: {shown(text)}: {problem.message}", hint=problem.hint) from None
        return lambda variant: constraint.holds(variant.parameters, variant.components)
    if equals is not None:
        hint = near_hint(equals["name"], _names(space).known(), "known names")
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
        raise DefinitionError(f"{option}: {first} is not a variant: it {why}", hint="run 'rgss variants' to list them")
    return lambda variant: first <= variant.id <= last


def _equals(space: DesignSpace, name: str, value: str, option: str) -> Filter | None:
    """Filter on a name and its value; None if the name is unknown."""
    names = _names(space)
    parameter = names.parameter(name)
    if parameter is not None and not names.means_level(name, value):
        return _parameter_equals(space, parameter, name, value, option)
    values = names.values(name)
    if values is None:
        return None
    alternatives = values.alternatives(value)
    if not alternatives:
        raise _never(option, name, value, set(values.own), others=set(values.choosing))
    return lambda variant: any(one.holds(variant.parameters, variant.components) for one in alternatives)


def _parameter_equals(space: DesignSpace, parameter: DesignParameter, name: str, value: str, option: str) -> Filter:
    try:
        counted = parameter.kind is ParameterKind.COUNT and value.isdecimal()
        wanted = parameter.read(int(value) if counted else value)
    except QuantityError as error:
        raise DefinitionError(f"{option}: {name}: {error.message}", hint=error.hint) from error
    if parameter.kind is ParameterKind.NAME:
        known = {str(one.parameters[parameter.id]) for one in space.expand()}
        wanted = respelt(value, known)
        if wanted not in known:
            raise _never(option, name, value, known)
    return lambda variant: variant.parameters[parameter.id] == wanted


def _names(space: DesignSpace) -> FilterNames:
    return FilterNames(
        parameters=space.parameters, factors=space.factors, catalogue=space.catalogue, selectors=space.selectors
    )


def _never(
    option: str, name: str, value: str, known: set[str], *, others: AbstractSet[str] = frozenset()
) -> DefinitionError:
    hint = value_hint(value, known, f"known values of {name}", others=others)
    return DefinitionError(f"{option}: {name} is never {value!r}", hint=hint)
