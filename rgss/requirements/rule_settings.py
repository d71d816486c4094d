"""Configuration of rules by a project."""

from __future__ import annotations

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Text
from rgss.findings import Severity


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class RuleSetting:
    """Setting of one rule, in ``rules.yaml``."""

    severity: Severity | None = None
    """None for the default of the rule."""
    enabled: bool = True
    terms_added: tuple[Text, ...] = ()
    terms_removed: tuple[Text, ...] = ()
    reason: Text
