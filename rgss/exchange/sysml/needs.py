"""Stakeholder and system requirements as SysML v2 requirements."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeVar

from rgss.exchange.sysml.notation import body, declared, documentation, name, real, string
from rgss.requirements import Criterion, Requirement, RequirementSet, StakeholderNeed, common_attributes

NEED = "Stakeholder requirement"
REQUIREMENT = "System requirement"

_COMMON = ("rationale", "source", "priority", "status", "owner")
_OF_NEEDS = ("kind", *_COMMON)
_OF_REQUIREMENTS = (
    "group",
    *_COMMON,
    "verificationMethod",
    "successCriterion",
    "criterionExemption",
    "facility",
    "phase",
)

Asked = TypeVar("Asked", StakeholderNeed, Requirement)


def requirement_definitions() -> list[str]:
    """The two kinds of requirements with their attributes in addition to those of SysML."""
    return [
        *body(f"requirement def {name(NEED)}", (f"attribute {each} : String[0..1];" for each in _OF_NEEDS)),
        *body(
            f"requirement def {name(REQUIREMENT)}", (f"attribute {each} : String[0..1];" for each in _OF_REQUIREMENTS)
        ),
    ]


def needs(requirements: RequirementSet) -> list[str]:
    """The stakeholder requirements, each within the one that contains it."""
    return _nested(requirements.stakeholder, NEED, _need_lines)


def system_requirements(requirements: RequirementSet) -> list[str]:
    """The system requirements, each within the one that contains it."""
    return _nested(requirements.system, REQUIREMENT, _requirement_lines)


def _nested(elements: Sequence[Asked], kind: str, lines: Callable[[Asked], Iterator[str]]) -> list[str]:
    children: dict[str | None, list[Asked]] = {}
    for element in elements:
        children.setdefault(element.parent, []).append(element)

    def written(element: Asked) -> list[str]:
        inner = [*lines(element), *(line for child in children.get(element.id, ()) for line in written(child))]
        return body(f"{declared('requirement', element.id)} : {name(kind)}", inner)

    return [line for element in children.get(None, ()) for line in written(element)]


def _need_lines(need: StakeholderNeed) -> Iterator[str]:
    yield documentation(need.text)
    yield from _attributes({"kind": need.kind.value, **common_attributes(need)})


def _requirement_lines(requirement: Requirement) -> Iterator[str]:
    yield documentation(requirement.text)
    criterion = requirement.criterion
    yield from _attributes(
        {
            "group": requirement.group.value,
            **common_attributes(requirement),
            "verificationMethod": "" if requirement.verification is None else requirement.verification.value,
            "successCriterion": str(criterion) if criterion is not None else requirement.success,
            "criterionExemption": requirement.criterion_exemption,
            "facility": requirement.facility,
            "phase": "" if requirement.phase is None else requirement.phase.value,
        }
    )
    if criterion is not None:
        yield from _constraint(criterion)


def _attributes(values: Mapping[str, str | None]) -> Iterator[str]:
    for key, value in values.items():
        if value:
            yield f"attribute :>> {key} = {string(' '.join(value.split()))};"


def _constraint(criterion: Criterion) -> Iterator[str]:
    statistic = "" if criterion.statistic.value == "value" else f", {criterion.statistic.value} end of its interval"
    yield from body(
        f"attribute {name(criterion.measure)} : Real",
        [documentation(f"Measure {criterion.measure}{statistic}, in {criterion.unit}.")],
    )
    bound = f"{name(criterion.measure)} {criterion.comparison.value} {real(criterion.threshold)}"
    yield f"require constraint {{ {bound} }}"
