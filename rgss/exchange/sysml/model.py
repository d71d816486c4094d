"""A whole project as one SysML v2 package."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rgss.exchange.sysml.behaviour import BEHAVIOUR, behaviour
from rgss.exchange.sysml.measures import MEASURES, calculations
from rgss.exchange.sysml.needs import needs, requirement_definitions, system_requirements
from rgss.exchange.sysml.notation import body, documentation, name
from rgss.exchange.sysml.relations import NEEDS, SYSTEM, Relations
from rgss.exchange.sysml.structure import PARTS, STRUCTURE, Parts
from rgss.measures import MeasureSet
from rgss.requirements import RequirementSet
from rgss.trace.evidence import RecordEvidence

LIBRARIES = (
    "ScalarValues::*",
    "RealFunctions::*",
    "SequenceFunctions::size",
    "ControlFunctions::*",
    "RequirementDerivation::*",
    "ModelingMetadata::*",
    "VerificationCases::*",
)
"""Imported libraries of the language."""


def sysml_text(
    requirements: RequirementSet,
    measures: MeasureSet,
    *,
    title: str,
    records: Mapping[str, RecordEvidence] | None = None,
) -> str:
    """Write requirements, architecture and measures in the textual notation of SysML v2.

    Every id is the name, or the short name, of its element; the same model gives the same text.

    Args:
        requirements: Stakeholder and system requirements, structure and behaviour.
        measures: The measures, which become calculations.
        title: The name of the package.
        records: The verification records by id of the requirement.
    """
    parts = Parts(requirements.architecture)
    lines = [
        documentation("Requirements, structure, behaviour and measures of one project, written by rgss."),
        *(f"private import {library};" for library in LIBRARIES),
        *requirement_definitions(),
        *_package(PARTS, parts.definitions()),
        *_package(NEEDS, needs(requirements)),
        *_package(SYSTEM, system_requirements(requirements)),
        *_package(STRUCTURE, parts.parts()),
        *_package(
            BEHAVIOUR,
            (line for each in requirements.architecture.behaviours for line in behaviour(each, parts)),
        ),
        *_package(MEASURES, calculations(measures)),
        *_package("Relations", Relations(requirements, parts, records or {}).lines()),
    ]
    return "\n".join(body(f"package {name(title)}", lines)) + "\n"


def _package(title: str, lines: Iterable[str]) -> list[str]:
    return body(f"package {name(title)}", lines)
