"""The JSON of traceability keeps its schema, and says what the links say."""

from __future__ import annotations

import json

import jsonschema
import pytest

from rgss.measures import StaleCause
from rgss.reports.trace.json_document import json_schema
from rgss.reports.trace.report import trace_report
from rgss.trace.evidence.verdict_evidence import TraceEvidence
from rgss.trace.views.chain import chain_of
from rgss.trace.views.impact import impact_of

from .one_file import only_file


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


@pytest.fixture(scope="module")
def validator():
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def report_of(model, evidence, **options):
    return json.loads(only_file(trace_report(model, evidence, title="T"), None, "json", **options))


def test_every_document_keeps_the_schema(model, story, validator):
    evidence = story.evidence()
    report = trace_report(model, evidence, title="T")
    documents = [
        report_of(model, evidence),
        report_of(model, evidence, gaps_only=True),
        report_of(model, TraceEvidence()),
        report_of(model, story.evidence(shown=False)),
        report_of(model, story.evidence(causes=(StaleCause.MODEL,))),
        *(json.loads(only_file(report, chain_of(model, evidence, name), "json")) for name in ("SYS-1", "7/1", "P")),
        *(json.loads(only_file(report, impact_of(model, evidence, name), "json")) for name in ("STK-1", "P_g")),
        json.loads(only_file(report, impact_of(model, story.evidence(shown=False), "SYS-1"), "json")),
    ]

    for document in documents:
        validator.validate(document)
    assert {document["schema"] for document in documents} == {"rgss-trace-1"}


def test_the_schema_refuses_what_is_not_in_it(model, story, validator):
    document = report_of(model, story.evidence())
    document["verification"][0]["verdict"] = "perhaps"

    assert not validator.is_valid(document)


def test_the_links_are_those_of_the_files(model, story):
    matrices = {matrix["name"]: matrix for matrix in report_of(model, story.evidence())["matrices"]}

    assert matrices["stakeholder-moe"]["linked"] == {"STK-1": ["P"], "STK-2": ["C"]}
    assert matrices["system-stakeholder"]["linked"] == {
        "SYS-1": ["STK-1"],
        "SYS-2": ["STK-1"],
        "SYS-3": ["STK-2"],
        "SYS-4": [],
    }
    assert matrices["system-architecture"]["linked"]["SYS-1"] == ["BLK-gripper", "ACT-lift"]
    assert matrices["system-architecture"]["empty_rows"] == ["SYS-3", "SYS-4"]


def test_evidence_is_named_by_key_and_by_test(model, story):
    document = report_of(model, story.evidence())
    row = document["verification"][0]

    assert row["trials"] == [story.KEYS[1], story.KEYS[2]]
    assert row["measured"] == {"value": 0.865, "unit": "kg", "low": 0.86, "high": 0.87, "n": 2}
    assert row["variants"] == {"met": 2, "not_met": 1}
    assert document["evidence"]["trials"][2]["values"]["P"] is None
    assert document["verification"][1]["tests"] == [{"id": story.TESTS["SYS-2"][0], "end": "passed"}]
    assert document["verification"][2]["tests"][0]["end"] is None


def test_gaps_only(model, story):
    document = report_of(model, story.evidence(), gaps_only=True)

    assert (document["gaps_only"], document["matrices"]) == (True, [])
    assert [row["requirement"] for row in document["verification"]] == ["SYS-3", "SYS-4"]
    assert document["gaps"][1] == {
        "id": "SYS-3",
        "lacks": ["no allocation", "no evidence that holds now"],
        "metrics": ["system-allocated", "system-evidence", "system-met"],
    }
