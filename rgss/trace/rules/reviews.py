"""Rules of reviews: the reviewed content is still the content of the files.

A review stamps the content digest of an element and of the elements that it rests on. When one of
these changes, the link to it is suspect: the dependent element must be reviewed again.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.model import TraceModel
from rgss.trace.rules.rule import ModelRule, Violation
from rgss.trace.rules.upstream import upstream_of_each


def _unreviewed(model: TraceModel) -> Iterator[Violation]:
    reviews = model.requirements.reviews
    if not reviews:
        # Without any review, one note is enough.
        for element in model.asked_for[:1]:
            message = f"none of the {len(model.asked_for)} stakeholder and system requirements has been reviewed"
            yield Violation(subject=element.id, message=message, hint="rgss check --review ID, or all")
        return
    for element in model.asked_for:
        if element.id not in reviews:
            yield Violation(
                subject=element.id, message=f"{element.id!r} has not been reviewed", hint=_again(element.id)
            )


def _changed(model: TraceModel) -> Iterator[Violation]:
    requirements = model.requirements
    for name, review in requirements.reviews.items():
        if name in requirements.places and model.content_digest(name) != review.digest:
            yield Violation(
                subject=name, message=f"{name!r} has changed since {review.reviewer} reviewed it", hint=_again(name)
            )


def _suspect(model: TraceModel) -> Iterator[Violation]:
    requirements = model.requirements
    if not requirements.reviews:
        return
    upstream = upstream_of_each(requirements)
    for name, review in requirements.reviews.items():
        for link in upstream.get(name, ()):
            if link.target not in requirements.places:
                continue
            before = review.upstream.get(link.target)
            if before is None:
                message = f"{name!r} was reviewed before it rested on {link.target!r}"
            elif before != model.content_digest(link.target):
                message = f"{name!r} was reviewed when {link.target!r} said something else"
            else:
                continue
            hint = f"read both, then {_again(name)}"
            yield Violation(subject=link.stated_by, message=message, hint=hint, at=link.at)


def _of_nothing(model: TraceModel) -> Iterator[Violation]:
    requirements = model.requirements
    for name, place in requirements.review_places.items():
        if name not in requirements.places:
            message = f"there is no element {name!r} that this would be the review of"
            hint = "the next 'rgss check --review' removes it"
            yield Violation(subject=place, message=message, hint=hint, at=(), at_key=True)


def _again(name: str) -> str:
    return f"rgss check --review {name}"


RULES: tuple[ModelRule, ...] = (
    ModelRule(
        id="review.missing",
        severity=Severity.INFO,
        explanation="Each stakeholder and system requirement has been reviewed by a person.",
        check=_unreviewed,
    ),
    ModelRule(
        id="review.changed",
        severity=Severity.WARNING,
        explanation=(
            "The content of an element is unchanged since its review. The wrapping of its text, its position, the "
            "order of its links and its exemptions do not count."
        ),
        check=_changed,
    ),
    ModelRule(
        id="review.suspect-link",
        severity=Severity.WARNING,
        explanation=(
            "The upstream elements of an element are unchanged since its review. Otherwise the link between them is "
            "suspect: the element may have to change too, which only a reader can decide."
        ),
        check=_suspect,
    ),
    ModelRule(
        id="review.unknown-id",
        of_elements=False,
        severity=Severity.WARNING,
        explanation="A review is of an element that is there.",
        check=_of_nothing,
    ),
)
