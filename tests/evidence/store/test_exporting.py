"""Trials as tables in files: other programs read back the same numbers."""

import csv
import math
import os
import sys
from dataclasses import replace

import pandas as pd
import pytest

from rgss.errors import EvidenceError
from rgss.evidence import (
    EvidenceStore,
    Failure,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    Provenance,
    StoredTrial,
    record_digest,
)
from rgss.evidence.store.exporting import export_trials, require_exportable
from rgss.evidence.store.trial_table import trial_frame
from tests.fixtures.eight_states import Phase

AWKWARD = (0.1 + 0.2, 1e-308, 5e-324, 1.7976931348623157e308, -0.0, 1 / 3, 2**53, -123456789.123456789)


def stored(number, record, provenance):
    return StoredTrial(key=f"{number:064x}", content_digest=record_digest(record), record=record, provenance=provenance)


@pytest.fixture
def trials(record, provenance):
    """Trials that succeed and fail, that know some metrics and not others."""
    provenance = replace(
        provenance, files={"scenes/restaurant.yaml": "c" * 64}, revision="d" * 40, machine="Linux, x86_64"
    )
    lifted = PhaseRecord(
        phase=Phase.LIFT,
        outcome=PhaseOutcome.COMPLETED,
        duration_s=0.5,
        metrics={"slip_m": 1e-4 / 3, "loads_n": (1, 2)},
    )
    planned = PlanningRecord(
        subtask=Phase.MOVE_TO_GRASP,
        outcome=PlanOutcome.SOLVED,
        checks=531,
        simplification_checks=0,
        time_s=0.13275,
        path_length_m=0.15023797007832074,
    )
    metrics = [
        {"success": 1, "slip_m": value, "planning_time_s": (value, 1, None, 0.1, 2), "force_n": None}
        for value in AWKWARD
    ]
    return [
        stored(
            number,
            record(
                variant=number,
                seed=2**31 - 1,
                success=number % 2 == 0,
                failure=None if number % 2 == 0 else Failure.OBJECT_DROPPED,
                failed_phase=None if number % 2 == 0 else Phase.LIFT,
                failure_detail="" if number % 2 == 0 else 'slipped 31 mm, "far"\nand more',
                metrics=metrics[number],
                phases=(lifted,),
                planning=(planned,),
            ),
            provenance,
        )
        for number in range(len(AWKWARD))
    ]


def test_the_columns_and_their_order(trials):
    assert list(trial_frame(trials).columns) == [
        "key",
        "content_digest",
        "variant",
        "seed",
        "fidelity",
        "success",
        "failure",
        "failed_phase",
        "failure_detail",
        "force_n",
        "item_1_planning_time_s",
        "item_2_planning_time_s",
        "item_3_planning_time_s",
        "item_4_planning_time_s",
        "item_5_planning_time_s",
        "slip_m",
        "lift_outcome",
        "lift_duration_s",
        "lift_item_1_loads_n",
        "lift_item_2_loads_n",
        "lift_slip_m",
        "planning_1_outcome",
        "planning_1_checks",
        "planning_1_simplification_checks",
        "planning_1_time_s",
        "planning_1_path_length_m",
        "input_execution",
        "input_plan",
        "input_timing",
        "input_variant",
        "version_pybullet",
        "version_rgss",
        "file_scenes/restaurant.yaml",
        "inputs_digest",
        "revision",
        "machine",
    ]


def same_number(one, other):
    return one == other and math.copysign(1, one) == math.copysign(1, other)


