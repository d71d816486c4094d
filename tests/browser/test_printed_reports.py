"""The report and its board edition as a browser prints them."""

from __future__ import annotations

import base64
import copy
import dataclasses
import re

import pytest

from rgss.reports.board_page import MOST_PAGES, board_to_html
from rgss.reports.trace.html import report_to_html

pytestmark = pytest.mark.browser

LONG = "A reason with many words that says much about little and goes on and on. " * 20


def printed_pages(reader, file) -> int:
    reader.driver.get(file.as_uri())
    pdf = reader.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": False})
    return len(re.findall(rb"/Type\s*/Page[^s]", base64.b64decode(pdf["data"])))


@pytest.mark.parametrize("long", [False, True])
def test_it_has_at_most_five_pages_whatever_it_holds(reader, study, pictures, tmp_path, long):
    document = study.document
    if long:
        decision = document["decision"] | {"reasons": [LONG] * 40, "cautions": [LONG] * 40}
        document = document | {"decision": decision}
    failed = dataclasses.replace(pictures[0], failed=True, note=LONG)
    file = tmp_path / "report.html"
    file.write_text(board_to_html(document, pictures=[*pictures, failed, failed, failed]), encoding="utf-8")

    assert 2 <= printed_pages(reader, file) <= MOST_PAGES
    assert reader.complaints() == []
    # What is cut says so, and nothing that was written is hidden.
    assert ("and 35 more, in the whole report" in reader.text("#reasons")) is long
    assert f"{sum(one.failed for one in pictures) + 1} more failures with pictures" in reader.text("#failures")
    hidden = "return [...document.querySelectorAll('.sheet')].filter(each => each.scrollHeight > each.clientHeight + 2)"
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert reader.script(f"{hidden}.map(each => each.id)") == []
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


def test_parts_that_fit_together_share_a_page(reader, lone_study, tmp_path):
    file = tmp_path / "report.html"
    document = lone_study.document
    decision = document["decision"] | {"modelling": document["decision"]["modelling"] | {"rows": []}}
    file.write_text(board_to_html(document | {"decision": decision}), encoding="utf-8")
    assert len(re.findall('class="sheet"', file.read_text(encoding="utf-8"))) == MOST_PAGES
    assert printed_pages(reader, file) < MOST_PAGES
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        left = "Array.from(document.querySelectorAll('h1, h2'), (one) => one.getBoundingClientRect().left)"
        assert len(set(reader.script(f"return {left}"))) == 1
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})


_LINE_ENDS = """
const ends = [];
for (const head of document.querySelectorAll('.sheet tbody th')) {
  const walker = document.createTreeWalker(head, NodeFilter.SHOW_TEXT);
  let before = '', top = null;
  while (walker.nextNode()) for (let place = 0; place < walker.currentNode.length; place += 1) {
    const range = document.createRange();
    range.setStart(walker.currentNode, place);
    range.setEnd(walker.currentNode, place + 1);
    const box = range.getBoundingClientRect();
    if (top !== null && box.top > top + 4) ends.push(before);
    [before, top] = [walker.currentNode.data[place], box.top];
  }
}
return ends;
"""


def test_long_ids_break_at_the_ends_of_their_parts(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    for one in document["measures"]:
        one["name"] = f"mean_time_of_one_whole_transfer.of_the_left_arm_of_{one['id']}"
    for one in document["parameters"]:
        one["name"] = "x" * 60
        one["values"] = ["a level with a name of many words that takes a lot of room"] * len(document["variants"]["id"])
    file = tmp_path / "report.html"
    file.write_text(board_to_html(document), encoding="utf-8")
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": 1040, "height": 700, "deviceScaleFactor": 1, "mobile": False}
    )
    reader.driver.get(file.as_uri())
    ends = reader.script(_LINE_ENDS)
    assert "_" in ends
    # A part that is longer than any word is broken too, rather than cut by the edge of the paper.
    assert set(ends) <= {"_", ".", " ", ":", "x"}
    assert reader.script("return document.documentElement.scrollWidth") <= 1040


def test_a_caution_is_whole_where_there_is_room(study):
    caution = LONG[:300].strip()
    decision = study.document["decision"] | {"reasons": ["It leads."], "cautions": [caution]}
    assert caution in board_to_html(study.document | {"decision": decision})
    decision |= {"cautions": [caution] * 5}
    assert caution not in board_to_html(study.document | {"decision": decision})


def test_the_choice_has_what_differences_are_worth_to_it(study):
    exchange = {"reference": "C_total", "worth": "-2 s of t_e 436 USD."}
    page = board_to_html(study.document | {"sensitivity": {"exchange": exchange}})
    assert "are worth to the choice, in C_total. -2 s of t_e 436 USD." in page
    assert 'id="exchange"' not in board_to_html(study.document | {"sensitivity": None})


def test_assumptions_that_change_the_choice_come_first(study):
    cells = ["prices", "as stated", "1.5", "variant 2", "yes"]
    row = {"cells": cells, "sentence": "Then variant 2 is chosen."}
    rows = [{**row, "title": f"same-{index}", "changes": False} for index in range(20)]
    rows += [{**row, "title": "unknown", "changes": None}, {**row, "title": "prices", "changes": True}]
    modelling = {**study.document["decision"]["modelling"], "rows": rows, "heads": ["a", "b", "c", "d", "e"]}
    decision = study.document["decision"] | {"modelling": modelling}

    page = board_to_html(study.document | {"decision": decision})

    assert page.index(">prices<") < page.index(">unknown<") < page.index(">same-0<")
    assert ">same-8<" not in page
    assert "12 more assumptions in the whole report." in page


