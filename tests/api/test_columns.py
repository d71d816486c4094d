"""Every column that a frame has is described, in one place, with its unit; the page has the same tables."""

from __future__ import annotations

import re
import runpy

import pytest

import rgss
from rgss.api.column import Kind
from rgss.api.column_reference import reference_table, with_reference_tables
from rgss.api.columns import FRAMES
from rgss.api.metric_columns import phase_metric_columns, trial_metric_columns
from rgss.errors import DefinitionError, RgssError, TradeoffError
from rgss.quantities import conversion_factor
from rgss.trials.metrics import METRICS
from tests.fixtures.shipped_project import REPOSITORY

PAGE = REPOSITORY / "docs/api.md"
WRITE = (
    'python -c "from pathlib import Path; from rgss.api.column_reference import with_reference_tables as w; '
    "p = Path('docs/api.md'); p.write_text(w(p.read_text()))\""
)
ENDINGS = {
    "_m3": "m**3",
    "_j": "J",
    "_m_s2": "m/s**2",
    "_m_s": "m/s",
    "_n_m": "N*m",
    "_kg": "kg",
    "_rad": "rad",
    "_n": "N",
    "_m": "m",
    "_s": "s",
    "_1": "1",
}


@pytest.fixture(scope="module")
def gripped(swept):
    """A trial with contact: it knows everything that a trial can know."""
    return rgss.load_study(swept).trial(4)


def described(name):
    frame = FRAMES[name]
    return re.compile("|".join(f"(?:{pattern(column.title)})" for column in (*frame.index, *frame.columns)))


def pattern(title):
    return re.sub(r"PARAMETER|FACTOR|MEASURE|QUANTITY", r".+", re.sub(r"(?<=_)N(?=_|$)", r"\\d+", re.escape(title)))


@pytest.mark.parametrize("name", [name for name in FRAMES if name not in ("course", "portfolio")])
def test_each_column_of_each_frame_is_described(study, name):
    trade = study.trade({"weight.t_e": 0.3})
    frame = getattr(study, name, None)
    if frame is None:
        frame = getattr(trade, name)
    frame = frame() if callable(frame) else frame
    known = described(name)

    # The shipped study names no stakeholders; the columns are there all the same.
    assert len(frame) or name == "stakeholders"
    assert list(frame.index.names) == [column.name for column in FRAMES[name].index]
    assert [column for column in frame.columns if not known.fullmatch(column)] == []
    for column in FRAMES[name].columns:
        if column.items is None and column.name == column.name.lower():
            assert str(frame[column.name].dtype) == column.kind.value


def test_a_row_has_a_column_for_each_planned_move(study):
    trials = study.trials

    for name in ("planning_time_s", "planning_checks", "path_length_m"):
        columns = [column for column in trials.columns if column.endswith(f"_{name}")]
        assert columns == [f"item_{number}_{name}" for number in range(1, 6)]
        assert trials[columns[0]].notna().all()


def test_what_a_trial_with_contact_knows_is_described(gripped):
    columns = {column.name: column for column in phase_metric_columns()}
    metrics = {name for phase in gripped.record.phases for name in phase.metrics}
    phases = gripped.phases

    assert gripped.success
    assert metrics <= set(columns)
    assert set(gripped.record.metrics) == set(METRICS)
    for phase in gripped.record.phases:
        row = phases.loc[4, 1, phase.phase]
        for name, value in phase.metrics.items():
            if isinstance(value, tuple):
                assert tuple(row[f"item_{number}_{name}"] for number in range(1, len(value) + 1)) == value
            elif value is not None:
                assert row[name] == value
    course = gripped.course
    assert [column for column in course.columns if not described("course").fullmatch(column)] == []
    assert course.filter(like="joint_position").shape[1] == 6
    assert course.filter(like="finger_travel").shape[1] == 2
    assert set(course["phase"]) == set(phases.index.get_level_values("phase"))
    assert course.index[-1] == pytest.approx(phases["duration_s"].sum(), abs=0.01)
    assert course.filter(regex="item_._finger_force_n").max().max() == pytest.approx(
        phases["peak_finger_force_n"].max()
    )


