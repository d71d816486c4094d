"""Loader of the component catalogue."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath, PureWindowsPath

from pydantic import Field

from rgss.currencies import DOLLAR, currencies_in
from rgss.designs.components import Catalogue, Component, Role, SourcedValue
from rgss.designs.fields import ConditionsField, ScalarField
from rgss.designs.findings import DesignFileReader, dotted_findings, duplicate_findings, near_hint, unit_findings
from rgss.designs.parameters import read_magnitude
from rgss.designs.set_findings import component_set_findings, role_set_findings
from rgss.documents import Document, DocumentModel, Identifier, Text, load_document
from rgss.errors import DocumentError, QuantityError
from rgss.findings import shown
from rgss.quantities import dimension, written_unit


class SourcedValueModel(DocumentModel):
    """Magnitude with its source, or marked as an assumption with its rationale."""

    value: ScalarField
    assumption: bool = False
    rationale: Text | None = None
    source: Text | None = None


class ComponentModel(DocumentModel):
    """Component of a role."""

    id: Identifier
    role: Identifier
    name: Text
    manufacturer: Text
    matches: ConditionsField = Field(default_factory=dict)
    geometry: Text | None = None
    cost: SourcedValueModel
    properties: dict[Identifier, SourcedValueModel] = Field(default_factory=dict)


class CatalogueModel(DocumentModel):
    """The file ``designs/catalogue.yaml``."""

    roles: tuple[Role, ...] = Field(min_length=1)
    components: tuple[ComponentModel, ...] = Field(min_length=1)


def load_catalogue(path: Path, *, label: str | None = None) -> Catalogue:
    """Read a component catalogue.

    Args:
        path: The file.
        label: Its name in messages; the path itself by default.

    Raises:
        DocumentError: The file is not a valid catalogue; with every problem in it.
    """
    loaded = load_document(path, CatalogueModel, label=label)
    return _CatalogueReader(loaded.document, loaded.value).read()


class _CatalogueReader(DesignFileReader):
    """Reader of a component catalogue."""

    def __init__(self, document: Document, model: CatalogueModel) -> None:
        super().__init__(document)
        self._model = model
        self._currency = _currency_of(model.components)

    def read(self) -> Catalogue:
        self._findings += duplicate_findings(self._document, ("roles",), self._model.roles)
        self._findings += duplicate_findings(self._document, ("components",), self._model.components)
        roles = self._model.roles
        for index, role in enumerate(roles):
            self._check_role(index, role)
        by_id = {role.id: role for role in reversed(roles)}
        components = tuple(
            self._component(index, component, by_id) for index, component in enumerate(self._model.components)
        )
        self._findings += role_set_findings(self._document, roles)
        if not self._findings:
            self._findings += component_set_findings(self._document, components)
        if self._findings:
            raise DocumentError(sorted(self._findings))
        return Catalogue(roles=roles, components=components, document=self._document)

    def _check_role(self, index: int, role: Role) -> None:
        self._findings += dotted_findings(self._document, ("roles", index, "id"), role.id)
        for name, unit in role.properties.items():
            place = ("roles", index, "properties", name)
            self._findings += dotted_findings(self._document, place, name, at_key=True)
            if name == "cost":
                self._report("reserved", "every component has a cost", *place, hint="remove 'cost'", at_key=True)
            self._findings += unit_findings(self._document, place, name, unit)
        if not any(component.role == role.id for component in self._model.components):
            message = f"no component has the role {role.id!r}"
            self._report("empty-role", message, "roles", index, "id", hint="add one, or remove the role")

    def _component(self, index: int, component: ComponentModel, roles: Mapping[str, Role]) -> Component:
        place = ("components", index)
        role = roles.get(component.role)
        if role is None:
            hint = near_hint(component.role, roles, "known roles")
            self._report("unknown-role", f"unknown role {component.role!r}", *place, "role", hint=hint)
        if component.geometry is not None and not _stays_inside(component.geometry):
            message = f"geometry {shown(component.geometry)} is not a path inside the project"
            self._report("geometry", message, *place, "geometry", hint="write it like scenes/grippers/kg-3.yaml")
        return Component(
            id=component.id,
            role=component.role,
            name=component.name,
            manufacturer=component.manufacturer,
            matches=dict(component.matches),
            geometry=component.geometry or "",
            cost=self._cost(component.cost, *place, "cost"),
            properties={} if role is None else self._properties(component, role, *place),
            sets={} if role is None else role.sets,
        )

    def _cost(self, model: SourcedValueModel, *place: str | int) -> SourcedValue:
        cost = self._value("cost", model, self._currency, *place)
        if cost.value < 0:
            self._report(
                "value",
                f"cost must be at least 0, got {shown(model.value)}",
                *place,
                "value",
                hint="write a cost of at least 0",
            )
        return cost

    def _properties(self, component: ComponentModel, role: Role, *place: str | int) -> Mapping[str, SourcedValue]:
        for name in component.properties:
            if name not in role.properties:
                hint = near_hint(name, role.properties, f"properties of a {role.id}")
                message = f"a {role.id} has no property {name!r}"
                self._report("unknown-property", message, *place, "properties", name, hint=hint, at_key=True)
        properties = {}
        for name, unit in role.properties.items():
            if name in component.properties:
                model = component.properties[name]
                properties[name] = self._value(name, model, unit, *place, "properties", name)
            else:
                message = f"{component.id} lacks the property {name!r} of a {role.id}"
                self._report("missing-property", message, *place, "properties", hint=f"add {name!r}, in {unit}")
        return properties

    def _value(self, name: str, model: SourcedValueModel, unit: str, *place: str | int) -> SourcedValue:
        value = 0.0
        try:
            value = read_magnitude(model.value, unit)
        except QuantityError as error:
            self._report("value", f"{name}: {error.message}", *place, "value", hint=error.hint)
        if model.assumption and model.rationale is None:
            message = f"{name} is assumed without a rationale"
            self._report("unsourced", message, *place, "assumption", hint="add a 'rationale'", at_key=True)
        if not model.assumption and model.source is None:
            message = f"{name} has neither a source nor the mark of an assumption"
            hint = "add a 'source', or 'assumption: true' with a 'rationale'"
            self._report("unsourced", message, *place, hint=hint)
        return SourcedValue(
            value=value,
            unit=unit,
            assumption=model.assumption,
            rationale=model.rationale or "",
            source=model.source or "",
        )


def _currency_of(components: Iterable[ComponentModel]) -> str:
    """Code of the currency of the first cost that has one, in which all are to be."""
    for component in components:
        unit = written_unit(str(component.cost.value)) or ""
        try:
            found = currencies_in(dimension(unit)) if unit else ()
        except QuantityError:
            continue
        if found:
            return found[0]
    return DOLLAR


def _stays_inside(geometry: str) -> bool:
    posix, windows = PurePosixPath(geometry), PureWindowsPath(geometry)
    return not (posix.is_absolute() or windows.drive or "\\" in geometry or ".." in posix.parts)
