"""The report compares the designs' planners with the study's references on the same moves."""

from __future__ import annotations

import re
from argparse import Namespace

import pytest

from rgss.cli.verbs.report import _planners
from rgss.evidence import EvidenceStore
from rgss.studies import load_project, trial_specs
from tests.cli.conftest import made_record
from tests.fixtures.shipped_project import DESIGN_SPACE, copy_project
from tests.fixtures.stored_trials import put_trials

STUDY = "studies/pick_place.yaml"
PLANNED_ALIKE = (
    "      - id: standard\n        sets: {d2: 0.3 kg, d3: 0.4 kg}\n",
    "      - id: slow\n        sets: {d7: 0.5 m/s}\n",
)
"""Levels that make more designs, whose searches are those of the others."""


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """A project whose searches are coarse, with two seeds, a reference, and a made record for each trial."""
    folder = copy_project(tmp_path_factory.mktemp("planners") / "project")
    text = (folder / STUDY).read_text(encoding="utf-8")
    text = text.replace("  resolution: 0.01 rad\n", "  resolution: 0.1 rad\n  verification_resolution: 0.05 rad\n")
    text = text.replace(
        "  clearance: 8 mm\n", "  clearance: 8 mm\n  on_unverified: repair\n  references: [RRTConnect]\n"
    )
    text = re.sub(r"^replicates: .*$", "replicates: 2", text, flags=re.MULTILINE)
    (folder / STUDY).write_text(text, encoding="utf-8")
    space = (folder / DESIGN_SPACE).read_text(encoding="utf-8")
    for level in PLANNED_ALIKE:
        assert space.count(level) == 1
        space = space.replace(level, "")
    (folder / DESIGN_SPACE).write_text(space, encoding="utf-8")
    project = load_project(folder)
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project), made_record)
    return folder


def cells(page):
    table = re.search(r'<table id="planners-table">.*?</table>', page, flags=re.DOTALL)[0]
    rows = re.findall(r"<tr>(.*?)</tr>", table, flags=re.DOTALL)
    return [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in rows]


@pytest.mark.engine
def test_the_report_has_the_references_beside_the_designs_planners_without_films_too(quick, rgss, tmp_path):
    page = tmp_path / "report.html"
    told = rgss("report", "--no-film", "--out", page, "--json", "--project", quick)
    compared = told.document["report"]["planner_comparison"]
    alone = rgss("planners", "--seeds", 2, "--json", "--project", quick).document

    assert {key: compared[key] for key in ("seeds", "limits_s", "planners")} == alone
    assert compared["seeds"] == [1, 2]
    titles, *rows = cells(page.read_text(encoding="utf-8"))
    assert titles[:2] == ["planner", "settings"]
    assert [row[0] for row in rows] == ["RRT", "TRRT (no cost)", "STRIDE", "RRTConnect, reference"]
    for row, one in zip(rows, alone["planners"], strict=True):
        assert int(row[titles.index("searches")]) == one["searches"] == 20
        shares = [row[titles.index(f"solved in {limit_s:g} s")] for limit_s in alone["limits_s"]]
        assert shares == [f"{100 * share:.0f} %" for share in one["solved"]]


def test_the_board_edition_which_does_not_show_it_searches_for_no_comparison():
    assert _planners(Namespace(no_planners=False, board=True), None) is None


def test_without_the_comparison_nothing_is_searched_and_the_page_says_how_to_get_it(quick, rgss, tmp_path, monkeypatch):
    monkeypatch.setattr("rgss.sweep.compared_planners", None)
    page = tmp_path / "report.html"
    told = rgss("report", "--no-film", "--no-planners", "--out", page, "--json", "--project", quick)

    assert told.document["report"]["planner_comparison"] is None
    text = page.read_text(encoding="utf-8")
    assert "planners-table" not in text.split("<script")[0]
    assert "No design plans by the reference RRTConnect" in text
