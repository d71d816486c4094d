"""Reader of compatibility rules."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.designs.choosing import FilterNames, NamedValues, respelt
from rgss.designs.compatibility import Alternative, Condition, Limit, Rule
from rgss.designs.constraint_parsing import ConstraintProblem, parse_constraint
from rgss.designs.constraints import Constraint
from rgss.designs.design_values import COMPONENT_PREFIX, number_aliases, source_units
from rgss.designs.document import RuleModel
from rgss.designs.findings import DesignFileReader, near_hint, value_hint
from rgss.designs.parameters import ParameterValue, format_value
from rgss.designs.values import ValueReader
from rgss.documents import Document
from rgss.findings import Finding, shown
from rgss.quantities import dimension


@dataclass(frozen=True, slots=True, kw_only=True)
class RulesRead:
    """Valid rules of a file, and findings about the others."""

    rules: tuple[Rule, ...]
    findings: tuple[Finding, ...]


class RuleReader(DesignFileReader):
    """Reader of the rules of one design space."""

    def __init__(
        self,
        document: Document,
        values: ValueReader,
        names: FilterNames,
        constants: Mapping[str, ParameterValue],
        lines: Sequence[str] = (),
    ) -> None:
        super().__init__(document)
        self._values = values
        self._names = names
        self._lines = lines
        self._units = source_units(names.parameters, names.catalogue)
        self._aliases = number_aliases(names.parameters)
        factors = names.factors
        self._spans = {factor.span.parameter: factor.span for factor in factors if factor.span is not None}
        settings = [constants, *(level.values for factor in factors for level in factor.levels)]
        self._possible: dict[str, list[ParameterValue]] = {}
        for setting in settings:
            for name, value in setting.items():
                self._possible.setdefault(name, []).append(value)

    def read(self, models: Sequence[RuleModel]) -> RulesRead:
        """Read all rules."""
        rules = []
        for index, model in enumerate(models):
            known = len(self._findings)
            rule = self._rule(index, model)
            if len(self._findings) == known:
                rules.append(rule)
        return RulesRead(rules=tuple(rules), findings=tuple(self._findings))

    def _rule(self, index: int, model: RuleModel) -> Rule:
        place = ("rules", index)
        given = [key for key in ("exclude", "require", "limit", "constraint") if getattr(model, key) is not None]
        if len(given) != 1 or (model.exclude is not None and model.when is not None):
            hint = "write 'exclude', or 'require', 'limit' or 'constraint' with or without 'when'"
            self._report("rule", f"rule {model.id!r} must have exactly one form", *place, hint=hint)
        when = self._condition(
            model.exclude or model.when or {}, *place, "when" if model.exclude is None else "exclude"
        )
        require: Condition | Limit | Constraint | None = None
        if model.require is not None:
            require = self._condition(model.require, *place, "require")
        elif model.limit is not None:
            require = self._limit(model.limit, *place, "limit")
        elif model.constraint is not None:
            require = self._constraint(model.constraint, *place, "constraint")
        for key in ("when", "require", "exclude"):
            if getattr(model, key) == {}:
                self._report("rule", f"{key} names nothing", *place, key, hint=f"name a parameter, or remove {key!r}")
        return Rule(id=model.id, rationale=model.rationale, when=when, require=require)

    def _condition(self, written: Mapping[str, tuple[ParameterValue, ...]], *place: str | int) -> Condition:
        choices: dict[str, tuple[ParameterValue, ...]] = {}
        alternatives: dict[str, tuple[Alternative, ...]] = {}
        for name, values in written.items():
            parameter = self._names.parameter(name)
            named = self._names.values(name)
            # A factor may have the id of its parameter, and levels with names of their own.
            is_of_levels = all(self._names.means_level(name, value) for value in values)
            if parameter is not None and not is_of_levels:
                if parameter.id in choices:
                    message = f"{name} refers to {parameter.id}, which is listed already"
                    self._report("named-twice", message, *place, name, hint="name it once", at_key=True)
                choices[parameter.id] = self._parameter_values(parameter.id, values, *place, name)
            elif named is not None:
                alternatives[name] = self._alternatives(name, named, values, *place, name)
            else:
                self._report_unknown(name, *place, name)
        return Condition(choices=choices, alternatives=alternatives)

    def _report_unknown(self, name: str, *place: str | int) -> None:
        if name.startswith(COMPONENT_PREFIX):
            role = name.removeprefix(COMPONENT_PREFIX)
            hint = near_hint(role, (known.id for known in self._names.catalogue.roles), "known roles")
            self._report("unknown-role", f"unknown role {role!r}", *place, hint=hint, at_key=True)
            return
        hint = near_hint(name, self._names.known(), "known names")
        self._report("unknown-parameter", f"unknown design parameter {name!r}", *place, hint=hint, at_key=True)

    def _alternatives(
        self, name: str, named: NamedValues, values: Sequence[ParameterValue], *place: str | int
    ) -> tuple[Alternative, ...]:
        found: list[Alternative] = []
        for index, value in enumerate(values):
            meant = named.alternatives(str(value))
            found += meant
            if meant:
                continue
            if name.startswith(COMPONENT_PREFIX):
                role = name.removeprefix(COMPONENT_PREFIX)
                hint = value_hint(str(value), named.own, f"known {role} components", others=named.choosing)
                message = f"no {role} component has the id {shown(value)}"
                self._report("unknown-component", message, *place, index, hint=hint)
            else:
                hint = value_hint(str(value), named.own, f"known values of {name}", others=named.choosing)
                self._report("never-holds", f"{name} is never {shown(value)}", *place, index, hint=hint)
        return tuple(found)

    def _parameter_values(
        self, name: str, written: Sequence[ParameterValue], *place: str | int
    ) -> tuple[ParameterValue, ...]:
        spellings = [*self._values.names.get(name, ()), *(str(one) for one in self._possible.get(name, ()))]
        respelled = [respelt(one, dict.fromkeys(spellings)) if isinstance(one, str) else one for one in written]
        values, findings = self._values.choices(self._document, place, name, respelled)
        self._findings += findings
        possible = self._possible.get(name, [])
        span = self._spans.get(name)
        for index, value in enumerate(values if not findings else ()):
            unit = self._values.parameters[name].unit
            if span is not None and not span.has(value):
                ends = f"{format_value(span.low, unit)} to {format_value(span.high, unit)}"
                message = f"{name} is never {format_value(value, unit)}"
                hint = f"its range: {ends} in {span.steps} steps"
                self._report("never-holds", message, *place, index, hint=hint)
            elif possible and value not in possible:
                known = ", ".join(dict.fromkeys(format_value(item, unit) for item in possible))
                message = f"{name} is never {format_value(value, unit)}"
                self._report("never-holds", message, *place, index, hint=f"its values: {known}")
        return values

    def _constraint(self, text: str, *place: str | int) -> Constraint | None:
        try:
            return parse_constraint(text, self._units, self._aliases)
        except ConstraintProblem as problem:
            finding = self._document.finding(problem.rule, problem.message, place, hint=problem.hint)
            column = finding.column + self._offset(finding, text, problem.offset)
            self._findings.append(replace(finding, column=column))
            return None

    def _offset(self, finding: Finding, text: str, offset: int) -> int:
        """Offset of a character from the value's first character; 0 for folded text."""
        written = self._lines[finding.line - 1][finding.column - 1 :] if self._lines else ""
        if written.startswith(text):
            return offset
        return 1 + offset if written[1:].startswith(text) else 0

    def _limit(self, model: Limit, *place: str | int) -> Limit:
        units = {name: unit for name, unit in self._units.items() if unit}
        named = [(name, (*place, "product_of", index)) for index, name in enumerate(model.product_of)]
        named.append((model.at_most, (*place, "at_most")))
        names = [name if name in units else self._aliases.get(name, name) for name, _ in named]
        unknown = [one for one, name in zip(named, names, strict=True) if name not in units]
        for name, where in unknown:
            numbers = [one for one, of in self._aliases.items() if of in units]
            hint = near_hint(name, (*units, *numbers), "known numbers")
            self._report("unknown-source", f"the design has no number {name!r}", *where, hint=hint)
        if not unknown:
            *product, bound = (units[name] for name in names)
            if _powers(product) != _powers([bound]):
                message = f"a product in {'·'.join(product)} is compared with {model.at_most} in {bound}"
                self._report("unit", message, *place, hint="compare values with the same dimension")
        return Limit(product_of=tuple(names[:-1]), at_most=names[-1])


def _powers(units: Iterable[str]) -> Mapping[str, float]:
    """The dimensions of a product of units."""
    powers: dict[str, float] = {}
    for unit in units:
        for name, power in dimension(unit):
            powers[name] = powers.get(name, 0.0) + power
    return {name: power for name, power in powers.items() if power}
