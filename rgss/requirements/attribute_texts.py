"""Attributes that needs and requirements have in common, as texts."""

from __future__ import annotations

from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement


def common_attributes(element: StakeholderNeed | Requirement) -> dict[str, str]:
    """Text of each of the common attributes, by its name."""
    return {
        "rationale": element.rationale,
        "source": element.source,
        "priority": element.priority.value,
        "status": element.status.value,
        "owner": element.owner,
    }
