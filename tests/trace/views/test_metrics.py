"""Coverage metrics, against counts made by hand."""

from __future__ import annotations

import pytest

from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.views.metrics import CoverageMetric, coverage_metrics, trace_matrices


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


def metrics_of(model, evidence):
    return {metric.id: metric for metric in coverage_metrics(model, trace_matrices(model), evidence)}


@pytest.mark.parametrize(
    ("metric", "covered", "missing"),
    [
        ("needs-derived", 2, ()),
        ("needs-measured", 2, ()),
        ("moes-computed", 2, ()),
        ("system-derived", 3, ("SYS-4",)),
        ("system-allocated", 2, ("SYS-3", "SYS-4")),
        ("elements-satisfying", 3, ("BLK-system", "BLK-hook", "UC-serve")),
        ("system-method", 3, ("SYS-4",)),
        ("system-success", 3, ("SYS-4",)),
        ("system-facility", 1, ("SYS-2", "SYS-3", "SYS-4")),
        ("system-phase", 1, ("SYS-2", "SYS-3", "SYS-4")),
        ("system-evidence", 2, ("SYS-3", "SYS-4")),
        ("system-met", 2, ("SYS-3", "SYS-4")),
    ],
)
def test_what_is_covered_and_what_is_missing(model, metric, covered, missing, story):
    found = metrics_of(model, story.evidence())[metric]

    assert (found.covered, found.missing, found.total) == (covered, missing, covered + len(missing))


def test_every_metric_is_tested():
    (marks,) = test_what_is_covered_and_what_is_missing.pytestmark
    tested = {arguments[0] for arguments in marks.args[1]}

    assert len(tested) == 12


def test_idle_elements_are_allowed(model, story):
    required = {name: metric.required for name, metric in metrics_of(model, story.evidence()).items()}

    assert [name for name, wanted in required.items() if not wanted] == [
        "elements-satisfying",
        "system-facility",
        "system-phase",
    ]


def test_without_evidence_nothing_is_met(model):
    metrics = metrics_of(model, TraceEvidence())

    assert metrics["system-evidence"].covered == metrics["system-met"].covered == 0


def test_a_share_of_nothing_is_whole():
    empty = CoverageMetric(id="m", title="t", lack="l", covered=0, missing=())
    half = CoverageMetric(id="m", title="t", lack="l", covered=1, missing=("a",))

    assert (empty.share, half.share) == (1.0, 0.5)
