"""Plain forms of formatted text, one rule for every format: exponents, indices and struck-out text."""

from __future__ import annotations

import re
from dataclasses import dataclass

from rgss.findings import shown

_ORDINALS = frozenset({"st", "nd", "rd", "th"})
_MARKS = frozenset("™®©°ªº*†‡")
_LOWERED = str.maketrans("0123456789+-=()aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ")
_SIMPLE = re.compile(r"[+\-\u2212]?\w+(?:\.\d+)?", re.ASCII)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlainText:
    """A formatted text without its formatting.

    Attributes:
        text: The text.
        losses: Content that is not in the text, one phrase each.
    """

    text: str
    losses: tuple[str, ...]


def shifted_text(text: str, *, raised: bool) -> str:
    """Plain form of a raised or lowered text: ``^3`` of an exponent, ``₂`` of an index.

    Args:
        text: The text, without blanks around it.
        raised: True if it is raised, false if it is lowered.
    """
    if not text or (raised and (text in _ORDINALS or set(text) <= _MARKS)):
        return text
    if not raised:
        lowered = text.translate(_LOWERED)
        return lowered if not set(text) & set(lowered) else f"_{text}" if _SIMPLE.fullmatch(text) else f"_({text})"
    plain = text.replace("\u2212", "-")
    return f"^{plain}" if _SIMPLE.fullmatch(text) else f"^({plain})"


def omitted(text: str, kind: str = "struck-out") -> str:
    """Loss of a text that is omitted since it is deleted or hidden; empty if the text is blank."""
    flat = " ".join(text.split())
    return f"the {kind} text {shown(flat)} is omitted" if flat else ""
