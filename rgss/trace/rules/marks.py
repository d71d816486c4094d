"""Rules of the marks that tie a project's own tests to its requirements."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import VerificationMethod, nearest
from rgss.trace.evidence import MarkedTest
from rgss.trace.model import TraceModel
from rgss.trace.rules.rule import MarkRule, Violation


def _unmarked(model: TraceModel, marked: tuple[MarkedTest, ...]) -> Iterator[Violation]:
    verified = {name for test in marked for name in test.requirements} | set(model.requirements.records)
    for requirement in model.requirements.system:
        if requirement.verification is VerificationMethod.TEST and requirement.id not in verified:
            message = f"system requirement {requirement.id!r} is verified by test, but no test is marked with it"
            hint = f'mark the tests that verify it with @pytest.mark.verifies("{requirement.id}")'
            yield Violation(subject=requirement.id, message=message, hint=hint, at=("verification",))


def _unknown(model: TraceModel, marked: tuple[MarkedTest, ...]) -> Iterator[Violation]:
    known = {requirement.id: None for requirement in model.requirements.system}
    for test in marked:
        for name in test.requirements:
            if name not in known:
                function = test.id.rsplit("::", 1)[-1]
                message = f"{function} verifies {name!r}, which is not a system requirement"
                yield Violation(subject=test, message=message, hint=nearest(name, known))


RULES: tuple[MarkRule, ...] = (
    MarkRule(
        id="trace.no-test",
        severity=Severity.ERROR,
        explanation=(
            "Where the project has tests of its own, each requirement that is verified by test has a test that is "
            "marked with it, or a verification record; a planned test that is never written verifies nothing."
        ),
        check=_unmarked,
    ),
    MarkRule(
        id="trace.unknown-mark",
        of_elements=False,
        severity=Severity.ERROR,
        explanation="A test is marked with existing system requirements.",
        check=_unknown,
    ),
)
