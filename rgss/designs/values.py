"""Reader of values of design parameters in files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rgss.designs.components import Catalogue
from rgss.designs.findings import near_hint
from rgss.designs.parameters import DesignParameter, ParameterKind, ParameterValue
from rgss.designs.settable_quantities import CATALOGUE_PREFIX
from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding, shown


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueReader:
    """Reader of the values of named parameters.

    Attributes:
        parameters: The parameters by id.
        names: The names listed by the components of a known role under a parameter, by parameter id.
    """

    parameters: Mapping[str, DesignParameter]
    names: Mapping[str, tuple[str, ...]]

    @classmethod
    def of(cls, parameters: Sequence[DesignParameter], catalogue: Catalogue) -> ValueReader:
        """Reader for parameters with the names of a catalogue."""
        names = {}
        roles = {role.id for role in catalogue.roles}
        for parameter in parameters:
            if parameter.sets.startswith(CATALOGUE_PREFIX):
                names[parameter.id] = tuple(component.id for component in catalogue.of_role(parameter.role))
            elif parameter.kind is ParameterKind.NAME and parameter.role in roles:
                matches = [component.matches.get(parameter.id, ()) for component in catalogue.of_role(parameter.role)]
                names[parameter.id] = tuple(str(name) for values in matches for name in values)
        return cls(parameters={parameter.id: parameter for parameter in reversed(parameters)}, names=names)

    def choices(
        self, document: Document, location: Sequence[str | int], name: str, written: Sequence[ParameterValue]
    ) -> tuple[tuple[ParameterValue, ...], list[Finding]]:
        """Read the values of a parameter under a key.

        Args:
            document: The file.
            location: Location of the value or the list of values.
            name: The key: the parameter's id.
            written: The written values.

        Returns:
            The valid values in SI, and a finding for each of the others.
        """
        parameter = self.parameters.get(name)
        if parameter is None:
            hint = near_hint(name, self.parameters, "known parameters")
            message = f"unknown design parameter {name!r}"
            return (), [document.finding("design.unknown-parameter", message, location, hint=hint, at_key=True)]
        values: list[ParameterValue] = []
        findings = []
        for index, item in enumerate(written):
            # A single value is at the location itself; the index is then skipped.
            place = (*location, index)
            try:
                value = parameter.read(item)
            except QuantityError as error:
                findings.append(document.finding("design.value", f"{name}: {error.message}", place, hint=error.hint))
                continue
            if value not in self.names.get(name, (value,)):
                hint = near_hint(str(value), self.names[name], f"known {parameter.role} names")
                message = f"{name}: no {parameter.role} component is named {shown(value)}"
                findings.append(document.finding("design.unknown-name", message, place, hint=hint))
                continue
            values.append(value)
        return tuple(values), findings
