"""Exemptions of elements from rules, with their reasons."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Exemption:
    """Exemption of one element from one rule.

    Attributes:
        rule: Id of the rule, such as ``wording.R7``.
        reason: Why it may be broken here.
    """

    rule: str
    reason: str