def test_without_a_feasible_variant_it_says_what_would_make_one_feasible(study):
    moved = {"requirement": "SYS-004", "demand": "c_s at most 43,000 USD", "needed": "41,750 USD", "relative": "3.1 %"}
    repair = {"requirements": ["SYS-004"], "changes": [moved], "unlocked": 3, "winner": 13}
    conflicts = {
        "joint": [repair] * 7 + [repair | {"changes": []}],
        "requirements": [{"requirement": "SYS-012", "demand": "t_e at most 9 s", "excludes": 71}],
    }
    decision = study.document["decision"] | {"chosen": None, "runner_up": None, "reasons": ["x"], "cautions": []}
    page = board_to_html(study.document | {"decision": decision, "conflicts": conflicts})
    assert page.count("c_s at most 43,000 USD → 41,750 USD") == 5
    assert "<td>variant 13</td><td>3</td>" in page
    assert "2 more repairs in the whole report." in page
    assert '<th scope="row"><span class="option">SYS-012</span></th><td>t_e at most 9 s</td><td>71</td>' in page


@pytest.mark.parametrize("width", [1440, 400])
def test_on_a_screen_it_has_no_serious_finding_and_asks_for_nothing(reader, study, pictures, tmp_path, width):
    file = tmp_path / "report.html"
    file.write_text(board_to_html(study.document, pictures=pictures), encoding="utf-8")
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride",
        {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600},
    )
    reader.driver.get_log("performance")
    reader.driver.get(file.as_uri())

    assert reader.script("return document.documentElement.scrollWidth") <= width
    assert reader.accessibility_findings() == []
    assert reader.requests() == []
    assert str(study.document["decision"]["chosen"]) in reader.text("#choice-title")


def test_paper_has_every_table_and_every_plot(reader, page):
    reader.open(page)
    lines = "return document.querySelectorAll('#weights-table tbody tr').length"
    reader.script("document.getElementById('weights-table').closest('details').open = true")
    reader.until(f"{lines} === 20")
    told = reader.text("#weights-table output")
    reader.script("dispatchEvent(new Event('beforeprint'))")
    assert reader.script(lines) == int(told.rpartition(" ")[2]) > 20

    rows = reader.script(
        "const all = Array.from(document.querySelectorAll('details.figures'));"
        "return all.map((one) => one.querySelectorAll('td').length)"
    )
    # The second of them holds the sliders, which paper has no use for.
    assert 0 not in [count for place, count in enumerate(rows) if place != 1]
    closed = "Array.from(document.querySelectorAll('details:not([open])'))"
    assert reader.script(f"return {closed}.every((one) => one.classList.contains('on-demand'))")
    assert reader.script("return document.querySelectorAll('.plot .main-svg').length") >= 9
    reader.script("dispatchEvent(new Event('afterprint'))")
    assert reader.script(lines) == 20
    assert reader.complaints() == []


def test_paper_has_diagrams_and_matrices_only_where_the_reader_opened_them(reader, page):
    """All of them are more sheets than the rest of the report."""
    reader.open(page)
    folds = "Array.from(document.querySelectorAll('#traceability ~ section > details.fold'))"
    names = reader.script(f"return {folds}.map((one) => one.closest('section').id)")
    assert {"architecture", "verification", "coverage"} <= set(names)
    reader.script("document.querySelector('#architecture > details.fold').open = true")
    reader.script("dispatchEvent(new Event('beforeprint'))")
    opened = reader.script(f"return {folds}.filter((one) => one.open).map((one) => one.closest('section').id)")
    assert {"architecture", "verification", "coverage"} <= set(opened)
    assert not [name for name in opened if "-" in name]
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        said = reader.script(
            "return getComputedStyle(document.querySelector('details.fold.on-demand:not([open]) > summary'), '::after')"
            ".content"
        )
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert "not printed" in said


def test_the_whole_report_is_printed_on_fewer_sheets_than_it_has_diagrams_and_tables(reader, page):
    reader.open(page)
    pdf = reader.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True, "printBackground": False})
    pages = len(re.findall(rb"/Type\s*/Page[^s]", base64.b64decode(pdf["data"])))
    assert 20 < pages < 100


def test_requirements_of_the_printed_trace_share_sheets(reader, study, tmp_path):
    """Each of them with its rationale had one for itself, in a column as wide as a word."""
    file = tmp_path / "trace.html"
    file.write_text(report_to_html(study.trace), encoding="utf-8")
    assert printed_pages(reader, file) < 25 + len(study.trace.verification) / 2


_LEGENDS_IN_PLOTS = """
const top = (one) => one.getBoundingClientRect().top;
return Array.from(document.querySelectorAll('.js-plotly-plot')).filter((plot) => plot.querySelector('.legend'))
  .map((plot) => [plot.id, plot.querySelector('.legend').getBoundingClientRect().bottom - top(plot)
    - plot._fullLayout._size.t])
  .filter(([, below]) => below > 1);
"""


def test_legends_lie_above_their_plots_on_paper(reader, page):
    """Of plots that a narrow window had with legends of several lines."""
    reader.open(page, width=650)
    try:
        reader.script("dispatchEvent(new Event('beforeprint'))")
        drawn = reader.script("return document.querySelectorAll('.js-plotly-plot .legend').length")
        assert drawn > 3
        assert reader.script(_LEGENDS_IN_PLOTS) == []
    finally:
        reader.script("dispatchEvent(new Event('afterprint'))")