def test_parquet_gives_back_the_same_values(trials, tmp_path):
    target = tmp_path / "trials.parquet"
    assert export_trials(trials, target) == len(AWKWARD)
    table = pd.read_parquet(target)
    assert len(table) == len(AWKWARD)
    for row, trial in zip(table.to_dict("records"), trials, strict=True):
        record = trial.record
        assert (row["key"], row["content_digest"]) == (trial.key, trial.content_digest)
        assert (row["variant"], row["seed"], row["fidelity"]) == (record.variant, record.seed, "contact")
        assert row["success"] is record.success
        assert pd.isna(row["failure"]) if record.failure is None else row["failure"] == "object_dropped"
        assert pd.isna(row["failed_phase"]) if record.failure is None else row["failed_phase"] == "lift"
        assert row["failure_detail"] == record.failure_detail
        assert same_number(row["slip_m"], record.metrics["slip_m"])
        assert same_number(row["item_1_planning_time_s"], record.metrics["planning_time_s"][0])
        assert (row["item_2_planning_time_s"], row["item_4_planning_time_s"]) == (1.0, 0.1)
        assert math.isnan(row["item_3_planning_time_s"])
        assert math.isnan(row["force_n"])
        assert (row["lift_outcome"], row["lift_duration_s"], row["lift_slip_m"]) == ("completed", 0.5, 1e-4 / 3)
        assert (row["planning_1_outcome"], row["planning_1_checks"]) == ("solved", 531)
        assert (row["input_plan"], row["version_rgss"]) == ("0" * 64, "0.1.0")
        assert (row["file_scenes/restaurant.yaml"], row["revision"]) == ("c" * 64, "d" * 40)
    kinds = {name: str(kind) for name, kind in table.dtypes.items()}
    assert kinds["slip_m"] == kinds["force_n"] == "float64"
    assert (kinds["variant"], kinds["success"]) == ("Int64", "boolean")


def test_csv_gives_back_the_same_values(trials, tmp_path):
    target = tmp_path / "trials.csv"
    assert export_trials(trials, target) == len(AWKWARD)
    with target.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(AWKWARD)
    for row, trial in zip(rows, trials, strict=True):
        record = trial.record
        assert row["key"] == trial.key
        assert int(row["variant"]) == record.variant
        assert row["success"] == str(record.success)
        assert row["failure"] == ("" if record.failure is None else "object_dropped")
        assert row["failure_detail"] == record.failure_detail
        assert same_number(float(row["slip_m"]), record.metrics["slip_m"])
        assert (row["item_3_planning_time_s"], row["force_n"]) == ("", "")
        assert float(row["planning_1_path_length_m"]) == 0.15023797007832074
    again = pd.read_csv(target)
    assert again["slip_m"].tolist() == pytest.approx(list(AWKWARD), rel=1e-15)
    assert again["variant"].tolist() == list(range(len(AWKWARD)))


def test_the_same_trials_give_the_same_bytes(trials, tmp_path):
    for ending in ("csv", "parquet"):
        files = [tmp_path / f"{name}.{ending}" for name in ("a", "b")]
        for file in files:
            export_trials(iter(trials), file)
        assert files[0].read_bytes() == files[1].read_bytes()


def test_no_trials_give_a_table_with_a_head_and_no_rows(tmp_path):
    for ending, read in (("csv", pd.read_csv), ("parquet", pd.read_parquet)):
        target = tmp_path / f"trials.{ending}"
        assert export_trials([], target) == 0
        table = read(target)
        assert len(table) == 0
        assert list(table.columns)[:4] == ["key", "content_digest", "variant", "seed"]


def test_what_only_some_trials_know_is_missing_in_the_others(record, provenance):
    frame = trial_frame(
        [
            stored(1, record(metrics={"early_m": 1.5}, phases=()), provenance),
            stored(2, record(metrics={"late_m": 2.5}, phases=()), replace(provenance, versions={})),
        ]
    )
    assert frame["early_m"].tolist()[0] == 1.5
    assert math.isnan(frame["early_m"].tolist()[1])
    assert frame["late_m"].tolist()[1] == 2.5
    assert frame["version_rgss"].isna().tolist() == [False, True]


