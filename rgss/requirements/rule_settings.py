"""How a project wants a rule to be applied."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.findings import Severity


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleSetting:
    """One rule as a project wants it.

    Attributes:
        rule: Id of the rule, such as ``wording.R19``.
        severity: How much a breach matters; None as the rule itself says.
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
