"""Charts of the report as they are drawn: nothing covers, turns back or leaves its scale."""

from __future__ import annotations

import copy
from dataclasses import replace
from itertools import combinations

import pytest

from rgss.reports.study_page import study_report_to_html

pytestmark = pytest.mark.browser


def _drawn(reader, name):
    reader.script(f"document.getElementById('{name}-plot').scrollIntoView()")
    reader.until(f"return document.querySelector('#{name}-plot .main-svg') !== null")


def test_a_curve_of_planning_times_never_turns_back(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    planning = document["planning"]
    limit = max(one["longest_limit_s"] for one in planning["planners"])
    there = next(row for row, time in enumerate(planning["time_s"]) if time is not None)
    planning["time_s"][there] = limit + 0.3
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    _drawn(reader, "planning")

    curves = reader.script("return document.getElementById('planning-plot').data.map((one) => Array.from(one.x))")
    assert curves
    for times in curves:
        assert times == sorted(times)
        assert times[-1] == pytest.approx(limit + 0.3)


def test_error_bars_of_shares_stay_between_0_and_1(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    found = document["decision"]["acceptability"]["variants"]
    for one in found:
        one["error"] = 0.4
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    _drawn(reader, "acceptability")

    bar = reader.script(
        "const [one] = document.getElementById('acceptability-plot').data;"
        "return {y: Array.from(one.y), up: Array.from(one.error_y.array), down: Array.from(one.error_y.arrayminus)}"
    )
    assert bar["y"]
    for share, up, down in zip(bar["y"], bar["up"], bar["down"], strict=True):
        assert 0 <= share - down <= share <= share + up <= 1
    assert max(bar["up"]) == pytest.approx(min(1.96 * 0.4, 1 - min(bar["y"])))


@pytest.mark.parametrize("width", [390, 1024, 1440])
def test_numbers_of_coinciding_variants_do_not_cover_each_other(reader, page, width):
    reader.open(page, width=width)
    _drawn(reader, "pareto")
    measures = reader.script("return Array.from(document.getElementById('pareto-x').options, (one) => one.value)")
    labelled = 0
    for across, up in combinations(measures, 2):
        reader.script(
            "for (const [id, value] of [['pareto-x', arguments[0]], ['pareto-y', arguments[1]]]) {"
            " const select = document.getElementById(id); select.value = value;"
            " select.dispatchEvent(new Event('change')); }",
            across,
            up,
        )
        boxes = reader.script(
            "return Array.from(document.querySelectorAll('#pareto-plot .textpoint text'), (one) => one)"
            ".filter((one) => one.textContent.startsWith('\u00d7')).map((one) => {"
            " const box = one.getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; })"
        )
        labelled += len(boxes)
        for one, other in combinations(boxes, 2):
            apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
            assert apart, (across, up, one, other)
    assert labelled > 0


def test_pictures_of_failures_are_folded_until_a_link_leads_there(reader, study, pictures, tmp_path):
    (first,) = pictures
    file = tmp_path / "report.html"
    shown = (first, replace(first, title="Variant 1, which failed", failed=True))
    file.write_text(study_report_to_html(study.document, study.trace, pictures=shown), encoding="utf-8")
    reader.open(file)
    folded = "return Array.from(document.querySelectorAll('#pictures .shots'), (one) => one.open)"
    assert reader.script(folded) == [False]
    reader.script("location.hash = '#worst-failure'")
    reader.until(folded + ".every(Boolean)")
    reader.script("location.hash = ''; document.querySelector('#pictures .shots').open = false")
    reader.script("dispatchEvent(new Event('beforeprint'))")
    assert reader.script(folded) == [True]
