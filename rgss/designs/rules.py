"""Reading compatibility rules."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.designs.compatibility import Condition, Limit, Rule
from rgss.designs.components import Catalogue
from rgss.designs.constraint_parsing import ConstraintProblem, parse_constraint
from rgss.designs.constraints import Constraint
from rgss.designs.design_values import COMPONENT_PREFIX, set_names, source_units
from rgss.designs.document import RuleModel
from rgss.designs.factors import Factor
from rgss.designs.findings import near_hint
from rgss.designs.parameters import ParameterValue, format_value
from rgss.designs.values import ValueReader
from rgss.documents import Document
from rgss.findings import Finding, shown
from rgss.quantities import dimension


@dataclass(frozen=True, slots=True, kw_only=True)
class RulesRead:
    """The sound rules of a file, and a finding for each mistake in the others."""

    rules: tuple[Rule, ...]
    findings: tuple[Finding, ...]


class RuleReader:
    """Reader of the rules of one design space."""

    def __init__(
        self,
        document: Document,
        values: ValueReader,
        catalogue: Catalogue,
        constants: Mapping[str, ParameterValue],
        factors: Sequence[Factor],
        lines: Sequence[str] = (),
    ) -> None:
        self._document = document
        self._values = values
        self._catalogue = catalogue
        self._lines = lines
        self._spans = {factor.span.parameter: factor.span for factor in factors if factor.span is not None}
        self._findings: list[Finding] = []
        settings = [constants, *(level.values for factor in factors for level in factor.levels)]
        self._possible: dict[str, list[ParameterValue]] = {}
        for setting in settings:
            for name, value in setting.items():
                self._possible.setdefault(name, []).append(value)

    def read(self, models: Sequence[RuleModel]) -> RulesRead:
        """Read every rule."""
        rules = []
        for index, model in enumerate(models):
            known = len(self._findings)
            rule = self._rule(index, model)
            if len(self._findings) == known:
                rules.append(rule)
        return RulesRead(rules=tuple(rules), findings=tuple(self._findings))

    def _report(self, rule: str, message: str, *location: str | int, hint: str = "", at_key: bool = False) -> None:
        self._findings.append(self._document.finding(f"design.{rule}", message, location, hint=hint, at_key=at_key))

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
            self._check_limit(model.limit, *place, "limit")
            require = model.limit
        elif model.constraint is not None:
            require = self._constraint(model.constraint, *place, "constraint")
        for key in ("when", "require", "exclude"):
            if getattr(model, key) == {}:
                self._report("rule", f"{key} names nothing", *place, key, hint=f"name a parameter, or remove {key!r}")
        return Rule(id=model.id, rationale=model.rationale, when=when, require=require)

    def _condition(self, written: Mapping[str, tuple[ParameterValue, ...]], *place: str | int) -> Condition:
        choices: dict[str, tuple[ParameterValue, ...]] = {}
        for name, values in written.items():
            if name.startswith(COMPONENT_PREFIX):
                choices[name] = self._component_ids(name, values, *place, name)
            else:
                choices[name] = self._parameter_values(name, values, *place, name)
        return Condition(choices=choices)

    def _component_ids(
        self, name: str, values: Sequence[ParameterValue], *place: str | int
    ) -> tuple[ParameterValue, ...]:
        role = name.removeprefix(COMPONENT_PREFIX)
        roles = [known.id for known in self._catalogue.roles]
        if role not in roles:
            hint = near_hint(role, roles, "known roles")
            self._report("unknown-role", f"unknown role {role!r}", *place, hint=hint, at_key=True)
            return ()
        ids = [component.id for component in self._catalogue.of_role(role)]
        for index, value in enumerate(values):
            if value not in ids:
                hint = near_hint(str(value), ids, f"known {role} components")
                self._report(
                    "unknown-component", f"no {role} component has the id {shown(value)}", *place, index, hint=hint
                )
        return tuple(values)

    def _parameter_values(
        self, name: str, written: Sequence[ParameterValue], *place: str | int
    ) -> tuple[ParameterValue, ...]:
        values, findings = self._values.choices(self._document, place, name, written)
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
            parameters = self._values.parameters.values()
            return parse_constraint(text, source_units(parameters, self._catalogue), set_names(parameters))
        except ConstraintProblem as problem:
            finding = self._document.finding(problem.rule, problem.message, place, hint=problem.hint)
            column = finding.column + self._offset(finding, text, problem.offset)
            self._findings.append(replace(finding, column=column))
            return None

    def _offset(self, finding: Finding, text: str, offset: int) -> int:
        """Distance of a character of the text from the value's first character; 0 where it is folded."""
        written = self._lines[finding.line - 1][finding.column - 1 :] if self._lines else ""
        if written.startswith(text):
            return offset
        return 1 + offset if written[1:].startswith(text) else 0

    def _check_limit(self, model: Limit, *place: str | int) -> None:
        known = source_units(self._values.parameters.values(), self._catalogue)
        units = {name: unit for name, unit in known.items() if unit}
        names = [(name, (*place, "product_of", index)) for index, name in enumerate(model.product_of)]
        names.append((model.at_most, (*place, "at_most")))
        unknown = [(name, where) for name, where in names if name not in units]
        for name, where in unknown:
            hint = near_hint(name, units, "known numbers")
            self._report("unknown-source", f"the design has no number {name!r}", *where, hint=hint)
        if not unknown:
            bound = units[model.at_most]
            product = [units[name] for name in model.product_of]
            if _powers(product) != _powers([bound]):
                message = f"a product in {'·'.join(product)} is compared with {model.at_most} in {bound}"
                self._report("unit", message, *place, hint="compare what has one unit")


def _powers(units: Iterable[str]) -> Mapping[str, float]:
    """The dimensions of a product of units."""
    powers: dict[str, float] = {}
    for unit in units:
        for name, power in dimension(unit):
            powers[name] = powers.get(name, 0.0) + power
    return {name: power for name, power in powers.items() if power}
