"""Rule of traceability: an id, a severity, an explanation and a check."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol

from rgss.findings import Finding, Severity
from rgss.requirements import Place, Requirement, StakeholderNeed
from rgss.trace.evidence import EvidenceState, MarkedTest
from rgss.trace.model import TraceModel
from rgss.trace.sentences import Sentence, TermList


class Located(Protocol):
    """Object with a place in a file, such as a measure or a test."""

    @property
    def file(self) -> str:
        """The file, relative to the project."""

    @property
    def line(self) -> int:
        """Line, from 1."""

    @property
    def column(self) -> int:
        """Column, from 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Violation:
    """Violation of a rule at one place.

    Attributes:
        subject: The element of the requirements, by its id; or a place in a file.
        message: The problem, in one line.
        hint: How to resolve it, in one line; may be empty.
        at: The part of the element or place to point at; what is `Located` is pointed at as a whole.
        at_key: True to point at the key instead of its value.
    """

    subject: str | Place | Located
    message: str
    hint: str = ""
    at: tuple[str | int, ...] = ("id",)
    at_key: bool = False

    def finding(self, model: TraceModel, rule: str, severity: Severity) -> Finding:
        """The violation as a finding in the user's files."""
        subject = model.requirements.places[self.subject] if isinstance(self.subject, str) else self.subject
        if isinstance(subject, Place):
            return subject.finding(
                rule, self.message, at=self.at, hint=self.hint, severity=severity, at_key=self.at_key
            )
        return Finding(
            file=subject.file,
            line=subject.line,
            column=subject.column,
            rule=rule,
            severity=severity,
            message=self.message,
            hint=self.hint,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """Rule, with its explanation and configuration.

    Attributes:
        id: Its id, such as ``trace.orphan`` or ``wording.R7``.
        severity: Severity of a violation, unless the project sets another.
        explanation: Requirement and rationale.
        fixed: True if a violation makes the project undecidable, so that it cannot be configured or exempted.
        of_elements: True if its violations are of elements of the requirements, which may be exempt, and not of
        measures, tests or settings.
    """

    id: str
    severity: Severity
    explanation: str
    fixed: bool = False
    of_elements: bool = True

    @property
    def allows_exemption(self) -> bool:
        """True if an element may be exempt from it."""
        return self.of_elements and not self.fixed


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadingRule(Rule):
    """A rule that is checked while the files are read, listed here to be explained."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRule(Rule):
    """A rule of the requirements, the architecture, the measures, and the links between them."""

    check: Callable[[TraceModel], Iterator[Violation]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Flaw:
    """Violation of a rule by a sentence.

    Attributes:
        message: It, in words that follow the id of the element.
        hint: How to resolve it.
    """

    message: str
    hint: str


Worded = StakeholderNeed | Requirement
"""An element that is worded as a sentence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SentenceRule(Rule):
    """Wording rule for needs and requirements.

    Attributes:
        find: Finder of the violations in the sentence of an element, given the rule's terms.
        terms: Words and phrases that violate the rule, or excuse a violation; a project may add and remove terms.
        meaning: Description of the terms; empty if there are none.
        widened_by: Built-in terms that apply only in some places; added by a project they apply everywhere.
        breaking: Sentences that violate the rule; the first violates no other rule.
        passing: Similar sentences that violate no wording rule, except possibly `wording.ears-keyword`.
    """

    find: Callable[[Sentence, TermList, Worded], Iterator[Flaw]]
    terms: tuple[str, ...] = ()
    meaning: str = ""
    widened_by: tuple[str, ...] = ()
    breaking: tuple[str, ...]
    passing: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvidenceRule(Rule):
    """A rule of the evidence; it is checked with `rgss check --evidence`."""

    check: Callable[[TraceModel, EvidenceState], Iterator[Violation]]


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkRule(Rule):
    """A rule of the marks on a project's own tests; it is checked where there are tests."""

    check: Callable[[TraceModel, tuple[MarkedTest, ...]], Iterator[Violation]]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigurationRule(Rule):
    """A rule of the project's settings and exemptions themselves, checked after all others."""