def test_pictures_of_a_trial_with_contact(gripped):
    assert len(gripped.figure().axes) == 4
    width, height = gripped.filmstrip(width=200, height=150).size
    assert 800 < width < 1000 < 2 * width
    assert 300 < height < 600
    with pytest.raises(DefinitionError, match="width and height must be from 16 to 2000 pixels, got 0 and 300"):
        gripped.filmstrip(width=0)


def test_there_is_nothing_to_see_without_contact(study):
    trial = study.trial(4)
    for ask in (lambda: trial.course, trial.figure, trial.filmstrip):
        with pytest.raises(DefinitionError) as caught:
            ask()
        assert str(caught.value) == (
            "a trial of kinematic fidelity has no course and no pictures (call trial(..., fidelity='contact'))"
        )


def test_the_bench_is_that_of_the_trial(study, gripped):
    found = study.payload(4)

    assert found.payload_kg == gripped.metrics["bench_payload_kg"]
    assert found.payload_kg == pytest.approx(found.theory_kg, rel=0.01)
    assert study.payload(4, friction=0.35).theory_kg == pytest.approx(found.theory_kg / 2)
    assert study.payload(4, finger_force_n=5.0).theory_kg == pytest.approx(found.theory_kg / 2)


def test_metrics_have_their_units(study):
    columns = trial_metric_columns()

    assert [column.name for column in columns] == [name for name in METRICS if name != "success"]
    for column in (*columns, *phase_metric_columns()):
        assert column.meaning
        assert column.kind is Kind.NUMBER
        if column.name in METRICS:
            length = METRICS[column.name].length
            # A row whose length follows from the project has as many columns as a record has entries.
            assert (column.unit, column.items) == (
                METRICS[column.name].unit,
                None if length is None else max(0, length),
            )


@pytest.mark.parametrize("name", FRAMES)
def test_names_end_with_the_unit(name):
    for column in (*FRAMES[name].index, *FRAMES[name].columns):
        ending = next((end for end in ENDINGS if column.name.endswith(end)), None)
        if column.unit and " " not in column.unit and not column.unit.endswith("'s"):
            assert conversion_factor(column.unit, column.unit) == 1.0
            assert ENDINGS.get(ending, "1") == column.unit
        assert "|" not in column.meaning
        assert (column.unit == "") == (column.kind in (Kind.TEXT, Kind.TRUTH))


def test_a_study_tells_its_columns(study):
    columns = study.columns("variants")

    assert list(columns.index) == ["variant", *study.variants.columns]
    assert columns.loc["d2_finger_mass_kg"].tolist() == ["kg", "Mass of one finger."]
    assert study.columns("trials").loc["item_N_planning_time_s", "unit"] == "s"


def test_the_page_has_the_tables_of_the_code():
    page = PAGE.read_text(encoding="utf-8")

    assert re.findall(r"<!-- columns of (\w+) -->", page) == list(FRAMES)
    assert with_reference_tables(page) == page, f"write them anew: {WRITE}"
    assert reference_table("weights").startswith("One row: a measure with a weight above 0.\n\n| column | unit |")
    with pytest.raises(DefinitionError, match="unknown frame 'x'"):
        reference_table("x")


def test_the_example_of_the_page_runs(empty, monkeypatch):
    example, *_ = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    (empty / "example.py").write_text(example, encoding="utf-8")
    monkeypatch.chdir(empty)
    found = runpy.run_path("example.py")

    assert len(found["tried"]) == 4
    assert found["fastest"] in found["study"].trials.index
    assert len(found["verdicts"]) == 4 * 7
    assert found["trial"].success


def test_a_program_without_weights_says_so(changeable):
    file = changeable / "studies/pick_place.yaml"
    text = file.read_text(encoding="utf-8")
    assert text.count("  practical_margin: 0.01\n") == 1
    program = "  decide_by: {program: lexicographic, order: [{measure: C_total, absolute: 1 USD}]}\n"
    file.write_text(text.replace("  practical_margin: 0.01\n", program), encoding="utf-8")
    trade = rgss.load_study(changeable, fidelity="kinematic", replicates=2).trade()

    assert trade.decision.program == "lexicographic"
    for ask in (trade.weights, trade.acceptability):
        with pytest.raises(TradeoffError, match="the weights were not analysed: ") as caught:
            ask()
        assert isinstance(caught.value, RgssError)
        assert caught.value.hint == "robustness().refused has the reasons"
