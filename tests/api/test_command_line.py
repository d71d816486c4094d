"""The frames have the numbers of the command line."""

from __future__ import annotations

import csv

import numpy as np
import pandas as pd
import pytest

import rgss
from rgss.cli.main import main

from .conftest import ASKED, OPTIONS


def plain(value):
    """A cell as JSON has it: nothing for what is missing."""
    return None if pd.isna(value) else value


def rows(frame, *columns):
    return [
        {name: plain(row[name]) for name in columns} for row in frame.reset_index().astype(object).to_dict("records")
    ]


def test_measures(study, swept, told):
    document = told("measure", "--project", swept, *OPTIONS, "--json")

    assert rows(study.measures, "variant", "measure", "value", "unit", "low", "high", "n") == document


def test_verdicts(study, swept, told):
    document = told("measure", "--project", swept, *OPTIONS, "--verdicts", "--json")
    found = rows(study.verdicts, "variant", "requirement", "verdict", "changed")

    assert [{**row, "changed": row["changed"].split(", ") if row["changed"] else []} for row in found] == document
    assert {row["verdict"] for row in found} >= {"met", "inconclusive"}


def test_why_a_verdict_is_stale(changeable, told):
    file = changeable / "requirements/system/1-manipulator.yaml"
    text = file.read_text(encoding="utf-8")
    assert 'threshold: "25 s"' in text
    file.write_text(text.replace('threshold: "25 s"', 'threshold: "26 s"', 1), encoding="utf-8")
    document = told("measure", "--project", changeable, *OPTIONS, "--verdicts", "--json")
    stale = rgss.load_study(changeable, **ASKED).verdicts.query("verdict == 'stale'")

    assert set(stale["changed"]) == {"requirement"}
    assert len(stale) == sum(row["changed"] == ["requirement"] for row in document) == 8


def test_variants(study, swept, told, traded):
    document = told("variants", "--project", swept, "--json")
    frame = study.variants
    found = rows(frame, "variant", *document[0]["parameters"])
    violates = {row["variant"]: row["requirements"] for row in traded["infeasible"]}
    values = {row["variant"]: row["value"] for row in [*traded["ranking"], *traded["infeasible"]]}

    assert found == [{"variant": row["id"], **row["parameters"]} for row in document]
    assert 0 < len(violates) < len(frame)
    for variant, row in frame.iterrows():
        assert row["feasible"] == (variant not in violates)
        assert row["violates"] == ", ".join(violates.get(variant, []))
        assert plain(row["weighted_value"]) == values[variant]


def test_decision(study, traded):
    assert {name: traded[name] for name in study.trade().to_dict()} == study.trade().to_dict()
    assert study.decision.chosen == traded["chosen"]
    assert rows(study.ranking, "variant", "value") == [
        {name: row[name] for name in ("variant", "value")} for row in traded["ranking"]
    ]
    assert study.ranking["objective_1"].tolist() == [row["objectives"][0] for row in traded["ranking"]]
    assert study.ranking.query("tied")["variant"].tolist() == traded["ties"]
    assert study.ranking.query("near_tie")["variant"].tolist() == traded["near_ties"]


def test_robustness(study, traded):
    found = traded["robustness"]
    trade = study.trade()
    ranges = found["weight_changes"]["ranges"]
    drawn = found["weight_changes"]["acceptability"]["alternatives"]
    joined = [{**row, **{side: ", ".join(map(str, row[side])) for side in ("below", "above")}} for row in ranges]

    assert rows(study.pareto, "variant", "support", "shortfall", "dominated_by") == found["pareto"]
    assert rows(trade.weights(), "measure", "weight", "low", "high", "below", "above") == joined
    names = ("variant", "first", "first_error", "unranked", "confidence")
    assert rows(trade.acceptability(), *names) == [{name: row[name] for name in names} for row in drawn]
    central = trade.acceptability().filter(like="central_")
    for row in drawn:
        expected = list((row["central_weights"] or {}).values()) or [None] * central.shape[1]
        assert list(map(plain, central.loc[row["variant"]])) == expected


