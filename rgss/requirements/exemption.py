"""Exemptions of elements from rules, with their reasons."""

from __future__ import annotations

from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, Text


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Exemption:
    """Exemption of an element from a rule."""

    rule: Identifier
    reason: Text
