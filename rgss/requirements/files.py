"""YAML form of the requirements; that of the architecture is in `architecture_files`."""

from __future__ import annotations

import re
from typing import Annotated, Any, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field, StringConstraints, WithJsonSchema, model_validator

from rgss.documents import DocumentModel, Identifier, QuantityText, Text
from rgss.errors import QuantityError
from rgss.findings import Severity
from rgss.quantities import parse_quantity
from rgss.requirements.attributes import (
    NeedKind,
    Priority,
    RequirementGroup,
    Status,
    VerificationMethod,
    VerificationPhase,
)
from rgss.requirements.comparison import Comparison
from rgss.requirements.criterion import Statistic

_Entry = TypeVar("_Entry")

_UNIT_START = re.compile(r"(?![eE][+-]?\d)[A-Za-zµμ°%$]")


def split_quantity(text: str) -> tuple[float, str]:
    """Read a quantity of any unit.

    Returns:
        The magnitude, and the unit as it is written; ``"1"`` for a pure number.

    Raises:
        QuantityError: The text is not a number with a known unit.
    """
    start = _UNIT_START.search(text)
    if start is None:
        return parse_quantity(text, "1"), "1"
    if not text[: start.start()].strip():
        raise QuantityError(f"{text!r} has no number", hint='write a number and a unit, such as "1 kg"')
    unit = text[start.start() :].strip()
    return parse_quantity(text, unit), unit


def _as_text(value: Any) -> Any:
    # A threshold without a unit may stand as a plain number.
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def _check_quantity(text: str) -> str:
    split_quantity(text)
    return text


def _not_empty(entries: tuple[_Entry, ...]) -> tuple[_Entry, ...]:
    # Not pydantic's min_length, which counts only sound entries and so reports a broken one twice.
    if not entries:
        raise ValueError("at least 1 entry is expected")
    return entries


Entries = Annotated[tuple[_Entry, ...], AfterValidator(_not_empty), Field(json_schema_extra={"minItems": 1})]
"""A list that is not empty."""

ThresholdText = Annotated[
    QuantityText,
    BeforeValidator(_as_text),
    AfterValidator(_check_quantity),
    WithJsonSchema(
        {
            "type": ["string", "number"],
            "minLength": 1,
            "maxLength": 60,
            "description": "A quantity in a unit of the measure's dimension.",
        }
    ),
]
"""A quantity whose unit the measure decides, such as ``"0.8 kg"``; a pure number may be bare."""


class ExemptionFile(DocumentModel):
    """Exemption of an element from a rule."""

    rule: Identifier
    reason: Text


class NeedFile(DocumentModel):
    """A stakeholder requirement in ``stakeholder.yaml``."""

    id: Identifier
    kind: NeedKind
    parent: Identifier | None = None
    text: Text
    rationale: Text
    source: Text
    priority: Priority
    status: Status
    owner: Text
    exempt: tuple[ExemptionFile, ...] = ()


class StakeholderFile(DocumentModel):
    """The file ``stakeholder.yaml``."""

    requirements: Entries[NeedFile]


class CriterionFile(DocumentModel):
    """The success criterion of a system requirement."""

    measure: Identifier
    statistic: Statistic = Statistic.VALUE
    comparison: Comparison
    threshold: ThresholdText


class RequirementFile(DocumentModel):
    """A system requirement in ``system.yaml``."""

    id: Identifier
    group: RequirementGroup
    parent: Identifier | None = None
    text: Text
    rationale: Text
    source: Text
    derived_from: tuple[Identifier, ...] = ()
    traces: tuple[Identifier, ...] = ()
    satisfied_by: tuple[Identifier, ...] = ()
    verification: VerificationMethod | None = None
    facility: Text | None = None
    phase: VerificationPhase | None = None
    criterion: CriterionFile | None = None
    criterion_exemption: Text | None = None
    success: Text | None = None
    priority: Priority
    status: Status
    owner: Text
    exempt: tuple[ExemptionFile, ...] = ()

    @model_validator(mode="after")
    def _criterion_or_exemption(self) -> RequirementFile:
        if self.criterion is not None and self.criterion_exemption is not None:
            raise ValueError("a criterion and an exemption from it exclude each other")
        if self.criterion is not None and self.success is not None:
            raise ValueError("a criterion and a success criterion in words exclude each other")
        return self


class SystemFile(DocumentModel):
    """The file ``system.yaml``."""

    requirements: Entries[RequirementFile]


class RuleSettingFile(DocumentModel):
    """How one rule is to be applied, in ``rules.yaml``."""

    severity: Severity | None = None
    enabled: bool = True
    terms_added: tuple[Text, ...] = ()
    terms_removed: tuple[Text, ...] = ()
    reason: Text


class RulesFile(DocumentModel):
    """The file ``rules.yaml``."""

    rules: dict[Identifier, RuleSettingFile]


DigestText = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
"""A SHA-256 in hexadecimal digits."""


class ReviewFile(DocumentModel):
    """The review of one element, in ``reviews.yaml``."""

    digest: DigestText
    reviewer: Text
    upstream: dict[Identifier, DigestText]


class ReviewsFile(DocumentModel):
    """The file ``reviews.yaml``, which only a review writes."""

    reviews: dict[Identifier, ReviewFile]
