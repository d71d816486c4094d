"""Rule against duplicate requirements."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.model import TraceModel
from rgss.trace.rules.rule import ModelRule, Violation

_PUNCTUATION = ".,;:!?()\"'“”"


def _repeated(model: TraceModel) -> Iterator[Violation]:
    first: dict[tuple[str, ...], str] = {}
    for element in model.asked_for:
        words = tuple(word.strip(_PUNCTUATION) for word in element.text.casefold().split())
        before = first.setdefault(words, element.id)
        if before != element.id:
            message = f"{element.id!r} says the same as {before!r}"
            yield Violation(subject=element.id, message=message, hint="keep one, or say how they differ", at=("text",))


RULES: tuple[ModelRule, ...] = (
    ModelRule(
        id="wording.duplicate",
        severity=Severity.ERROR,
        explanation=(
            "No two requirements have the same words: of two that say the same, one is changed one day and the "
            "other is not. Capitals, punctuation and line breaks make no difference."
        ),
        check=_repeated,
    ),
)