@pytest.mark.parametrize(
    "text",
    ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1", "\n=1", "＝1", "＋1", "－1", "＠x", "=cmd|' /C calc'!A0"],
)
def test_no_cell_of_a_csv_file_is_a_formula(text, record, provenance, tmp_path):
    trial = stored(
        1,
        record(failure_detail=text, metrics={text: -1.5}, phases=()),
        replace(provenance, machine=text, versions={text: text}),
    )
    export_trials([trial], tmp_path / "trials.csv")
    with (tmp_path / "trials.csv").open(encoding="utf-8", newline="") as file:
        head, row = csv.reader(file)
    cells = dict(zip(head, row, strict=True))
    assert cells["failure_detail"] == cells["machine"] == cells[f"version_{text}"] == f"'{text}"
    # A number is a number, also where it is negative.
    assert cells[f"'{text}"] == "-1.5"
    assert not any(cell.startswith(("=", "+", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")) for cell in [*head, *row])
    export_trials([trial], tmp_path / "trials.parquet")
    assert pd.read_parquet(tmp_path / "trials.parquet")["machine"].tolist() == [text]


def test_a_text_that_is_half_a_character_is_marked(record, provenance, tmp_path):
    trial = stored(1, record(failure_detail="a\ud800b", phases=()), provenance)
    for ending, read in (("csv", pd.read_csv), ("parquet", pd.read_parquet)):
        export_trials([trial], tmp_path / f"trials.{ending}")
        assert read(tmp_path / f"trials.{ending}")["failure_detail"].tolist() == ["a?b"]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"metrics": {"n": 2**53 + 1}}, "'n' has a value that no column of floats can hold: 9007199254740993"),
        ({"metrics": {"n": 10**400}}, "'n' has a value that no column of floats can hold: 1000000"),
        ({"metrics": {"n": (1, -(10**400))}}, "'n' has a value that no column of floats can hold: -100000"),
        ({"variant": 2**63}, "'variant' has a value that no column of integers can hold: 9223372036854775808"),
        ({"metrics": {"key": 1.0}}, "two columns of the table would have the name 'key'"),
        ({"metrics": {"item_1_n": 1.0, "n": (2.0,)}}, "two columns of the table would have the name 'item_1_n'"),
        (
            {"metrics": {f"metric_{number}": 1.0 for number in range(2000)}},
            "the number of columns must be at most 2000",
        ),
    ],
)
def test_what_no_table_can_hold_is_refused(record, provenance, tmp_path, changes, message):
    with pytest.raises(EvidenceError) as caught:
        export_trials([stored(1, record(**changes), provenance)], tmp_path / "trials.csv")
    assert str(caught.value).startswith(message)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["trials", "trials.xlsx", "trials.csv.gz", ".csv"])
def test_another_ending_is_refused(tmp_path, name):
    with pytest.raises(EvidenceError) as caught:
        require_exportable(tmp_path / name)
    assert str(caught.value) == (f"{tmp_path / name} must end in .parquet or .csv (the suffix selects the format)")


def test_parquet_without_its_library_is_told_in_one_line(tmp_path, monkeypatch, trials):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(EvidenceError) as caught:
        export_trials(trials, tmp_path / "trials.parquet")
    assert str(caught.value) == (
        "a Parquet file needs pyarrow, which is not installed (pip install 'rgss[parquet]', or name a .csv file)"
    )


def test_a_folder_that_is_not_there_is_named(tmp_path, trials):
    target = tmp_path / "nowhere" / "trials.csv"
    for path in (target, target.with_suffix(".parquet")):
        with pytest.raises(EvidenceError) as caught:
            export_trials(trials, path)
        assert str(caught.value) == f"{path} cannot be written: No such file or directory"


def test_a_folder_is_not_replaced(tmp_path, trials):
    target = tmp_path / "trials.csv"
    target.mkdir()
    with pytest.raises(EvidenceError, match=r"trials\.csv cannot be written: Is a directory"):
        export_trials(trials, target)
    assert os.listdir(tmp_path) == ["trials.csv"]  # noqa: PTH208


def test_a_file_that_was_there_is_replaced(tmp_path, trials):
    target = tmp_path / "trials.csv"
    target.write_text("old", encoding="utf-8")
    export_trials(trials[:1], target)
    assert target.read_text(encoding="utf-8").startswith("key,content_digest,")


def test_what_is_damaged_leaves_no_file(filled, change, key, tmp_path):
    change(filled, "UPDATE trials SET record = x'00' WHERE key = ?", key(2))
    with EvidenceStore.open(filled) as store, pytest.raises(EvidenceError, match="is damaged"):
        export_trials(store.iterate(), tmp_path / "trials.csv")
    assert not (tmp_path / "trials.csv").exists()


def test_the_provenance_of_schema_1_has_nothing_in_its_newer_columns(record):
    frame = trial_frame([stored(1, record(), Provenance(inputs={}, versions={}))])
    assert frame[["inputs_digest", "revision", "machine"]].isna().all().all()
