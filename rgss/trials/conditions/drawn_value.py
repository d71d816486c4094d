"""Draws of a trial beside their nominal values."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.uncertainty import Application, UncertainQuantity, quantity_of
from rgss.trials.conditions.conditions import conditions_of, nominal_conditions
from rgss.trials.conditions.object_conditions import nominal_object
from rgss.trials.trial_spec import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnValue:
    """One draw of a trial with its nominal and resulting value.

    Attributes:
        name: Name of the draw, such as ``gripper.finger.force``.
        unit: Unit of the two values.
        nominal: The value of the files, the design and the case.
        drawn: The value in the trial.
    """

    name: str
    unit: str
    nominal: float
    drawn: float


def drawn_values(spec: TrialSpec) -> tuple[DrawnValue, ...]:
    """Draws of a trial with the nominal values, in the order of the registry."""
    conditions, nominal = conditions_of(spec), nominal_conditions(spec)
    drawn = {one.id: one for one in conditions.others}
    found = []
    for name in conditions.draws:
        quantity = quantity_of(name)
        if quantity.joint_kind is not None:
            before, after = 0.0, conditions.draws[name]
        elif quantity.object:
            known = nominal_object(conditions.assumed(quantity.object))
            before, after = getattr(known, quantity.field), getattr(drawn[quantity.object], quantity.field)
        else:
            before, after = getattr(nominal, quantity.field), getattr(conditions, quantity.field)
        found.append(DrawnValue(name=name, unit=_unit_of(quantity), nominal=before, drawn=after))
    return tuple(found)


def _unit_of(quantity: UncertainQuantity) -> str:
    """Unit of the field of a quantity; a factor has the unit of its field."""
    if quantity.application is not Application.SCALE:
        return quantity.unit
    endings = {"_kg": "kg", "_n": "N", "_m_s": "m/s"}
    return next((unit for ending, unit in endings.items() if quantity.field.endswith(ending)), "1")
