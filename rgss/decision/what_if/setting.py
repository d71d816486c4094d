"""Modelling assumption for what-ifs: name, value, and the project with another value."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rgss.errors import DefinitionError, QuantityError
from rgss.findings import shown
from rgss.quantities import conversion_factor, parse_quantity
from rgss.studies import Project

_SMALL = {"s": "ms", "m": "mm"}
_LEAST_IN_SI = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelSetting:
    """A modelling assumption of a study.

    Attributes:
        id: Its name, such as ``planning.charge_per_check``.
        value: Its value, as text.
        example: An example of a supposition.
        changed: Function from the text of another value to the project with it; raises `DefinitionError` if the
            text is invalid.
    """

    id: str
    value: str
    example: str
    changed: Callable[[str], Project]


@dataclass(frozen=True, slots=True, kw_only=True)
class SettingChange:
    """Supposed change of a modelling assumption.

    Attributes:
        id: Its name.
        before: Its present value, as text.
        after: The supposed value, as it was written.
    """

    id: str
    before: str
    after: str


def in_words(value: float, unit: str) -> str:
    """Text of a quantity with its unit; seconds and metres below a tenth are given in ms and mm.

    Args:
        value: The value in SI.
        unit: Its SI unit; ``"1"`` for a ratio or a count.
    """
    if unit == "1":
        return f"{value:g}"
    small = _SMALL.get(unit) if 0.0 < abs(value) < _LEAST_IN_SI else None
    if small is None:
        return f"{value:g} {unit}"
    return f"{value * conversion_factor(unit, small):g} {small}"


def quantity_from(name: str, text: str, unit: str, *, above: float | None = None, least: float | None = None) -> float:
    """Quantity of a supposition, validated.

    Args:
        name: Name of the supposition.
        text: The value as it was written.
        unit: The SI unit.
        above: Value that it must exceed.
        least: Its least value.

    Raises:
        DefinitionError: It is not a quantity of this unit, or out of range.
    """
    try:
        value = parse_quantity(text, unit)
    except QuantityError as error:
        raise DefinitionError(f"--what-if: {name}: {error.message}", hint=error.hint) from error
    if above is not None and not value > above:
        raise DefinitionError(f"--what-if: {name} must be above {in_words(above, unit)}, got {shown(text)}")
    if least is not None and not value >= least:
        raise DefinitionError(f"--what-if: {name} must be at least {in_words(least, unit)}, got {shown(text)}")
    return value


def count_from(name: str, text: str, *, least: int, most: int) -> int:
    """Whole number of a supposition, validated.

    Raises:
        DefinitionError: It is not a whole number, or out of range.
    """
    value = quantity_from(name, text, "1")
    if value != int(value) or not least <= value <= most:
        raise DefinitionError(f"--what-if: {name} must be a whole number from {least} to {most}, got {shown(text)}")
    return int(value)


def one_of(name: str, text: str, known: Mapping[str, object] | tuple[str, ...]) -> str:
    """Name of a supposition, validated.

    Raises:
        DefinitionError: It is unknown.
    """
    if text not in known:
        raise DefinitionError(
            f"--what-if: {name} must be one of {', '.join(known)}, got {shown(text)}",
            hint=f"write {name}={next(iter(known))}",
        )
    return text
