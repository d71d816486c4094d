"""A page for each diagram: opened by link and address, zoomed, moved and closed, by pointer and by keys alone."""

from __future__ import annotations

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from rgss.reports.diagrams import diagrams_of, drawings_for_page
from rgss.reports.study_page import study_report_to_html
from rgss.reports.trace.html import report_to_html
from rgss.studies.project import load_project

pytestmark = pytest.mark.browser

OPEN = "return document.querySelector('dialog.diagram-page').open"
NOW = "return new DOMMatrix(getComputedStyle(document.querySelector('.diagram-view svg')).transform).toJSON()"


@pytest.fixture(scope="module", params=["trace", "report"])
def diagram_page(request, study, tmp_path_factory):
    """The two pages that have diagrams, with three of them."""
    drawings = drawings_for_page(diagrams_of(load_project(study.folder).requirements)[1:4])
    if request.param == "trace":
        html = report_to_html(study.trace, drawings=drawings)
    else:
        html = study_report_to_html(study.document, study.trace, drawings=drawings)
    file = tmp_path_factory.mktemp("diagrams") / f"{request.param}.html"
    file.write_text(html, encoding="utf-8")
    return file, [drawing["anchor"] for drawing in drawings]


def loaded(reader, diagram_page):
    """The anchors of the diagrams of a page that is open."""
    file, anchors = diagram_page
    reader.driver.get("about:blank")
    reader.complaints()
    reader.requests()
    reader.driver.set_window_size(1440, 900)
    reader.driver.get(file.as_uri())
    reader.until("return document.querySelector('dialog.diagram-page') !== null")
    return anchors


def opened(reader, diagram_page):
    anchors = loaded(reader, diagram_page)
    reader.script("location.hash = arguments[0]", f"#page-{anchors[0]}")
    reader.until(OPEN)
    return anchors


def press(reader, *keys):
    ActionChains(reader.driver).send_keys(*keys).perform()


def test_a_link_opens_the_page_and_escape_leads_back(reader, diagram_page):
    anchors = loaded(reader, diagram_page)
    link = reader.driver.find_elements(By.CSS_SELECTOR, "a[data-page-of]")[0]
    reader.script(
        "for (let one = arguments[0]; one; one = one.parentElement) if (one.tagName === 'DETAILS') one.open = true",
        link,
    )
    reader.script("arguments[0].focus()", link)
    press(reader, Keys.ENTER)
    reader.until(OPEN)
    assert reader.script("return location.hash") == f"#page-{anchors[0]}"
    assert reader.script("return document.activeElement.className") == "diagram-view"
    # The drawing is in sight in its whole width, from its beginning.
    inner, outer = reader.script(
        "const a = document.querySelector('.diagram-view svg').getBoundingClientRect();"
        "const b = document.querySelector('.diagram-view').getBoundingClientRect();"
        "return [[a.left, a.top, a.right, a.bottom], [b.left, b.top, b.right, b.bottom]]"
    )
    assert outer[0] - 2 <= inner[0] < inner[2] <= outer[2] + 2
    assert outer[1] - 2 <= inner[1] < outer[3]
    press(reader, Keys.ESCAPE)
    reader.until("return !document.querySelector('dialog.diagram-page').open")
    assert reader.script("return document.activeElement === arguments[0]", link)
    assert reader.script("return location.hash") == f"#{anchors[0]}"
    # The drawing is where it was, as it was.
    assert reader.script("return document.querySelectorAll('.drawing > svg').length") == len(anchors)
    assert reader.script("return document.querySelector('.drawing > svg').style.transform") == ""
    assert reader.complaints() == []
    assert [one for one in reader.requests() if one != diagram_page[0].as_uri()] == []


def test_keys_zoom_and_move(reader, diagram_page):
    opened(reader, diagram_page)
    first = reader.script(NOW)
    press(reader, "+", "+")
    assert reader.script(NOW)["a"] == pytest.approx(first["a"] * 1.25**2, rel=1e-3)
    press(reader, "-", "-")
    back = reader.script(NOW)
    assert back["a"] == pytest.approx(first["a"], rel=1e-3)
    press(reader, Keys.ARROW_LEFT, Keys.ARROW_UP)
    moved = reader.script(NOW)
    assert (moved["e"], moved["f"]) == pytest.approx((back["e"] + 60, back["f"] + 60), abs=0.01)
    press(reader, "1")
    assert reader.script(NOW)["a"] == pytest.approx(1, rel=1e-3)
    assert reader.script("return document.querySelector('.diagram-bar output').textContent") == "100 %"


