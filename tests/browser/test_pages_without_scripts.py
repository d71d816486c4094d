"""A report in a browser that runs no scripts: what it says, what it leaves out, and that nothing hides the decision."""

from __future__ import annotations

import pytest

from rgss.reports.study_page import study_report_to_html

pytestmark = pytest.mark.browser

_PARTS = """
const box = (one) => one.getBoundingClientRect();
const seen = (one) => getComputedStyle(one).display !== 'none' && box(one).height > 0;
const sections = Array.from(document.querySelectorAll('main > section'));
const nav = box(document.querySelector('#contents nav')), title = box(document.querySelector('#glance h2'));
return {
  empty: sections.filter((one) => seen(one) && one.querySelector('select:empty, .plot:empty')).map((one) => one.id),
  shown: sections.filter(seen).map((one) => one.id),
  linked: Array.from(document.querySelectorAll('#contents > nav > ul > li')).filter(seen)
    .map((one) => one.querySelector('a').hash.slice(1)),
  covered: nav.right > title.left && nav.left < title.right && nav.bottom > title.top && nav.top < title.bottom,
  wide: document.documentElement.scrollWidth > document.documentElement.clientWidth,
};
"""

# Links that can be seen and pressed, whose target cannot be seen.
_LOST = """
return Array.from(document.querySelectorAll('main a[href^="#"]'))
  .filter((one) => one.getClientRects().length && getComputedStyle(one).pointerEvents !== 'none')
  .filter((one) => document.getElementById(decodeURIComponent(one.hash.slice(1)))?.closest('.scripted') !== null)
  .map((one) => one.hash);
"""


@pytest.mark.parametrize("width", [1440, 1024, 390])
def test_without_scripts_a_report_shows_the_decision_and_says_what_is_missing(reader, study, tmp_path, width):
    page = tmp_path / "report.html"
    text = study_report_to_html(study.document, study.trace)
    # As the page is read: no script runs, and the texts for that case are markup.
    quiet = text.replace("<noscript>", "<div>").replace("</noscript>", "</div>").replace("<script>", "<script type=x>")
    page.write_text(quiet, encoding="utf-8")
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    )
    reader.driver.get(page.as_uri())
    found = reader.script(_PARTS)
    assert (found["covered"], found["wide"]) == (False, False)
    # The section on planning has a table of its own, where the planners were compared.
    assert set(found["empty"]) <= {"planning"}
    assert {"glance", "decision", "sensitivity", "traceability", "provenance"} <= set(found["shown"])
    assert not {"verdicts", "explore", "evidence", "weights"} & set(found["shown"])
    assert set(found["linked"]) <= set(found["shown"])
    assert "JavaScript, which this page contains, is off." in reader.text("#without-scripts")
    assert reader.script("return document.getElementById('glance').innerText").startswith("Variant ")
    assert reader.script(_LOST) == []
