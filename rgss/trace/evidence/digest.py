"""The digest of what evidence for a requirement is evidence for."""

from __future__ import annotations

from rgss.documents import digest
from rgss.requirements import Requirement


def verification_digest(requirement: Requirement) -> str:
    """The SHA-256 of what is verified: the sentence, how it is verified, and what decides.

    Evidence is older than a requirement if this has changed since. A new owner, rationale,
    priority or parent is no reason to look at the evidence again.
    """
    criterion = requirement.criterion
    return digest(
        {
            "text": " ".join(requirement.text.split()),
            "verification": requirement.verification,
            "success": " ".join((requirement.success or "").split()),
            "criterion": None
            if criterion is None
            else [
                criterion.measure,
                criterion.statistic,
                criterion.comparison,
                criterion.threshold,
                criterion.unit,
            ],
        }
    )
