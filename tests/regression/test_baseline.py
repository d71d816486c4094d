"""The baseline's file: what is written is read back, and what is damaged is told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.errors import EvidenceError
from rgss.regression import baseline as baseline_module
from rgss.regression.baseline import Change, baseline_to_text, read_baseline


@pytest.fixture
def file(tmp_path, baseline):
    path = tmp_path / "b.json"
    path.write_text(baseline_to_text(baseline), encoding="ascii")
    return path


@pytest.fixture
def refusal(file):
    """What is said of the file with a change."""

    def tell(change):
        document = json.loads(file.read_text(encoding="ascii"))
        change(document)
        file.write_text(json.dumps(document), encoding="utf-8")
        with pytest.raises(EvidenceError) as caught:
            read_baseline(file, label="b.json")
        return str(caught.value)

    return tell


def test_it_is_read_back_bit_for_bit(file, baseline):
    assert read_baseline(file, label="b.json") == baseline


def test_a_change_of_one_value_is_a_change_of_one_line(baseline):
    run = baseline.runs["planning"]
    values = {**run.values, "success": {"trial": {**run.values["success"]["trial"], "9": (0.0, 0.0, 1.0)}}}
    other = replace(baseline, runs={"planning": replace(run, values=values)})
    before, after = (baseline_to_text(one).splitlines() for one in (baseline, other))
    assert len(before) == len(after)
    assert [line for line, old in zip(after, before, strict=True) if line != old] == [
        '            "9": [0.0, 0.0, 1.0],'
    ]


def test_its_parts_are_sorted_and_variants_by_number(baseline):
    text = baseline_to_text(baseline)
    assert text.index('"9": [1.0, 0.30000000000000004, null]') < text.index('"10": [2.0, 1e-09, 3.0]')
    document = json.loads(text)
    assert list(document) == sorted(document)
    assert document["history"] == [{"reason": "First.", "revision": "abc"}]
    shuffled = replace(baseline, units=dict(reversed(baseline.units.items())))
    assert baseline_to_text(shuffled) == text


def test_a_reason_is_text_whatever_it_holds(tmp_path, baseline):
    reason = 'quote " <b> \u2028 𝔘 | `x`'
    path = tmp_path / "b.json"
    path.write_text(baseline_to_text(replace(baseline, history=(Change(reason=reason, revision=""),))), "ascii")
    assert read_baseline(path, label="b").history[0].reason == reason


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "there is no baseline b.json (make it with 'rgss regress --update --reason TEXT')"),
        (b"", "the baseline b.json is not JSON: "),
        (b"\xff", "the baseline b.json is not UTF-8 (make it"),
        (b"[]", "b.json is not a baseline: it has no 'schema' (make it"),
        (b'{"schema": 6}', "the baseline b.json has schema 6; 2, 3, 4 and 5 are read (make it"),
        (b'{"schema": 1}', "the baseline b.json has schema 1; 2, 3, 4 and 5 are read (make it"),
        (b'{"schema": 5}', "b.json: baseline lacks 'study' (make it"),
        (b'{"schema": 4}', "b.json: baseline lacks 'study' (make it"),
        (b'{"schema": 2}', "b.json: baseline lacks 'study' (make it"),
        (b'{"schema": 2, "runs": 5, "origin": []}', "b.json: baseline lacks 'study' (make it"),
        (b'{"schema": 1, "schema": 1}', "the baseline b.json is not JSON: a key occurs twice"),
    ],
)
def test_a_file_that_is_none(tmp_path, content, message):
    path = tmp_path / "b.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(EvidenceError) as caught:
        read_baseline(path, label="b.json")
    assert str(caught.value).startswith(message)


def test_one_of_the_schema_before_is_read_without_values_of_inputs(file, baseline):
    document = json.loads(file.read_text("ascii"))
    for part in (document, *document["runs"].values()):
        del part["inputs"]
    del document["origin"]["modules"], document["origin"]["constants"], document["phase_record"]
    document["schema"] = 2
    file.write_text(json.dumps(document), "ascii")
    found = read_baseline(file, label="b")
    assert not found.has_values
    assert baseline.has_values
    assert found.runs["planning"].fingerprints == baseline.runs["planning"].fingerprints
    assert found.inputs_of("planning", 9) == {}


def test_one_of_schema_3_is_read_without_the_metrics_of_phases(file, baseline):
    document = json.loads(file.read_text("ascii"))
    del document["phase_record"]
    document["schema"] = 3
    file.write_text(json.dumps(document), "ascii")
    found = read_baseline(file, label="b")
    assert found.has_values
    assert found == replace(baseline, schema=3, phase_record={})


def test_one_of_schema_4_is_read_without_levels_and_first_look(file, baseline):
    document = json.loads(file.read_text("ascii"))
    for run in document["runs"].values():
        del run["designs"], run["first_look"]
    document["schema"] = 4
    file.write_text(json.dumps(document), "ascii")
    runs = {name: replace(run, first_look=0) for name, run in baseline.runs.items()}
    assert read_baseline(file, label="b") == replace(baseline, schema=4, runs=runs)


@pytest.mark.parametrize("first_look", [-1, 0, 4])
def test_a_first_look_of_no_seeds_or_of_more_than_there_are(refusal, first_look):
    def change(document):
        document["runs"]["planning"]["first_look"] = first_look

    assert f"run planning takes {first_look} of 3 seeds at the first look" in refusal(change)


@pytest.mark.parametrize("history", [[], [{"reason": " ", "revision": ""}]])
def test_a_history_without_a_reason(refusal, history):
    assert "its history has no reason" in refusal(lambda document: document.update(history=history))


def test_every_schema_that_is_read_is_on_the_page():
    page = (Path(__file__).parents[2] / "docs" / "regression.md").read_text("utf-8")
    *others, last = map(str, baseline_module.EARLIER_SCHEMAS)
    assert f"Baselines of schemas {', '.join(others)} and {last} can still be compared" in " ".join(page.split())
    assert f"A JSON text of schema {baseline_module.SCHEMA}, sorted" in page


def test_a_byte_order_mark_is_no_part_of_it(file, baseline):
    file.write_bytes(b"\xef\xbb\xbf" + file.read_bytes())
    assert read_baseline(file, label="b") == baseline


def test_a_folder_and_a_name_that_no_file_can_have(tmp_path):
    for path, said in ((tmp_path, "Is a directory"), (tmp_path / "a\0b", "not the name of a file")):
        with pytest.raises(EvidenceError, match=f"the baseline b cannot be read: {said}"):
            read_baseline(path, label="b")


def test_a_file_that_is_too_large(file, monkeypatch):
    monkeypatch.setattr(baseline_module, "LARGEST_FILE_BYTES", 100)
    with pytest.raises(EvidenceError, match=r"the baseline b.json is larger than 0 MiB"):
        read_baseline(file, label="b.json")


def test_a_row_with_too_few_values(refusal):
    said = refusal(lambda document: document["runs"]["planning"]["values"]["time_s"]["lift"]["9"].pop())
    assert said.startswith("the baseline b.json: run planning has 3 seeds, but not for time_s at lift of 9 (make it")


def test_too_few_fingerprints(refusal):
    said = refusal(lambda document: document["runs"]["planning"]["fingerprints"]["10"].pop())
    assert said.startswith("the baseline b.json: run planning has 3 seeds, but not for the fingerprints of 10")


def test_other_variants_in_a_row(refusal):
    said = refusal(lambda document: document["runs"]["planning"]["values"]["time_s"]["lift"].pop("9"))
    assert said.startswith("the baseline b.json: run planning has other variants for time_s at lift")


def test_a_variant_that_is_no_number(refusal):
    def change(document):
        prints = document["runs"]["planning"]["fingerprints"]
        prints["nine"] = prints.pop("9")

    assert refusal(change).startswith("the baseline b.json: run planning has the variant 'nine'")


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda decision: decision["verdicts"].clear(), "lacks the verdicts of variant 9"),
        (lambda decision: decision["verdicts"].pop("10"), "lacks the verdicts of variant 10"),
        (lambda decision: decision["verdicts"]["9"].clear(), "lacks SYS-1 among the verdicts of variant 9"),
        (lambda decision: decision["measures"].pop("9"), "lacks the measures of variant 9"),
        (
            lambda decision: decision["verdicts"].update({"11": {}}),
            "has verdicts of variant 11, which run planning does not try",
        ),
        (lambda decision: decision.update(run="lost"), "is that of run lost, which it lacks"),
    ],
)
def test_a_decision_of_which_a_part_is_missing(refusal, change, problem):
    """As after a merge of two files: what is missing would not be compared."""
    said = refusal(lambda document: change(document["decision"]))
    assert said.startswith(f"the baseline b.json: the decision {problem} (make it")


def test_a_variant_whose_number_is_no_number_of_ascii(refusal):
    def change(document):
        prints = document["runs"]["planning"]["fingerprints"]
        prints["²"] = prints.pop("9")

    assert refusal(change).startswith("the baseline b.json: run planning has the variant '²'")


def test_a_value_that_is_a_text(refusal):
    def change(document):
        document["runs"]["planning"]["values"]["time_s"]["lift"]["9"][0] = "1"

    assert refusal(change).startswith("b.json: baseline.runs.planning.values.time_s.lift.9[0] ")