def test_effects(study, traded):
    found = traded["robustness"]["effects"]
    frame = study.effects()
    expected = {
        (one["measure"], " × ".join(effect["factors"])): (effect, one["unit"])
        for one in found["measures"]
        for effect in one["effects"]
    }

    assert set(frame.index.droplevel("levels")) == set(expected)
    for (measure, factors), rows_of in frame.groupby(["measure", "factors"], sort=False):
        effect, unit = expected[measure, factors]
        assert rows_of["effect"].tolist() == flat(effect["levels"])
        assert list(map(plain, rows_of["low"])) == flat(effect["low"], len(rows_of))
        assert list(map(plain, rows_of["high"])) == flat(effect["high"], len(rows_of))
        assert set(rows_of["share"]) == {effect["share"]}
        assert set(rows_of["unit"]) == {unit}
    assert frame.loc[("C_total", "fingers", "two"), "effect"] < 0 < frame.loc[("C_total", "fingers", "three"), "effect"]


def flat(levels, count=0):
    if levels is None:
        return [None] * count
    return [plain(cell) for row in levels for cell in (row if isinstance(row, list) else [row])]


@pytest.mark.parametrize(
    "what_if",
    [
        {"weight.t_e": 0.5, "SYS-004.threshold": "41000 USD"},
        ["weight.t_e=0.5", "SYS-004.threshold=41000 USD"],
    ],
    ids=["mapping", "texts"],
)
def test_what_if(study, swept, told, what_if):
    options = ("--what-if", "weight.t_e=0.5", "--what-if", "SYS-004.threshold=41000 USD")
    document = told("trade", "--project", swept, *OPTIONS, *options, "--brief", "--json")
    trade = study.trade(what_if)
    changes = rows(trade.changes, "what", "before", "after", "unit", "asked")

    assert {name: document[name] for name in trade.to_dict()} == trade.to_dict()
    assert trade.to_dict() != study.trade().to_dict()
    for key, asked in (("changes", True), ("rescaled", False)):
        expected = document["what_if"][key]
        assert [row for row in changes if row["asked"] is asked] == [
            {"what": one["id"], **{name: one[name] for name in ("before", "after", "unit")}, "asked": asked}
            for one in expected
        ]


def test_one_supposition_as_a_text(study):
    assert study.trade("weight.t_e=0.5").to_dict() == study.trade({"weight.t_e": 0.5}).to_dict()
    assert study.trade({"weight.t_e": np.float64(0.5)}).to_dict() == study.trade({"weight.t_e": 0.5}).to_dict()
    assert study.trade().changes.empty


def test_trials_and_phases(study, swept, tmp_path, capsys):
    file = tmp_path / "trials.csv"
    assert main(["evidence", "export", str(file), "--project", str(swept)]) == 0
    with file.open(encoding="utf-8", newline="") as lines:
        exported = {row["key"]: row for row in csv.DictReader(lines)}
    trials = study.trials.reset_index()

    assert sorted(trials["key"]) == sorted(exported)
    same = [name for name in trials.columns if name in exported[trials["key"][0]]]
    assert len(same) > 30
    for _, trial in trials.iterrows():
        row = exported[trial["key"]]
        assert [name for name in same if not agrees(trial[name], row[name])] == []
        phases = study.phases.loc[trial["variant"], trial["seed"]]
        for name in ("outcome", "duration_s", "peak_tool_speed_m_s"):
            assert all(agrees(cell, row.get(f"{phase}_{name}", "")) for phase, cell in phases[name].items())
        planned = phases.dropna(subset="planning_outcome")
        assert len(planned) == 5
        for number, (_, move) in enumerate(planned.iterrows(), start=1):
            for name, column in (
                ("planning_outcome", "outcome"),
                ("planning_checks", "checks"),
                ("planning_simplification_checks", "simplification_checks"),
                ("planning_time_s", "time_s"),
                ("path_length_m", "path_length_m"),
            ):
                assert agrees(move[name], row[f"planning_{number}_{column}"])


def as_cell(value):
    """A cell as a file of CSV reads: a number where it is one, a text otherwise."""
    value = plain(value)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return float(value)
    return "" if value is None else str(value)


def same_as(text, like):
    return float(text) if isinstance(like, float) and text else text


def agrees(value, text):
    cell = as_cell(value)
    return cell == same_as(text, cell)


@pytest.mark.engine
def test_a_trial(study, swept, told):
    document = told("run", "8", "--seed", "2", "--fidelity", "kinematic", "--project", swept, "--json")
    trial = study.trial(8, 2)

    assert trial.digest == document["digest"]
    assert trial.success is document["success"]
    assert trial.phases["outcome"].tolist() == [phase["outcome"] for phase in document["phases"]]
    assert trial.metrics["motion_time_s"] == study.trials.loc[(8, 2), "motion_time_s"]
