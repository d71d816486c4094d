"""Short representations of what an analyst holds, their views in Jupyter, and the units that frames carry."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

import rgss
from rgss.api.columns import FRAMES
from rgss.evidence import Failure

from .conftest import ASKED


def cells(view):
    return [re.findall(r"<td>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", view) if "<td>" in row]


def test_a_trial_is_one_line_and_a_table_of_its_states(study):
    trial = study.trial(4)

    assert repr(trial) == "Trial(variant 4, seed 1, kinematic fidelity: success)"
    assert [row[:2] for row in cells(trial._repr_html_())] == [
        [phase, outcome] for (*_, phase), outcome in trial.phases["outcome"].items()
    ]


def test_a_trial_that_failed_says_where(study):
    trial = study.trial(4)
    last = trial.record.phases[-1].phase
    failure = next(iter(Failure))
    failed = replace(
        trial,
        record=replace(trial.record, success=False, failure=failure, failed_phase=last, failure_detail="a < b"),
    )

    assert repr(failed) == f"Trial(variant 4, seed 1, kinematic fidelity: {failure.value} at {last}: a < b)"
    assert "a &lt; b" in failed._repr_html_()
    assert "a < b" not in failed._repr_html_()


def test_a_trade_off_shows_the_first_of_its_ranking(study):
    trade = study.trade()
    decision = trade.decision
    rows = cells(trade._repr_html_())

    assert repr(trade) == "Trade('pick_place', 8 variants)"
    assert repr(study.trade({"weight.t_e": 0.3})) == "Trade('pick_place', 8 variants, under suppositions)"
    assert repr(decision) == (
        f"Decision(optimal: chosen {decision.chosen}, runner-up {decision.runner_up}, "
        f"{decision.counts.feasible} of 8 alternatives feasible)"
    )
    assert [int(row[1]) for row in rows] == [one.variant for one in decision.ranking[:5]]
    assert rows[0][3] == "chosen"
    assert cells(decision._repr_html_()) == rows
    assert cells(study.decision._repr_html_()) == rows


def test_a_decision_without_a_choice_has_no_table(study):
    decision = replace(study.decision, ranking=(), chosen=None, runner_up=None, ties=())

    assert "<table>" not in decision._repr_html_()
    assert "chosen None" in decision._repr_html_()


def test_a_study_is_shown_without_reading_evidence(empty, study):
    fresh = rgss.load_study(empty, **ASKED)

    assert ["evidence", "none yet: call sweep()"] in cells(fresh._repr_html_())
    assert not (empty / ".rgss").exists()
    assert ["evidence", str(study.project.evidence)] in cells(study._repr_html_())
    assert ["design variants", "8"] in cells(study._repr_html_())


@pytest.mark.parametrize("name", ["variants", "trials", "phases", "measures", "verdicts", "ranking", "pareto"])
def test_a_frame_carries_the_units_of_its_columns(study, name):
    frame = getattr(study, name)
    units = frame.attrs["units"]
    fixed = {one.name: one.unit for one in (*FRAMES[name].index, *FRAMES[name].columns) if one.unit}

    assert set(units) <= {*frame.index.names, *frame.columns}
    assert {column: units[column] for column in fixed if column in units} == {
        column: unit for column, unit in fixed.items() if column in units
    }
    assert all(units[column] for column in units)
    assert [column for column in frame.columns if column.endswith("_s") and not column.endswith("m_s")] == [
        column for column in frame.columns if units.get(column) == "s"
    ]


def test_units_stay_with_a_selection(study):
    assert study.trials.query("success").attrs["units"]["task_time_s"] == "s"


def test_requirements_are_a_frame_without_evidence(empty):
    study = rgss.load_study(empty, **ASKED)
    frame = study.requirements
    written = {one.id: one for one in study.project.requirements.system}

    assert list(frame.index) == list(written)
    assert not (empty / ".rgss").exists()
    for name, row in frame.iterrows():
        assert row["text"] == written[name].text
        assert row["satisfied_by"].split(", ") == (list(written[name].satisfied_by) or [""])
    stated = {one.id: one.criterion for one in written.values() if one.criterion is not None}
    assert stated
    assert frame["measure"].dropna().to_dict() == {name: one.measure for name, one in stated.items()}
    assert frame["threshold"].dropna().to_dict() == {name: one.threshold for name, one in stated.items()}


def test_requirements_join_their_verdicts(study):
    verdicts = study.verdicts
    joined = verdicts.join(study.requirements[["text", "threshold"]].rename(columns={"threshold": "threshold_stated"}))

    assert joined["text"].notna().all()
    assert (joined["threshold"] == joined["threshold_stated"]).all()
