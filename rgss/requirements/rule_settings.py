"""Configuration of rules by a project."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.findings import Severity


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleSetting:
    """Configuration of one rule.

    Attributes:
        rule: Id of the rule, such as ``wording.R19``.
        severity: Severity of a violation; None for the rule's own.
        enabled: The rule is applied at all.
        terms_added: Terms that the rule looks for beside its own.
        terms_removed: Terms of its own that the rule passes over.
        reason: Why the project departs from the rule.
    """

    rule: str
    severity: Severity | None
    enabled: bool
    terms_added: tuple[str, ...]
    terms_removed: tuple[str, ...]
    reason: str
