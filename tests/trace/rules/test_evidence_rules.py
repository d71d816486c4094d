"""Rules of evidence on trials: what is missing, old, or contradicts what was recorded."""

from __future__ import annotations

import pytest

from rgss.measures import StaleCause, Verdict
from rgss.trace.evidence.evidence_state import EvidenceState, TrialVerdicts

MET, NOT_MET, OPEN = Verdict.MET, Verdict.NOT_MET, Verdict.INCONCLUSIVE
NOT_RUN, STALE = Verdict.NOT_RUN, Verdict.STALE
MODEL, CODE, ENGINES, REQUIREMENT = StaleCause.MODEL, StaleCause.CODE, StaleCause.ENGINES, StaleCause.REQUIREMENT


def trials(verdicts, recorded=None, causes=None):
    return TrialVerdicts(
        requirement="SYS-1",
        verdicts=dict(enumerate(verdicts, start=1)),
        recorded=recorded or {},
        causes=causes or {},
    )


@pytest.mark.parametrize(
    ("found", "text"),
    [
        (trials([MET, NOT_MET, OPEN]), None),
        (trials([NOT_RUN] * 3), "warning: 'SYS-1' has no evidence for any of the 3 variants (rgss sweep)"),
        (trials([MET, NOT_RUN, MET]), "warning: 'SYS-1' has no evidence for 1 of 3 variants (2) (rgss sweep)"),
        (
            trials([NOT_RUN] * 8 + [MET]),
            "warning: 'SYS-1' has no evidence for 8 of 9 variants (1, 2, 3, 4, 5, 6, …) (rgss sweep)",
        ),
        (
            trials([STALE, MET], causes={1: (CODE,)}),
            "warning: 'SYS-1' has stale evidence for 1 of 2 variants (1): the code has changed since (rgss sweep, then",
        ),
        (
            trials([STALE, STALE], causes={1: (ENGINES,), 2: (ENGINES,)}),
            "warning: 'SYS-1' has stale evidence for any of the 2 variants: the engines have changed since (",
        ),
        (
            trials([STALE, STALE], causes={1: (CODE,), 2: (REQUIREMENT, MODEL)}),
            "warning: 'SYS-1' has stale evidence for any of the 2 variants: the requirement and the model and the code",
        ),
        (
            trials([NOT_MET], recorded={1: MET}),
            "error: 'SYS-1' is recorded as met by variant 1, but the evidence says not_met (see what changed, then",
        ),
        (trials([OPEN], recorded={1: MET}), "error: 'SYS-1' is recorded as met by variant 1, but the evidence"),
        (trials([MET], recorded={1: MET}), None),
        (trials([MET], recorded={2: NOT_MET}), None),
        (trials([STALE], recorded={1: MET}, causes={1: (CODE,)}), "warning: 'SYS-1' has stale evidence"),
        (trials([NOT_RUN], recorded={1: MET}), "warning: 'SYS-1' has no evidence"),
    ],
)  # fmt: skip
def test_findings_on_trials(project, found, text):
    project.evidence = EvidenceState(trials={"SYS-1": found})
    findings = project.findings()

    assert len(findings) == (text is not None)
    for finding in findings:
        assert finding.startswith(f"{project.position('system.yaml', '{measure')}: {text}")


def test_without_evidence_nothing_is_said_of_it(project):
    assert project.findings() == []


def test_evidence_that_says_nothing_of_a_requirement(project):
    project.evidence = EvidenceState()
    assert project.findings() == []


def test_causes_are_told_in_one_order():
    found = trials([STALE] * 2, causes={1: (CODE, ENGINES), 2: (REQUIREMENT,)})
    assert found.all_causes == (REQUIREMENT, CODE, ENGINES)
