"""Tables that end with whole rows, lines that break where they may, and figures that are written alike."""

from __future__ import annotations

import copy
import re

import pytest

from rgss.figures import exact_figure, rounded_figure
from rgss.reports.study_page import study_report_to_html
from rgss.trace.views import share_in_words

pytestmark = pytest.mark.browser

_ROWS_IN_VIEW = """
return Array.from(document.querySelectorAll(arguments[0]), (box) => {
  const after = getComputedStyle(box, '::after'), at = box.getBoundingClientRect();
  const end = at.top + box.clientTop + box.clientHeight - (after.content === 'none' ? 0 : parseFloat(after.height));
  const rows = Array.from(box.querySelectorAll('tbody tr'), (row) => row.getBoundingClientRect());
  return {
    cut: rows.filter((row) => row.top < end - 2 && row.bottom > end + 2).length,
    beyond: rows.filter((row) => row.bottom > end + 2).length,
    seen: rows.filter((row) => row.bottom <= end + 2).length,
    said: after.content,
  };
});
"""
_BROKEN_WORDS = """
const broken = [], texts = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT);
while (texts.nextNode()) {
  const node = texts.currentNode;
  if (!node.parentElement.checkVisibility() || node.parentElement.closest('svg, canvas, .upright')) continue;
  for (const found of node.data.matchAll(/\\b[A-Z]{2,}-[0-9]+\\b/g)) {
    const range = document.createRange();
    range.setStart(node, found.index);
    range.setEnd(node, found.index + found[0].length);
    if (new Set(Array.from(range.getClientRects(), (one) => Math.round(one.top))).size > 1) broken.push(found[0]);
  }
}
return broken;
"""


def _opened(reader, document, study, tmp_path, **options):
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file, **options)


def _waits_for_whole_rows(reader, selector):
    reader.until(f"return document.querySelector('{selector}[data-more]') !== null")


@pytest.mark.parametrize("width", [1440, 1366])
def test_the_choice_and_the_runner_up_are_seen_whole_beside_the_reasons(reader, page, width):
    reader.open(page, width=width)
    box = "document.querySelector('.columns > .scroll:has(.compared)')"
    assert reader.script(f"return {box}.scrollWidth - {box}.clientWidth") <= 1


@pytest.mark.parametrize("width", [1440, 1024, 390])
def test_a_table_ends_with_a_whole_row_and_says_that_it_goes_on(reader, page, width):
    reader.open(page, width=width)
    _waits_for_whole_rows(reader, "#verdict-table .scroll")
    found = reader.script(_ROWS_IN_VIEW, "#verdict-table .scroll, #variant-evidence .scroll")
    assert [one["cut"] for one in found] == [0] * len(found)
    assert [one["said"] for one in found if not one["beyond"]] == ["none"] * sum(not one["beyond"] for one in found)
    longer = [one for one in found if one["beyond"]]
    assert longer
    for one in longer:
        assert one["seen"] > 2
        assert one["said"] == f'"{one["seen"] + one["beyond"]} rows here: scroll to see them"'


def test_a_table_that_is_filtered_to_fewer_rows_shrinks_and_grows_again(reader, page):
    reader.open(page)
    box = "#verdict-table .scroll"
    _waits_for_whole_rows(reader, box)
    fill = (
        "const field = document.querySelector('#verdict-table input'); field.value = arguments[0];"
        "field.dispatchEvent(new Event('input', {bubbles: true}))"
    )
    reader.script(fill, "30")
    reader.until(f"return document.querySelector('{box}[data-more]') === null")
    assert reader.script(_ROWS_IN_VIEW, box) == [{"cut": 0, "beyond": 0, "seen": 1, "said": "none"}]
    reader.script(fill, "")
    _waits_for_whole_rows(reader, box)
    assert reader.script(_ROWS_IN_VIEW, box)[0]["cut"] == 0


def test_what_the_keyboard_reaches_is_not_below_the_line_at_the_end(reader, page):
    reader.open(page)
    _waits_for_whole_rows(reader, "#verdict-table .scroll")
    covered = reader.script("""
        return Array.from(document.querySelectorAll('#verdict-table tbody th a')).slice(0, 40).filter((link) => {
          link.focus();
          const box = link.closest('.scroll'), strip = parseFloat(getComputedStyle(box, '::after').height);
          const top = box.querySelector('thead th').getBoundingClientRect().bottom;
          const bottom = box.getBoundingClientRect().bottom - strip, at = link.getBoundingClientRect();
          return at.top < top - 1 || at.bottom > bottom + 1;
        }).map((link) => link.textContent);
    """)
    assert covered == []


