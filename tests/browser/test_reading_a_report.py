"""A reader who has the page alone answers the questions of a decision with few clicks."""

from __future__ import annotations

import dataclasses

import pytest
from selenium.webdriver.common.by import By

from rgss.reports import study_page
from rgss.reports.diagrams import diagrams_of, drawings_for_page
from rgss.reports.study_page import study_report_to_html
from rgss.studies.project import load_project

pytestmark = pytest.mark.browser

WHY = "Of 7 failed trials of variant 7, the most frequent kind, arm collision, 3, and of it the smallest seed."
HIGHEST = 15_000
"""Pixels of the page at a width of 1,440, with everything but the tables of evidence folded as it opens."""


@pytest.fixture(scope="module")
def whole_page(study, pictures, tmp_path_factory):
    """The report with its diagrams, and with pictures of a trial that failed."""
    failed = dataclasses.replace(pictures[0], title="Variant 7, seed 2: worst", failed=True, worst=WHY)
    other = dataclasses.replace(failed, title="Variant 1, seed 1: first that failed", worst="")
    requirements = load_project(study.folder).requirements
    file = tmp_path_factory.mktemp("whole") / "report.html"
    html = study_report_to_html(
        study.document,
        study.trace,
        drawings=drawings_for_page(diagrams_of(requirements)),
        pictures=(*pictures, other, failed),
    )
    file.write_text(html, encoding="utf-8")
    return file


class Clicks:
    """A reader's clicks, counted; what is not in sight must be led to by them."""

    def __init__(self, reader) -> None:
        self.reader, self.count = reader, 0

    def on(self, element) -> None:
        # Selenium scrolls to what is clicked; a reader would have to look for it.
        assert self.sees(element), element.text
        element.click()
        self.count += 1

    def sees(self, element) -> bool:
        # A jump may be on its way.
        self.reader.until(
            "const box = arguments[0].getBoundingClientRect();"
            "return box.height > 0 && box.top < innerHeight && box.bottom > 0",
            element,
        )
        return True


def find(reader, selector: str):
    return reader.driver.find_element(By.CSS_SELECTOR, selector)


def test_five_questions_are_answered_in_two_clicks_each(reader, whole_page, study):
    decision = study.document["decision"]

    def opened() -> Clicks:
        reader.driver.get("about:blank")
        reader.open(whole_page, width=1440)
        return Clicks(reader)

    clicks = opened()
    which = find(reader, "#glance-title")
    assert clicks.sees(which)
    assert str(decision["chosen"]) in which.text
    design = find(reader, "#glance-design")
    assert clicks.sees(design)
    place = study.document["variants"]["id"].index(decision["chosen"])
    planner = next(one for one in study.document["parameters"] if one["name"] == "planner")
    assert f"planner {planner['values'][place]}" in design.text
    rivals = [one for one in decision["ties"] if one != decision["chosen"]]
    rivals += [one for one in decision["rivals"] if one not in rivals]
    assert rivals
    assert which.text.partition("tied with ")[2].startswith(", ".join(map(str, rivals[:4])))
    is_open, would_change = reader.driver.find_elements(By.CSS_SELECTOR, ".glance-lists h3")
    assert (is_open.text, would_change.text) == ("What is open", "What would change it")
    assert clicks.sees(is_open)
    assert clicks.sees(would_change)
    assert clicks.count == 0
    clicks.on(find(reader, ".glance-lists .reasons a"))
    assert clicks.sees(find(reader, reader.script("return location.hash")))
    assert clicks.count == 1

    clicks = opened()
    clicks.on(reader.driver.find_element(By.LINK_TEXT, "Why this design"))
    assert clicks.sees(find(reader, "#why + .reasons"))
    assert find(reader, "#why + .reasons").text.splitlines()[0] == decision["reasons"][0]
    assert clicks.count == 1

    clicks = opened()
    worst = study.document["trials"]["worst"]["why"]
    assert clicks.sees(find(reader, "#worst-why"))
    assert worst in find(reader, "#worst-why").text
    clicks.on(reader.driver.find_element(By.PARTIAL_LINK_TEXT, "The worst failure"))
    figure = find(reader, "#worst-failure")
    assert "Variant 7, seed 2: worst" in figure.text
    assert WHY in figure.text
    clicks.on(figure.find_element(By.XPATH, ".//summary[. = 'Replay in three dimensions']"))
    reader.until("return document.querySelector('#worst-failure [data-replay]').dataset.state === 'ready'")
    assert clicks.count == 2
    assert [one for one in reader.complaints() if "GL Driver Message" not in one] == []
    assert reader.requests() == []


def test_the_page_is_folded_and_what_a_link_leads_to_is_unfolded(reader, whole_page):
    reader.open(whole_page, width=1440)
    reader.see_all_plots()
    assert reader.script("return document.documentElement.scrollHeight") < HIGHEST
    # Nothing of a diagram is laid out before it is wanted.
    shown = "return [...document.querySelectorAll('#diagrams figure')].filter((one) => one.checkVisibility()).length"
    assert reader.script(shown) == 0
    count = reader.script("return document.querySelectorAll('#diagrams figure').length")
    assert count > 5
    anchor = reader.script("return document.querySelectorAll('#diagrams figure')[3].id")
    reader.script("location.hash = arguments[0]", f"#{anchor}")
    reader.until(f"{shown} === 1")
    # The filter of the traceability shows what fits, also where it is folded.
    search = find(reader, "#search")
    reader.script("arguments[0].scrollIntoView({block: 'center'})", search)
    search.send_keys("SYS-024")
    reader.until("return document.querySelector('#verification details.fold').open")
    assert reader.complaints() == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_titles_of_folds_look_alike(reader, whole_page, scheme):
    media = {"features": [{"name": "prefers-color-scheme", "value": scheme}]}
    reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", media)
    try:
        reader.open(whole_page)
        colours = reader.script(
            "return Array.from(new Set(Array.from(document.querySelectorAll("
            "'main > section > details > summary'), (one) => getComputedStyle(one).color)))"
        )
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert len(colours) == 1


@pytest.mark.parametrize(("number", "seen"), [(5, 5), (11, 4)])
def test_what_would_change_the_choice_is_in_sight_however_much_is_open(
    reader, study, tmp_path, monkeypatch, number, seen
):
    def opened(document):
        glance = content_before(document)
        many = [{**glance["open"][0], "text": f"Demand {place}."} for place in range(number)]
        return {**glance, "open": many, "missed": []}

    content_before = study_page.first_screen_content
    monkeypatch.setattr(study_page, "first_screen_content", opened)
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(study.document, study.trace), encoding="utf-8")
    reader.open(file, width=1440)

    def texts() -> list[str]:
        found = reader.driver.find_elements(By.CSS_SELECTOR, ".glance-lists .reasons:not(#glance-changes) li")
        return [one.text.partition(": ")[2] for one in found if one.is_displayed()]

    assert texts() == [f"Demand {place}." for place in range(seen)]
    if seen < number:
        fold = find(reader, "#more-open summary")
        assert fold.text == f"{number - seen} more are open"
        fold.click()
        assert texts() == [f"Demand {place}." for place in range(number)]
