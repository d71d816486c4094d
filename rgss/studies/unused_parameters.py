"""Findings about design parameters that nothing uses, and about actuators without mass."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.designs import DESIGN_PREFIX
from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.studies.design_settings import setters_of
from rgss.studies.project import Project

_ACTUATOR_MASS = "gripper.actuator.mass"


def unused_findings(project: Project) -> Iterator[Finding]:
    """Warn of every design parameter that sets nothing and that nothing else names."""
    designs = project.designs
    used = {name.removeprefix(DESIGN_PREFIX) for rule in designs.rules for name in rule.names}
    used |= {symbol.source.removeprefix(DESIGN_PREFIX) for symbol in project.measures.inputs}
    used |= {name for selector in designs.selectors.values() for name in selector}
    label = project.study.design_space
    document = read_document(project.folder / label, label=label)
    for index, parameter in enumerate(designs.parameters):
        if not parameter.sets and parameter.id not in used:
            yield document.finding(
                "design.unused-parameter",
                f"{parameter.id} sets nothing, and no component, rule or measure uses it",
                ("parameters", index, "id"),
                severity=Severity.WARNING,
                hint="say what it sets under 'sets', or remove it",
            )


def uncounted_mass_findings(project: Project) -> Iterator[Finding]:
    """Warn of actuators that have a mass which the simulated gripper does not carry."""
    catalogue = project.designs.catalogue
    if _ACTUATOR_MASS in setters_of(project.designs):
        return
    for index, role in enumerate(catalogue.roles):
        if "mass" in role.properties and "actuator" in f"{role.id} {role.name}".lower():
            yield catalogue.document.finding(
                "design.uncounted-mass",
                f"the mass of a {role.id} is in no trial",
                ("roles", index, "id"),
                severity=Severity.WARNING,
                hint=f"add 'sets: {{mass: {_ACTUATOR_MASS}}}' to the role",
            )
