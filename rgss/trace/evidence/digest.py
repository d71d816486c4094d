"""Digest of the verified content of a requirement, by which its evidence is dated."""

from __future__ import annotations

from rgss.documents import digest
from rgss.requirements import Requirement


def verification_digest(requirement: Requirement) -> str:
    """SHA-256 of the verified content: sentence, verification method and criterion.

    Evidence is older than a requirement if this has changed since. A new owner, rationale,
    priority or parent does not make the evidence stale.
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
