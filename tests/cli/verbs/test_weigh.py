"""``rgss weigh``: weights, intervals and inconsistency of the answers in a study's file."""

from __future__ import annotations

import json
import re

import pytest
import yaml

from rgss.cli.main import main

ANSWERS = """  elicitation:
    - {swing_of: P_max, over: C_total, ratio: 1}
    - {swing_of: t_e, over: C_total, ratio: 0.8}
    - {swing_of: t_p, over: t_e, ratio: 0.5}
    - {swing_of: t_p, over: C_total, ratio: TURN}
    - {swing_of: S, over: C_total, between: [0.7, 0.9]}
  stakeholders:
    safety: {answers: [{swing_of: S, over: t_e}]}
"""


def with_answers(folder, turn):
    path = folder / "studies" / "pick_place.yaml"
    text = re.sub(r", weight: [\d.]+", "", path.read_text(encoding="utf-8"))
    place = "  practical_margin: 0.01\n"
    assert place in text
    path.write_text(text.replace(place, place + ANSWERS.replace("TURN", turn)), encoding="utf-8")


def test_consistent_enough(folder, capsys):
    with_answers(folder, "0.3")

    assert main(["weigh", "--project", str(folder)]) == 0
    text = capsys.readouterr().out
    assert "the answers are consistent enough" in text
    assert "The worst triad, off by ×1.33: t_e = 0.8 × C_total, t_p = 0.3 × C_total, t_p = 0.5 × t_e." in text
    assert "the other answers imply t_e = 0.6 × C_total" in text
    assert "weights of safety" in text
    assert "Centre of all weights that agree with the answers." in text
    assert main(["weigh", "--project", str(folder), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    study, safety = document["elicitation"]
    assert study["consistency"]["worst_triad"]["mends"] == pytest.approx([0.6, 0.4, 0.375])
    assert {one["criterion"]: one["weight"] for one in study["weights"]} == document["weights"]
    assert f"SHA-256 {study['digest']}" in text
    assert safety["stakeholder"] == "safety"
    assert safety["consistency"] is None


def test_too_inconsistent_is_a_finding(folder, capsys):
    with_answers(folder, "6")

    assert main(["weigh", "--project", str(folder)]) == 1
    assert "the answers are too inconsistent" in capsys.readouterr().out


def test_stated_weights_and_the_questions_to_ask_instead(folder, capsys):
    assert main(["weigh", "--project", str(folder)]) == 0
    assert "states its weights" in capsys.readouterr().out
    assert main(["weigh", "--questions", "--project", str(folder)]) == 0
    section = yaml.safe_load(capsys.readouterr().out)
    assert section["elicitation"][0] == {"swing_of": "P_max", "over": "C_total"}
    assert len(section["elicitation"]) == 5
    assert main(["weigh", "--questions", "--json", "--project", str(folder)]) == 2
    assert "--questions prints a section of a YAML file" in capsys.readouterr().err
