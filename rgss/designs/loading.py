"""Loader of a design space, with findings about it and the catalogue's matches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from rgss.designs.choosing import FilterNames
from rgss.designs.components import Catalogue
from rgss.designs.document import DesignSpaceModel, FactorModel, LevelModel, ParameterModel
from rgss.designs.factors import Factor, Level
from rgss.designs.findings import DesignFileReader, dotted_findings, duplicate_findings, near_hint, unit_findings
from rgss.designs.parameters import DesignParameter, ParameterKind, ParameterValue
from rgss.designs.ranges import read_sample, read_span, sample_findings
from rgss.designs.rules import RuleReader
from rgss.designs.selection import selection_findings
from rgss.designs.set_findings import design_value_findings, parameter_set_findings
from rgss.designs.settable_quantities import CATALOGUE_PREFIX
from rgss.designs.space import DesignSpace
from rgss.designs.values import ValueReader
from rgss.documents import Document, load_document
from rgss.errors import DocumentError

LARGEST_SPACE = 100_000
"""Greatest number of combinations of levels of a design space."""


def load_design_space(path: Path, catalogue: Catalogue, *, label: str | None = None) -> DesignSpace:
    """Read a design space and match it with a catalogue.

    Args:
        path: The file.
        catalogue: The component catalogue.
        label: Its name in messages; the path itself by default.

    Raises:
        DocumentError: The file is not a valid design space, or a combination of its levels does not select exactly one
        component for each role; with every problem, also those of the catalogue that depend on the design space.
    """
    loaded = load_document(path, DesignSpaceModel, label=label)
    lines = path.read_text(encoding="utf-8-sig").splitlines()
    return _SpaceReader(loaded.document, loaded.value, catalogue, lines).read()


class _SpaceReader(DesignFileReader):
    """Reader of a design space, continued with its valid parts."""

    def __init__(self, document: Document, model: DesignSpaceModel, catalogue: Catalogue, lines: Sequence[str]) -> None:
        super().__init__(document)
        self._model = model
        self._catalogue = catalogue
        self._lines = lines
        self._values = ValueReader(parameters={}, names={})

    def read(self) -> DesignSpace:
        parameters = tuple(self._parameter(index, item) for index, item in enumerate(self._model.parameters))
        self._find_duplicates()
        self._findings += parameter_set_findings(self._document, parameters, self._catalogue)
        self._values = ValueReader.of(parameters, self._catalogue)
        selectors = self._selectors()
        constants = self._read_values(self._model.constants, "constants")
        setters: dict[str, str] = dict.fromkeys(self._model.constants, "the constants")
        factors = tuple(self._factor(index, item, setters) for index, item in enumerate(self._model.factors))
        if all(factor.levels or factor.span is not None for factor in factors):
            # The parameters of an invalid factor are unknown.
            self._find_unset(parameters, setters)
        names = FilterNames(parameters=parameters, factors=factors, catalogue=self._catalogue, selectors=selectors)
        rules = RuleReader(self._document, self._values, names, constants, lines=self._lines).read(self._model.rules)
        self._findings += rules.findings
        self._findings += sample_findings(self._document, self._model)
        if self._findings and (self._model.sample is not None or any(factor.span for factor in factors)):
            # The points depend on every factor, so one error changes all designs.
            raise DocumentError(sorted(set(self._findings)))
        space = DesignSpace(
            parameters=parameters,
            constants=constants,
            factors=tuple(factor for factor in factors if factor.levels or factor.span is not None),
            rules=rules.rules,
            catalogue=self._catalogue,
            selectors=selectors,
            sample=read_sample(self._model, factors),
        )
        if not self._is_too_large(space):
            self._findings += selection_findings(space, self._document, self._model)
        self._findings += design_value_findings(space, self._document)
        if self._findings:
            raise DocumentError(sorted(set(self._findings)))
        return space

    def _find_duplicates(self) -> None:
        document, model = self._document, self._model
        self._findings += duplicate_findings(document, ("parameters",), model.parameters)
        self._findings += duplicate_findings(document, ("parameters",), model.parameters, "name")
        self._findings += duplicate_findings(document, ("factors",), model.factors)
        self._findings += duplicate_findings(document, ("rules",), model.rules)
        for index, factor in enumerate(model.factors):
            self._findings += duplicate_findings(document, ("factors", index, "levels"), factor.levels or ())

    def _parameter(self, index: int, model: ParameterModel) -> DesignParameter:
        place = ("parameters", index)
        self._findings += dotted_findings(self._document, (*place, "id"), model.id)
        unit = model.unit or ("" if model.kind is ParameterKind.NAME else "1")
        if model.kind is ParameterKind.NAME:
            self._check_name_parameter(model, *place)
        elif model.role is not None:
            hint = "remove 'role', or write 'kind: name'"
            self._report("role", f"{model.id} has a role but no names", *place, "role", hint=hint, at_key=True)
        elif model.kind is ParameterKind.COUNT and unit != "1":
            message = f"{model.id} is a count with a unit"
            self._report("unit", message, *place, "unit", hint="remove 'unit'", at_key=True)
        elif model.kind is ParameterKind.QUANTITY and model.unit is None:
            self._report("unit", f"{model.id} has no unit", *place, hint="add 'unit', or 'kind: count' or 'kind: name'")
        else:
            self._findings += unit_findings(self._document, (*place, "unit"), model.id, unit)
        return DesignParameter(
            id=model.id,
            name=model.name,
            symbol=model.symbol,
            kind=model.kind,
            unit=unit,
            role=_role_of(model),
            sets=model.sets or "",
            description=model.description,
            assumption=model.assumption or "",
        )

    def _check_name_parameter(self, model: ParameterModel, *place: str | int) -> None:
        roles = [role.id for role in self._catalogue.roles]
        if model.unit is not None:
            message = f"{model.id} has names and a unit"
            self._report("unit", message, *place, "unit", hint="remove 'unit'", at_key=True)
        if model.role is None and model.sets is None:
            hint = "add 'role': that of the components it names"
            self._report("role", f"{model.id} has names of no role", *place, hint=hint)
        elif model.role is not None and model.role not in roles:
            hint = near_hint(model.role, roles, "known roles")
            self._report("unknown-role", f"unknown role {model.role!r}", *place, "role", hint=hint)

    def _selectors(self) -> Mapping[str, Mapping[str, tuple[ParameterValue, ...]]]:
        parameters = self._values.parameters.values()
        choosing = {one.role: one.id for one in parameters if one.sets.startswith(CATALOGUE_PREFIX)}
        selectors = {}
        for index, component in enumerate(self._catalogue.components):
            read: dict[str, tuple[ParameterValue, ...]] = {}
            for name, written in component.matches.items():
                location = ("components", index, "matches", name)
                values, findings = self._values.choices(self._catalogue.document, location, name, written)
                self._findings += findings
                read[name] = values
            if component.role in choosing:
                read.setdefault(choosing[component.role], (component.id,))
            selectors[component.id] = read
        return selectors

    def _read_values(self, written: Mapping[str, ParameterValue], *place: str | int) -> Mapping[str, ParameterValue]:
        """Valid values of parameters in a mapping."""
        read = {}
        for name, value in written.items():
            values, findings = self._values.choices(self._document, (*place, name), name, (value,))
            self._findings += findings
            if values:
                read[name] = values[0]
        return read

    def _factor(self, index: int, model: FactorModel, setters: dict[str, str]) -> Factor:
        place = ("factors", index)
        given = [key for key in ("parameter", "range", "resolution") if getattr(model, key) is not None]
        if (model.levels is None) == (not given) or (given and not {"parameter", "range"} <= set(given)):
            hint = "write 'levels'; or 'parameter', 'range' and 'resolution'"
            self._report("factor", f"factor {model.id!r} has neither just levels nor just a range", *place, hint=hint)
            return Factor(id=model.id, name=model.name, levels=())
        if model.levels is None:
            return self._ranged(model, setters, *place)
        if not model.levels:
            hint = "add a level, or set the parameters under 'constants'"
            self._report("no-levels", f"factor {model.id!r} has no levels", *place, "levels", hint=hint)
        names = list(dict.fromkeys(name for level in model.levels for name in level.sets))
        taken = {name: setters[name] for name in names if name in setters}
        for number, level in enumerate(model.levels):
            self._check_level(level, names, taken, *place, "levels", number)
        setters.update({name: f"factor {model.id!r}" for name in names if name not in taken})
        levels = self._levels(model, taken, *place, "levels")
        return Factor(id=model.id, name=model.name, levels=levels)

    def _ranged(self, model: FactorModel, setters: dict[str, str], *place: str | int) -> Factor:
        span, findings = read_span(self._document, place, model, self._values.parameters)
        self._findings += findings
        name = model.parameter or ""
        if name in setters:
            message = f"{name} is already set by {setters[name]}"
            self._report("set-twice", message, *place, "parameter", hint="set it in one place")
        setters.setdefault(name, f"factor {model.id!r}")
        return Factor(id=model.id, name=model.name, levels=(), span=span)

    def _check_level(self, level: LevelModel, names: list[str], taken: Mapping[str, str], *place: str | int) -> None:
        if not level.sets:
            hint = "name a parameter and its value"
            self._report("empty-level", f"level {level.id!r} sets nothing", *place, "sets", hint=hint)
            return
        for name in names:
            if name not in level.sets:
                message = f"level {level.id!r} does not set {name}, which other levels of its factor set"
                self._report("level-incomplete", message, *place, "sets", hint=f"add {name}")
            elif name in taken:
                message = f"{name} is already set by {taken[name]}"
                self._report("set-twice", message, *place, "sets", name, hint="set it in one place", at_key=True)

    def _levels(self, model: FactorModel, taken: Mapping[str, str], *place: str | int) -> tuple[Level, ...]:
        levels: list[Level] = []
        for number, level in enumerate(model.levels or ()):
            values = self._read_values(level.sets, *place, number, "sets")
            if len(values) < len(level.sets) or not values:
                continue
            equal = next((other.id for other in levels if other.values == values), None)
            if equal is not None:
                hint = "remove one of them"
                self._report("equal-levels", f"level {level.id!r} equals level {equal!r}", *place, number, hint=hint)
                continue
            levels.append(Level(id=level.id, values={name: values[name] for name in values if name not in taken}))
        return tuple(levels)

    def _find_unset(self, parameters: tuple[DesignParameter, ...], setters: Mapping[str, str]) -> None:
        for index, parameter in enumerate(parameters):
            if parameter.id not in setters:
                hint = "set it under 'constants', or in every level of a factor"
                self._report("never-set", f"{parameter.id} is never set", "parameters", index, "id", hint=hint)

    def _is_too_large(self, space: DesignSpace) -> bool:
        if space.sample is not None:
            return False
        combinations = 1
        for factor in space.factors:
            combinations *= len(factor.levels)
        if combinations > LARGEST_SPACE:
            message = f"the factors make {combinations} combinations; at most {LARGEST_SPACE} are expanded"
            self._report("too-large", message, "factors", hint="study fewer at once, or add 'sample'", at_key=True)
        return combinations > LARGEST_SPACE


def _role_of(model: ParameterModel) -> str:
    chosen = model.sets or ""
    return model.role or (chosen.removeprefix(CATALOGUE_PREFIX) if chosen.startswith(CATALOGUE_PREFIX) else "")
