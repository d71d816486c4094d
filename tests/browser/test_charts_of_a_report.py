"""Charts of the report as they are drawn: nothing covers, turns back or leaves its scale."""

from __future__ import annotations

import copy
import csv
import struct
from dataclasses import replace
from itertools import combinations
from xml.etree import ElementTree as ET

import pytest

from rgss.decision.sensitivity import InputKind, RangeBasis, Tornado, TornadoBar, TornadoEnd
from rgss.reports.board_page import board_to_html
from rgss.reports.decision.tornado_picture import tornado_svgs
from rgss.reports.study.first_screen import first_screen_content
from rgss.reports.study_page import study_report_to_html
from tests.fixtures.processes import wait_until

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
    last = max(times[-2] for times in curves)
    assert last == pytest.approx(limit + 0.3)
    # The last step is seen: every curve goes on to the right of it, within the axis.
    end = reader.script("return document.getElementById('planning-plot').layout.xaxis.range[1]")
    for times in curves:
        assert times == sorted(times)
        assert times[-1] > 1.02 * last
        assert times[-1] <= end
    note = reader.text("#planning-note")
    assert f"the longest limit is {limit:g} s" in note
    assert f"a limit of its own of {planning['simplification_limit_s']:g} s" in note


def test_an_interval_beyond_the_chart_ends_in_an_arrow_and_no_label_covers_one(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    limited = next(one for one in document["requirements"] if one["measure"] == "t_e_simulated")
    measure = next(one for one in document["measures"] if one["id"] == "t_e_simulated")
    measure["high"] = 100 * limited["threshold"]
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    boxes = reader.script(
        "const svg = Array.from(document.querySelectorAll('.bullet svg'))"
        ".find((one) => one.getAttribute('aria-label').startsWith(arguments[0]));"
        "return ['rect.track', 'path.beyond'].map((one) => {"
        " const box = svg.querySelector(one).getBoundingClientRect(); return [box.right, box.height, box.width]; })",
        measure["name"],
    )
    (track, arrow) = boxes
    assert arrow[0] == pytest.approx(track[0], abs=0.5)
    assert arrow[1] > track[1] / 2
    assert arrow[2] > 2
    arrows = reader.script("return document.querySelectorAll('.bullet path.beyond').length")
    glance = first_screen_content(document)
    assert arrows == sum(sum(one["beyond"]) for one in glance["bullets"])

    reader.script(
        "const choice = document.getElementById('measure-choice'); choice.value = 't_e_simulated';"
        "choice.dispatchEvent(new Event('change'))"
    )
    _drawn(reader, "measures")
    name = f"{limited['id']}: {limited['criterion']}"
    reader.until("return document.querySelector('#measures-plot .legend')?.textContent.includes(arguments[0])", name)
    assert reader.script("return document.querySelectorAll('#measures-plot .annotation').length") == 0


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
        sizes = reader.script(
            "return Array.from(document.querySelectorAll('#pareto-plot .textpoint text'),"
            " (one) => parseFloat(getComputedStyle(one).fontSize))"
        )
        assert min(sizes, default=12) >= 12
        labelled += len(boxes)
        for one, other in combinations(boxes, 2):
            apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
            assert apart, (across, up, one, other)
    assert labelled > 0


@pytest.mark.parametrize("width", [390, 1440])
def test_no_line_of_the_parallel_coordinates_runs_through_a_number(reader, page, study, tmp_path, width):
    reader.open(page, width=width)
    reader.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    reader.script("document.querySelector(\"button[aria-label='Save parallel as SVG']\").click()")
    file = tmp_path / f"{study.document['study']}-parallel.svg"
    wait_until(lambda: file.exists() and file.stat().st_size > 0)
    drawn = list(ET.fromstring(file.read_text(encoding="utf-8")))  # noqa: S314 - of our own page
    paper = drawn[0].get("fill")
    last_line = max(place for place, one in enumerate(drawn) if one.get("stroke") in ("#8a8a8a", "#0072b2", "#d55e00"))
    labels = [(place, one) for place, one in enumerate(drawn) if one.get("text-anchor") == "end"]

    assert len(labels) > 20
    for place, label in labels:
        assert "12px" in label.get("style")
        box = drawn[place - 1]
        assert place - 1 > last_line
        assert box.tag.endswith("rect")
        assert box.get("fill") == paper
        left, top, wide, tall = (float(box.get(name)) for name in ("x", "y", "width", "height"))
        # A digit of this size is at least 6 px wide; a line must not end where a minus sign would be.
        assert left <= float(label.get("x")) - 6 * len(label.text) - 6
        assert left + wide >= float(label.get("x"))
        assert top <= float(label.get("y")) - 10
        assert top + tall >= float(label.get("y")) + 2


@pytest.mark.parametrize("width", [390, 1440])
def test_axes_say_which_end_is_better_and_the_chosen_bar_has_its_number(reader, page, study, width):
    reader.open(page, width=width)

    def layout(name):
        reader.script("document.getElementById(arguments[0]).scrollIntoView()", f"{name}-plot")
        reader.until("return document.getElementById(arguments[0]).querySelector('.main-svg') !== null", f"{name}-plot")
        return reader.script(
            "const {xaxis: x, yaxis: y} = document.getElementById(arguments[0]).layout;"
            "return {x: x.title?.text, y: y.title?.text, ticks: x.ticktext ?? null}",
            f"{name}-plot",
        )

    assert layout("weights")["x"] == "weighted value, higher is better"
    shown = layout("acceptability")
    assert shown["y"] == "share of draws, higher is better"
    assert f"<b>{study.document['decision']['chosen']}</b>" in shown["ticks"]
    assert layout("effects")["y"].endswith(("lower is better", "higher is better"))
    assert layout("timeline")["x"] == "time [s], shorter is better"


def test_pictures_of_failures_are_folded_until_a_link_leads_there(reader, study, pictures, tmp_path):
    (first,) = pictures
    file = tmp_path / "report.html"
    shown = (first, replace(first, title="Variant 1, which failed", failed=True, worst="The only one."))
    file.write_text(study_report_to_html(study.document, study.trace, pictures=shown), encoding="utf-8")
    reader.open(file)
    folded = "return Array.from(document.querySelectorAll('#pictures .shots'), (one) => one.open)"
    assert reader.script(folded) == [False]
    reader.script("location.hash = '#worst-failure'")
    reader.until(folded + ".every(Boolean)")
    reader.script("location.hash = ''; document.querySelector('#pictures .shots').open = false")
    reader.script("dispatchEvent(new Event('beforeprint'))")
    assert reader.script(folded) == [True]


def tornado_of(inputs: int = 1) -> Tornado:
    def end(value, lead):
        return TornadoEnd(value=value, lead=lead, feasible=True, winners=(1,), rival=2, flip=None, flip_winners=())

    bar = TornadoBar(
        id="weight.S",
        kind=InputKind.WEIGHT,
        unit="1",
        base=0.2,
        basis=RangeBasis.SHARE,
        low=end(0.1, 0.05),
        high=end(0.3, 0.2),
        swing=0.15,
        exact=True,
    )
    return Tornado(chosen=1, rival=2, lead=0.1, bars=(bar,) * inputs, without_range=())


def with_tornado(document):
    row = {
        "input": "weight.S",
        "base": "0.2",
        "ends": [{"value": value, "lead": lead, "wins": "variant 1", "flip": "–"} for value, lead in ENDS],
        "range_is": "a share",
        "numbers": {
            "unit": "USD",
            "base": 43000,
            "exact": True,
            "ends": [
                {"value": 38700, "lead": None, "feasible": False, "flip": 40550},
                {"value": 47300, "lead": -0.05, "feasible": True, "flip": None},
            ],
        },
    }
    document = copy.deepcopy(document)
    document["sensitivity"] = EMPTY | {
        "tornado": {
            "chosen": 1,
            "rival": 2,
            "tied": [],
            "no_rival": None,
            "has_leads": True,
            "lead": "0.1",
            "rows": [row],
            "ranges": "All are shares.",
            "still": [],
            "without_range": [],
        }
    }
    return document


@pytest.mark.parametrize("width", [390, 1440])
@pytest.mark.parametrize("board", [False, True])
def test_texts_of_the_tornado_are_at_least_12_px_and_the_page_does_not_scroll(reader, study, tmp_path, width, board):
    document, tornado, file = with_tornado(study.document), tornado_of(), tmp_path / "report.html"
    text = (
        board_to_html(document, tornado=tornado)
        if board
        else study_report_to_html(document, study.trace, tornado=tornado_svgs(tornado))
    )
    file.write_text(text, encoding="utf-8")
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    )
    reader.driver.get(file.as_uri())
    size = (
        "const svg = [...document.querySelectorAll('svg.tornado')].find((one) => one.checkVisibility());"
        "const text = svg.querySelector('text');"
        "return parseFloat(getComputedStyle(text).fontSize) * svg.getBoundingClientRect().width"
        " / svg.viewBox.baseVal.width"
    )
    assert reader.script(size) >= 12
    assert reader.script("return document.documentElement.scrollWidth") <= width
    # Every bar is in view without scrolling sideways, and no bar is under a name.
    seen = (
        "const svg = [...document.querySelectorAll('svg.tornado')].filter((one) => one.checkVisibility());"
        "const box = (one) => one.getBoundingClientRect(), host = box(svg[0].parentElement);"
        "const names = [...svg[0].querySelectorAll('text')].map(box);"
        "return [svg.length, [...svg[0].querySelectorAll('rect')].every((one) => box(one).left >= host.left &&"
        " box(one).right <= host.right + 1 && !names.some((name) => name.left < box(one).right - 1 &&"
        " name.right > box(one).left + 1 && name.top < box(one).bottom - 2 && name.bottom > box(one).top + 2))]"
    )
    assert reader.script(seen) == [1, True]
    # Both colours have a key.
    keys = (
        "const colour = (one, name) => getComputedStyle(one)[name];"
        "return ['low', 'high'].map((kind) => [colour(document.querySelector(`.tornado-legend .${kind}`),"
        " 'backgroundColor'), colour(document.querySelector(`svg.tornado .${kind}`), 'fill')])"
    )
    assert all(key == bar for key, bar in reader.script(keys))
    assert reader.accessibility_findings() == []