@pytest.mark.parametrize("width", [1440, 500, 390, 320])
def test_no_id_is_on_two_lines(reader, study, tmp_path, width):
    document = copy.deepcopy(study.document)
    ids = [one["id"] for one in document["requirements"]]
    sentence = "It " + " and is near ".join(ids * 3) + "."
    document["decision"] |= {"reasons": [sentence], "cautions": [sentence], "standing": [sentence]}
    for one in document["requirements"]:
        one["text"] = sentence
    _opened(reader, document, study, tmp_path, width=width)
    assert reader.script(_BROKEN_WORDS) == []


def test_a_figure_is_the_same_in_sentences_and_in_tables_of_the_script(reader, study, tmp_path):
    figures = [2e9, -1.256127e9, 43000.0, 9999.96, 0.1, 1.2e-5, 3.4e-9, 1e-4, 0.0, 123456789.0]
    # Exact ties, each towards the even digit.
    figures += [1234.5, 1235.5, -1234.5, 12.125, 10000.5, 10001.5]
    document = copy.deepcopy(study.document)
    count = len(document["variants"]["id"])
    measure = next(one for one in document["measures"] if one["weight"])
    measure["value"] = [figures[place % len(figures)] for place in range(count)]
    measure |= {"low": None, "high": None}
    _opened(reader, document, study, tmp_path)
    reader.script("document.getElementById('measures-table').closest('details').open = true")
    head = "Array.from(document.querySelectorAll('#measures-table thead th'), (one) => one.textContent)"
    reader.until(f"return {head}.length > 0")
    column = next(
        place for place, text in enumerate(reader.script(f"return {head}")) if re.match(rf"{measure['id']}\b", text)
    )
    texts = {row[column] for row in reader.rows("#measures-table")}
    assert texts == {rounded_figure(figure) for figure in figures}


def test_a_share_is_the_same_in_sentences_and_in_tables_of_the_script(reader, study, tmp_path):
    shares = [0.125, 0.135, 0.0, 1.0, 0.99962, 0.9961, 0.0004, 0.0125, 0.456, 0.995]
    document = copy.deepcopy(study.document)
    acceptability = document["decision"]["acceptability"]
    like = acceptability["variants"][0]
    acceptability["variants"] = [like | {"variant": place + 1, "first": one} for place, one in enumerate(shares)]
    _opened(reader, document, study, tmp_path)
    reader.script("document.getElementById('acceptability-table').closest('details').open = true")
    reader.until("return document.querySelectorAll('#acceptability-table tbody tr').length > 0")
    assert {row[1] for row in reader.rows("#acceptability-table")} == {share_in_words(one) for one in shares}


def test_a_limit_of_thousands_has_separators_everywhere(reader, page, study):
    limits = [(one["criterion"], one["threshold"]) for one in study.document["requirements"]]
    large = [(text, limit) for text, limit in limits if abs(limit) >= 1e4]
    assert large
    for text, limit in large:
        assert exact_figure(limit) in text
    reader.open(page)
    said = reader.script("return document.querySelector('main').textContent")
    for _, limit in large:
        assert not re.search(rf"[<>]=? {limit:.0f}\b", said)


def test_with_the_colours_of_the_reader_legends_and_the_present_section_are_told_apart(reader, page):
    media = {"features": [{"name": "forced-colors", "value": "active"}]}
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", media)
    try:
        reader.open(page)
        reader.until("return document.querySelector('#contents a[aria-current]') !== null")
        borders = reader.script(
            "const colour = (one) => getComputedStyle(one).borderLeftColor;"
            "return Array.from(document.querySelectorAll('#contents a'), colour)"
        )
        swatches = reader.script(
            "const colour = (one) => getComputedStyle(one).borderTopColor;"
            "return Array.from(document.querySelectorAll('#legend .swatch'), colour)"
        )
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert sorted(map(borders.count, set(borders))) == [1, len(borders) - 1]
    assert len(set(swatches)) == len(swatches) > 1
