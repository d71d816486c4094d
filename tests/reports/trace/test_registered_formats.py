"""Every registered format of `rgss trace`: what it must bring, in whole, in part, of a chain and of an impact."""

from __future__ import annotations

import pytest

from rgss.reports.trace.files import trace_files
from rgss.reports.trace.formats import TRACE_FORMATS
from rgss.reports.trace.report import trace_report
from rgss.trace.views.chain import chain_of
from rgss.trace.views.impact import impact_of


@pytest.fixture
def report(tmp_path, story):
    model = story.model(story.write(tmp_path / "requirements"))
    return trace_report(model, story.evidence(), title="Traceability")


def named(one):
    return one.name


def test_names_and_endings_are_told_apart():
    assert len({one.name for one in TRACE_FORMATS}) == len({one.suffix for one in TRACE_FORMATS}) == len(TRACE_FORMATS)


@pytest.mark.parametrize("one", TRACE_FORMATS, ids=named)
def test_a_report_names_every_requirement_and_is_the_same_every_time(report, one):
    files = trace_files(report, None, one.name)
    texts = "".join(content.decode("utf-8") for content in files.values()) if one.is_printable else ""

    assert files == trace_files(report, None, one.name)
    assert all(name.endswith(one.suffix) and content for name, content in files.items())
    assert not one.is_printable or all(each.id in texts for each in report.model.requirements.system)


@pytest.mark.parametrize("one", TRACE_FORMATS, ids=named)
@pytest.mark.parametrize("find", [chain_of, impact_of])
def test_a_chain_and_an_impact_are_one_file(report, one, find):
    found = find(report.model, report.evidence, "SYS-1")
    ((name, content),) = trace_files(report, found, one.name).items()

    assert name.endswith(one.suffix)
    assert not one.is_printable or "SYS-1" in content.decode("utf-8")


@pytest.mark.parametrize("one", [one for one in TRACE_FORMATS if one.has_tables], ids=named)
def test_one_table_alone(report, one):
    (content,) = trace_files(report, None, one.name, table="coverage").values()

    assert content
    assert content != b"".join(trace_files(report, None, one.name).values())
