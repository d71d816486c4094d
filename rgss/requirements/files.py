"""Document models of the folder ``requirements/``."""

from __future__ import annotations

from pydantic import model_validator

from rgss.documents import DocumentModel, Identifier
from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.fields import Entries
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement
from rgss.requirements.review import Review
from rgss.requirements.rule_settings import RuleSetting
from rgss.requirements.verification_record import VerificationRecord


class StakeholderFile(DocumentModel):
    """The file ``stakeholder.yaml``."""

    requirements: Entries[StakeholderNeed]


class SystemFile(DocumentModel):
    """The file ``system.yaml``."""

    requirements: Entries[Requirement]


class ArchitectureFile(DocumentModel):
    """The file ``architecture.yaml``, or one of the folder of that name."""

    blocks: tuple[Block, ...] = ()
    behaviours: tuple[Behaviour, ...] = ()

    @model_validator(mode="after")
    def _not_empty(self) -> ArchitectureFile:
        if not self.blocks and not self.behaviours:
            raise ValueError("blocks or behaviours are expected")
        return self


class RulesFile(DocumentModel):
    """The file ``rules.yaml``."""

    rules: dict[Identifier, RuleSetting]


class ReviewsFile(DocumentModel):
    """The file ``reviews.yaml``, written by a review."""

    reviews: dict[Identifier, Review]


class VerificationsFile(DocumentModel):
    """The file ``verifications.yaml``, written by ``rgss verify``."""

    verifications: dict[Identifier, VerificationRecord]
