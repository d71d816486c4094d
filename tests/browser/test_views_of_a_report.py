"""Views that can be sent: filters, weights and choices in the address; marks that coincide; axes."""

from __future__ import annotations

import copy
import re

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from rgss.reports.study_page import study_report_to_html
from rgss.studies import load_project
from tests.fixtures.shipped_project import REPOSITORY

pytestmark = pytest.mark.browser


def address(reader) -> str:
    return reader.script("return location.hash")


def move(reader, index: int, to: float) -> None:
    reader.script(
        "const slider = document.getElementById(arguments[0]);"
        "slider.value = String(arguments[1]); slider.dispatchEvent(new Event('input'))",
        f"weight-{index}",
        to,
    )


def weights(reader) -> list[float]:
    texts = reader.script("return Array.from(document.querySelectorAll('#weight-rows output'), (one) => one.value)")
    return [float(one) for one in texts]


def choose(reader, choice: str, value: str) -> None:
    reader.script(
        "const choice = document.getElementById(arguments[0]);"
        "choice.value = arguments[1]; choice.dispatchEvent(new Event('change'))",
        choice,
        value,
    )


def seen(reader) -> list:
    return [
        reader.text("#shown"),
        weights(reader),
        [row[:3] for row in reader.rows("#ranking-table")],
        reader.script(
            "return ['measure-choice', 'pareto-x', 'pareto-y', 'effect-choice', 'variant-choice']"
            ".map((id) => document.getElementById(id).value)"
        ),
    ]


def test_a_view_is_sent_by_its_address(reader, page, study):
    reader.open(page)
    assert address(reader) == ""
    opened = seen(reader)
    slider = reader.driver.find_element(By.CSS_SELECTOR, "input[aria-label='gripper fingers to']")
    reader.script("document.getElementById('axis-ends').open = true")
    slider.send_keys(Keys.HOME)
    move(reader, 1, 0.6)
    choose(reader, "measure-choice", "P_max")
    choose(reader, "variant-choice", "31")
    reader.until(
        "return ['only=', 'weights=', 'measure=P_max', 'variant=31'].every((one) => location.hash.includes(one))"
    )
    sent, view = address(reader), seen(reader)
    assert view[0] == "36 of 72 variants are shown"

    reader.open(page)
    assert seen(reader) == opened
    reader.driver.get("about:blank")
    reader.driver.get(page.as_uri() + sent)
    reader.until("return document.documentElement.dataset.ready === 'yes'")
    assert seen(reader) == view
    # A link within the page keeps the view, and the way back to how it opened empties the address.
    reader.driver.find_element(By.CSS_SELECTOR, "#contents a[href='#pareto']").click()
    reader.until("return location.hash.startsWith('#pareto?') && location.hash.includes('weights=')")
    assert seen(reader) == view
    reader.driver.find_element(By.ID, "clear").click()
    reader.driver.find_element(By.ID, "weight-reset").click()
    choose(reader, "measure-choice", opened[3][0])
    choose(reader, "variant-choice", opened[3][4])
    reader.until("return location.hash === '#pareto'")
    assert reader.complaints() == []
    assert reader.requests() == []


@pytest.mark.parametrize(
    ("sent", "named"),
    [
        ("#?only=zz:0:1&weights=x", ["only=zz:0:1 (no axis zz)", "no weight in this study: x"]),
        ("#?only=d8:5:1&weights=t_p:-1", ["only=d8:5:1", "weights=t_p:-1 (not numbers of 0 or more, one above 0)"]),
        ("#?measure=zz&variant=99999&%E0%A4%A&compare=", ["measure=zz", "variant=99999"]),
        ("#?only=&weights=,,", ["only=", "weights=,,"]),
        ("#?weights=t_m:0.6,C_total:0.4", ["weights=t_m:0.6,C_total:0.4 (no weight in this study: t_m)"]),
        ("#?weights=t_p:", ["weights=t_p:"]),
    ],
)
def test_an_address_that_makes_no_sense_opens_the_page_as_it_is_and_says_so(reader, page, sent, named):
    reader.open(page)
    opened = seen(reader)
    reader.driver.get("about:blank")
    reader.driver.get(page.as_uri() + sent)
    reader.until("return document.documentElement.dataset.ready === 'yes'")

    assert seen(reader) == opened
    note = reader.text("#address-note")
    assert note.startswith("Ignored of the address: ")
    assert [one for one in named if one not in note] == []
    assert reader.complaints() == []


