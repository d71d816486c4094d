"""Suppositions about a portfolio hold in every study that it serves, as if they stood in the files."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

PAYLOAD = "trade_off:\n  values:\n    - {measure: P_max, weight: 1.0, worst: 0.8 kg, best: 1.4 kg}\n"
PORTFOLIO = """\
trade_off:
  portfolio:
    at_most: 2
    aim: worst
    studies:
      - {study: studies/pick_place.yaml, weight: 0.5}
      - {study: studies/payload.yaml, weight: 0.5}
"""


@pytest.fixture
def folder(with_evidence, tmp_path):
    """The reference study, one that weighs payload alone, and one that serves both."""
    copied = Path(shutil.copytree(with_evidence, tmp_path / "portfolio"))
    head, rest = (copied / "studies/pick_place.yaml").read_text(encoding="utf-8").split("trade_off:\n", 1)
    (copied / "studies/payload.yaml").write_text(head + PAYLOAD, encoding="utf-8")
    (copied / "studies/both.yaml").write_text(head + PORTFOLIO + rest, encoding="utf-8")
    return copied


def test_they_choose_what_the_files_would(rgss, folder):
    """The best payload is that of both studies; the weight of success one of the first alone."""

    def portfolio(*suppositions):
        options = [word for text in suppositions for word in ("--what-if", text)]
        told = rgss("trade", "--brief", "--json", "studies/both.yaml", "--project", folder, *options)
        assert told.status in (0, 1), told.errors
        return told.document["portfolio"]

    before, supposed = portfolio(), portfolio("value.P_max.best=2 kg", "weight.S=0.9")
    for name in ("pick_place", "payload"):
        path = folder / f"studies/{name}.yaml"
        text = path.read_text(encoding="utf-8").replace("best: 1.4 kg", "best: 2 kg")
        if "measure: S, weight: 0.20" in text:
            text = re.sub(r"(?<=, weight: )0\.\d+", lambda found: f"{float(found[0]) / 8}", text)
            text = text.replace("measure: S, weight: 0.025", "measure: S, weight: 0.9")
        path.write_text(text, encoding="utf-8")
    written = portfolio()

    assert supposed["value"] != pytest.approx(before["value"], abs=0.01)
    assert supposed["value"] == pytest.approx(written["value"])
    assert supposed["members"] == written["members"]
    assert [one["variant"] for one in supposed["assignments"]] == [one["variant"] for one in written["assignments"]]


def test_trials_that_a_supposition_needs_are_missing_in_it_too(rgss, folder):
    told = rgss("trade", "--brief", "studies/both.yaml", "--project", folder, "--what-if", "planning.clearance=6 mm")
    assert told.status == 2
    assert "trials" in told.errors