def test_the_pointer_zooms_about_itself_and_drags(reader, diagram_page):
    opened(reader, diagram_page)
    view = reader.driver.find_element(By.CSS_SELECTOR, ".diagram-view")
    first = reader.script(NOW)
    box = reader.script("const b = arguments[0].getBoundingClientRect(); return [b.width, b.height]", view)
    # An event has whole pixels; the view may begin between two.
    place = reader.script(
        "const b = arguments[0].getBoundingClientRect();"
        "const [x, y] = [Math.round(b.left) + 100, Math.round(b.top) + 80];"
        "arguments[0].dispatchEvent(new WheelEvent('wheel', {deltaY: -200, ctrlKey: true, clientX: x,"
        " clientY: y, cancelable: true}));"
        "return [x - b.left - arguments[0].clientLeft, y - b.top - arguments[0].clientTop]",
        view,
    )
    zoomed = reader.script(NOW)
    assert zoomed["a"] > first["a"] * 1.3
    # What was below the pointer still is.
    for at, axis in zip(place, "ef", strict=True):
        assert (at - zoomed[axis]) / zoomed["a"] == pytest.approx((at - first[axis]) / first["a"], abs=0.1)
    ActionChains(reader.driver).move_to_element_with_offset(view, 0, 0).click_and_hold().move_by_offset(
        40, -30
    ).release().perform()
    dragged = reader.script(NOW)
    assert (dragged["e"] - zoomed["e"], dragged["f"] - zoomed["f"]) == pytest.approx((40, -30), abs=1)
    assert min(box) > 300


def test_a_drawing_that_is_larger_than_the_page_is_opened_readable_and_scrolled(reader, diagram_page):
    anchors = loaded(reader, diagram_page)
    # Tall and narrow, as a diagram of activities is: twice the height of the page.
    reader.script(
        "const one = document.querySelector('.drawing > svg'); one.setAttribute('viewBox', '0 0 500 1800');"
        "location.hash = arguments[0]",
        f"#page-{anchors[0]}",
    )
    reader.until(OPEN)
    wheel = (
        "document.querySelector('.diagram-view').dispatchEvent("
        "new WheelEvent('wheel', {deltaY: arguments[0], cancelable: true}))"
    )
    height = reader.script("return document.querySelector('.diagram-view').clientHeight")
    first = reader.script(NOW)
    assert 1 <= first["a"] <= 1.25
    assert first["f"] == 0
    reader.script(wheel, 120)
    assert reader.script(NOW)["f"] == pytest.approx(-120, abs=0.01)
    assert reader.script(NOW)["a"] == first["a"]
    reader.script(wheel, 9000)
    assert reader.script(NOW)["f"] == pytest.approx(height - first["a"] * 1800, abs=0.1)
    reader.script(wheel, -9000)
    assert reader.script(NOW)["f"] == pytest.approx(0, abs=0.01)
    # The whole is a key away.
    press(reader, "0")
    assert reader.script(NOW)["a"] == pytest.approx(height / 1800, rel=1e-3)


def test_each_diagram_has_its_address(reader, diagram_page):
    anchors = opened(reader, diagram_page)
    titles = []
    for anchor in anchors:
        assert reader.script("return location.hash") == f"#page-{anchor}"
        titles.append(reader.script("return document.getElementById('diagram-page-title').textContent"))
        press(reader, Keys.PAGE_DOWN)
    assert len(set(titles)) == len(anchors)
    assert reader.script("return location.hash") == f"#page-{anchors[0]}"
    # The page is opened where it is sent.
    address = reader.driver.current_url
    reader.driver.get("about:blank")
    reader.driver.get(address)
    reader.until(OPEN)
    assert reader.script("return document.getElementById('diagram-page-title').textContent") == titles[0]


def test_nothing_serious_is_found_by_axe(reader, diagram_page):
    opened(reader, diagram_page)

    assert reader.accessibility_findings() == []