def test_the_ends_of_an_axis_keep_the_variants_at_them(reader, page):
    """A rounded end in an address would lie within the axis, and leave out the best variant."""
    reader.open(page)
    reader.script("document.getElementById('axis-ends').open = true")
    sliders = reader.driver.find_elements(By.CSS_SELECTOR, "#axis-ends input[type=range][aria-label$=' from']")
    assert len(sliders) > 3
    for name in [slider.get_attribute("aria-label") for slider in sliders[-4:]]:
        reader.open(page)
        reader.script("document.getElementById('axis-ends').open = true")
        slider = reader.driver.find_element(By.CSS_SELECTOR, f"input[aria-label='{name}']")
        slider.send_keys(Keys.END)
        reader.until("return location.hash.includes('only=')")
        sent, view = address(reader), seen(reader)
        reader.driver.get("about:blank")
        reader.driver.get(page.as_uri() + sent)
        reader.until("return document.documentElement.dataset.ready === 'yes'")
        assert seen(reader)[0] == view[0], name
        assert reader.text("#address-note") == "", name


def test_the_address_in_the_docs_shows_its_variants_and_weights(reader, study, tmp_path):
    """The page has the weights of the study as it is shipped; that of the other tests is of the nominal world."""
    shipped = list(load_project(REPOSITORY).study.trade_off.weighting.weights)
    document = copy.deepcopy(study.document)
    for one, name in zip(document["weights"]["measures"], shipped, strict=True):
        one["id"] = name
    page = tmp_path / "report.html"
    page.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    (sent,) = re.findall(r"`report\.html(#\S+&weights=\S+)`", (REPOSITORY / "docs/report.md").read_text("utf-8"))
    given = {one.split(":")[0]: float(one.split(":")[1]) for one in sent.split("weights=")[1].split(",")}
    axis, low, high = re.search(r"only=(\w+):(\w+):(\w+)", sent).groups()
    column = next(one["values"] for one in study.document["parameters"] if one["id"] == axis)
    reader.open(page)
    reader.driver.get("about:blank")
    reader.driver.get(page.as_uri() + sent)
    reader.until("return document.documentElement.dataset.ready === 'yes'")

    assert set(given) < set(shipped)
    assert weights(reader) == [given.get(name, 0.0) for name in shipped]
    assert low == high
    assert reader.text("#shown") == f"{column.count(low)} of {len(column)} variants are shown"
    assert reader.text("#address-note") == ""


def test_weights_sum_to_one_as_they_are_moved_and_those_at_0_return(reader, page):
    reader.open(page)
    first = weights(reader)
    for to in (0.3, 1.0, 0.0, 0.77):
        move(reader, 2, to)
        assert weights(reader)[2] == to
        assert sum(weights(reader)) == pytest.approx(1.0, abs=0.003)
    # After 1.0 the others have the proportions that they had before.
    others = [one for index, one in enumerate(first) if index != 2]
    now = [one for index, one in enumerate(weights(reader)) if index != 2]
    assert now == pytest.approx([0.23 * one / sum(others) for one in others], abs=0.001)


def test_marks_that_coincide_are_one_mark_that_names_all(reader, page, study):
    reader.open(page)
    reader.script("document.getElementById('pareto-plot').scrollIntoView()")
    reader.until("return document.getElementById('pareto-plot').data?.length > 0")
    traces = reader.script(
        "return document.getElementById('pareto-plot').data.map((one) => [one.x, one.y, one.text, one.hovertext])"
    )
    marks = [mark for trace in traces for mark in zip(*trace, strict=True)]
    names = study.document["variants"]["id"]
    measures = {one["id"]: one for one in study.document["measures"]}
    across, up = reader.script("return ['pareto-x', 'pareto-y'].map((id) => document.getElementById(id).value)")

    def known(place):
        columns = [measures[name]["value"] for name in (across, up)]
        return all((column[place] if isinstance(column, list) else column) is not None for column in columns)

    counted = sum(int(text[1:]) if text else 1 for _, _, text, _ in marks)
    assert counted == sum(known(place) for place in range(len(names)))
    # No two marks are nearer than a mark is large.
    width = max(one[0] for one in marks) - min(one[0] for one in marks)
    height = max(one[1] for one in marks) - min(one[1] for one in marks)
    for index, one in enumerate(marks):
        for other in marks[index + 1 :]:
            assert abs(one[0] - other[0]) > width / 95 or abs(one[1] - other[1]) > height / 48
    largest = max(marks, key=lambda one: int(one[2][1:]) if one[2] else 1)
    assert largest[2]
    assert largest[3].startswith("variants ") or "<br>variant" in largest[3]


def test_axes_say_which_end_is_better(reader, page, study):
    reader.open(page)
    reader.script("document.getElementById('pareto-plot').scrollIntoView()")
    reader.until("return document.getElementById('pareto-plot').data?.length > 0")
    across = reader.script("return document.getElementById('pareto-x').value")
    better = next(one for one in study.document["measures"] if one["id"] == across)["better"]
    assert reader.script("return document.getElementById('pareto-plot').layout.xaxis.title.text").endswith(
        f", {better} is better"
    )
