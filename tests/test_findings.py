"""Findings: how they read, how they sort, and how values are shown in them."""

from __future__ import annotations

import itertools
import random

import pytest

from rgss.findings import Finding, Severity, shown


def finding(file="a.yaml", line=1, column=1, rule="a.b", severity=Severity.ERROR, message="bad", hint=""):
    return Finding(file=file, line=line, column=column, rule=rule, severity=severity, message=message, hint=hint)


def test_text():
    assert str(finding()) == "a.yaml:1:1: error: bad [a.b]"
    assert str(finding(hint="mend it", severity=Severity.WARNING)) == "a.yaml:1:1: warning: bad (mend it) [a.b]"
    assert str(finding(severity=Severity.INFO)) == "a.yaml:1:1: info: bad [a.b]"


def test_order_is_by_file_then_place_then_rule():
    ordered = [
        finding(file="a.yaml", line=2, column=9, rule="z"),
        finding(file="a.yaml", line=10, column=1, rule="z"),
        finding(file="a.yaml", line=10, column=2, rule="a", message="a"),
        finding(file="a.yaml", line=10, column=2, rule="a", message="b"),
        finding(file="a.yaml", line=10, column=2, rule="b", message="a"),
        finding(file="b.yaml", line=1, column=1),
    ]

    for seed in range(20):
        shuffled = random.Random(seed).sample(ordered, len(ordered))  # noqa: S311
        assert sorted(shuffled) == ordered


def test_every_pair_can_be_compared():
    findings = [finding(severity=severity, hint=hint) for severity in Severity for hint in ("", "x")]

    for one, other in itertools.combinations(findings, 2):
        assert (one < other) != (other < one)


def test_equal_findings_are_one_in_a_set():
    assert len({finding(), finding(), finding(line=2)}) == 2


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("mm", "'mm'"),
        ("a\nb", "'a\\nb'"),
        (3, "3"),
        (None, "None"),
        ("x" * 60, f"'{'x' * 60}'"),
        ("x" * 61, f"'{'x' * 59}…'"),
        ([1] * 100, f"[{'1, ' * 19}1…"),
    ],
)
def test_shown(value, text):
    assert shown(value) == text


def test_a_file_name_does_not_steer_the_terminal():
    hostile = "\x1b[2Ja\u202eb"
    found = Finding(file=hostile, line=1, column=2, rule="r.r", severity=Severity.ERROR, message=hostile, hint=hostile)

    assert str(found).isprintable()
    assert str(found) == "�[2Ja�b:1:2: error: �[2Ja�b (�[2Ja�b) [r.r]"
    assert found.file == hostile