def test_a_board_prints_the_largest_bars_at_a_size_that_is_read(reader, study, tmp_path):
    file = tmp_path / "report.html"
    file.write_text(board_to_html(with_tornado(study.document), tornado=tornado_of(25)), encoding="utf-8")
    metrics = {"width": 1400, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    reader.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    reader.driver.get(file.as_uri())
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        size = reader.script(
            "const svg = document.querySelector('svg.tornado.wide'), box = svg.getBoundingClientRect();"
            "const drawn = svg.viewBox.baseVal, text = getComputedStyle(svg.querySelector('text'));"
            "return parseFloat(text.fontSize) * Math.min(box.width / drawn.width, box.height / drawn.height)"
        )
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert size >= 9
    assert "15 more inputs of the tornado in the whole report." in reader.text("#alternatives")


def test_the_tornado_is_saved_as_png_svg_and_csv(reader, study, tmp_path):
    document, drawn = with_tornado(study.document), tornado_svgs(tornado_of())
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace, tornado=drawn), encoding="utf-8")
    reader.open(file)
    reader.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    files = {kind: tmp_path / f"{study.document['study']}-tornado.{kind.lower()}" for kind in ("PNG", "SVG", "CSV")}
    for kind, path in files.items():
        button = f"document.querySelector(\"button[aria-label='Save tornado as {kind}']\")"
        reader.script(f"{button}.scrollIntoView({{block: 'center'}}); {button}.click()")
        wait_until(lambda: path.exists() and path.stat().st_size > 0)  # noqa: B023 - waited for within the round

    drawing = ET.fromstring(files["SVG"].read_text(encoding="utf-8"))  # noqa: S314 - of our own page
    paper, *bars = drawing.findall("{http://www.w3.org/2000/svg}rect")
    assert (paper.get("width"), paper.get("fill")) == ("100%", "#ffffff")
    assert {one.get("fill") for one in bars} == {"rgb(213, 94, 0)", "rgb(0, 114, 178)"}
    assert "weight.S" in "".join(drawing.itertext())
    width, height = struct.unpack(">II", files["PNG"].read_bytes()[16:24])
    assert [width, height] == [2 * int(drawing.get(one)) for one in ("width", "height")]
    rows = list(csv.reader(files["CSV"].read_text(encoding="utf-8").splitlines()))
    (found,) = [dict(zip(rows[0], row, strict=True)) for row in rows[1:]]
    assert [found[one] for one in ("input", "unit", "is", "low", "high")] == [
        "weight.S",
        "USD",
        "43000",
        "38700",
        "47300",
    ]
    assert [found[f"low {one}"] for one in ("lead", "feasible", "wins")] == ["", "no", "variant 1"]
    assert [found[f"high {one}"] for one in ("lead", "feasible", "wins")] == ["-0.05", "yes", "variant 1"]
    assert [found[one] for one in ("changes below", "changes above", "changes are")] == ["40550", "", "exact"]
    assert reader.complaints() == []


ENDS = (("0.1", "+0.05"), ("0.3", "+0.2"))
EMPTY = {
    "bends": [],
    "exchange": None,
    "kept": [],
    "beaten": [],
    "stakeholders": None,
    "not_computed": [],
    "meanings": [],
}


def test_axes_of_shares_end_at_one(reader, page):
    reader.open(page)
    reader.script(
        "for (const [id, value] of [['measure-choice', 'S'], ['pareto-y', 'S']]) {"
        " const select = document.getElementById(id);"
        " select.value = value; select.dispatchEvent(new Event('change')); }"
    )
    for name in ("measures", "pareto", "acceptability"):
        reader.script("document.getElementById(`${arguments[0]}-plot`).scrollIntoView()", name)
        reader.until("return document.querySelector(`#${arguments[0]}-plot .main-svg`) !== null", name)
        low, high = reader.script(
            "return document.getElementById(`${arguments[0]}-plot`)._fullLayout.yaxis.range", name
        )
        assert low >= 0.0
        assert high <= 1.0
