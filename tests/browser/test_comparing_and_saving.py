"""Variants side by side, distributions of the measures, and plots as files, driven as a reader would."""

from __future__ import annotations

import csv
import struct
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pandas as pd
import pytest
from selenium.webdriver.common.by import By

from rgss.reports.study_page import study_report_to_html
from tests.fixtures.processes import wait_until

pytestmark = pytest.mark.browser


def name(reader, text: str) -> None:
    field = reader.driver.find_element(By.ID, "compare-choice")
    field.clear()
    field.send_keys(text)


def columns(reader) -> list[str]:
    return reader.script(
        "return Array.from(document.querySelectorAll('#compare-table thead th'), (one) => one.textContent)"
    )[2:]


def test_any_variants_are_compared_side_by_side(reader, page, study):
    reader.open(page)
    document = study.document
    chosen = document["decision"]["chosen"]
    assert columns(reader)[0] == f"{chosen} (chosen)"
    assert len(columns(reader)) == 2

    name(reader, "31, 4 55,7")
    reader.until("return document.querySelectorAll('#compare-table thead th').length === 6")
    assert columns(reader) == ["31", "4", "55", "7"]
    places = [document["variants"]["id"].index(one) for one in (31, 4, 55, 7)]
    rows = {row[0]: row[2:] for row in reader.rows("#compare-table")}
    for parameter in document["parameters"]:
        values = parameter["values"]
        there = [values[place] if isinstance(values, list) else values for place in places]
        assert (parameter["name"] in rows) == (len(set(map(str, there))) > 1)
    cost = next(one for one in document["measures"] if one["id"] == "C_total")
    figures = [cost["value"][place] for place in places]
    marked = ["★" in text for text in rows[f"C_total: {cost['name']}"]]
    assert marked == [one == min(figures) for one in figures]

    reader.driver.find_element(By.ID, "compare-differing").click()
    assert len(reader.rows("#compare-table")) > len(rows)
    name(reader, "31, 999")
    reader.until("return document.getElementById('compare-note').textContent === 'Unknown variant 999.'")
    assert columns(reader) == ["31"]
    assert reader.complaints() == []


def test_a_variant_is_added_from_its_evidence_and_the_comparison_is_sent(reader, page):
    reader.open(page)
    reader.script("location.hash = '#variant-31'")
    reader.until("return document.getElementById('variant-choice').value === '31'")
    reader.driver.find_element(By.ID, "variant-compare").click()
    reader.until("return location.hash.includes('compare=')")
    sent = reader.script("return location.hash")
    shown = columns(reader)
    assert shown[-1] == "31"
    reader.driver.get("about:blank")
    reader.driver.get(page.as_uri() + sent)
    reader.until("return document.documentElement.dataset.ready === 'yes'")
    assert columns(reader) == shown


def test_distributions_have_the_quartiles_of_each_measure(reader, page, study):
    reader.open(page)
    reader.script("document.querySelector('#distributions details').open = true")
    reader.script("document.getElementById('distributions-plot').scrollIntoView()")
    reader.until("return document.getElementById('distributions-plot').data?.length > 0")
    rows = {row[0].split(" [")[0]: row for row in reader.rows("#distributions-table")}
    boxes = reader.script(
        "return document.getElementById('distributions-plot').data.filter((one) => one.type === 'box')"
        ".map((one) => [one.y[0], one.x.length])"
    )
    assert len(boxes) == len(rows) >= 4
    for measure in study.document["measures"]:
        if measure["id"] not in rows or not isinstance(measure["value"], list):
            continue
        values = [one for one in measure["value"] if one is not None]
        shown = [float(one.replace(",", "")) for one in rows[measure["id"]][3:]]
        assert shown == pytest.approx(np.percentile(values, (0, 25, 50, 75, 100)), rel=2e-3)
        assert dict(map(tuple, boxes))[measure["id"]] == len(values)

    reader.script(
        "const by = document.getElementById('distribution-by'); by.value = '-role';"
        "by.dispatchEvent(new Event('change'))"
    )
    reader.until("return document.querySelectorAll('#distributions-table tbody tr').length > arguments[0]", len(rows))
    assert reader.complaints() == []


def saved(folder: Path, file: str) -> bytes:
    """A downloaded file once it is whole; the browser gives it its name then."""
    wait_until(lambda: (folder / file).exists() and (folder / file).stat().st_size > 0)
    return (folder / file).read_bytes()


@pytest.mark.parametrize("plot", ["parallel", "pareto", "distributions"])
def test_a_plot_is_saved_as_png_svg_and_csv(reader, page, study, tmp_path, plot):
    reader.open(page)
    reader.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    for kind in ("PNG", "SVG", "CSV"):
        button = reader.driver.find_element(By.CSS_SELECTOR, f"button[aria-label='Save {plot} as {kind}']")
        reader.script("arguments[0].scrollIntoView({block: 'center'}); arguments[0].click()", button)
    stem = f"{study.document['study']}-{plot}"

    picture = saved(tmp_path, f"{stem}.png")
    assert picture.startswith(b"\x89PNG")
    width, height = struct.unpack(">II", picture[16:24])
    drawing = ET.fromstring(saved(tmp_path, f"{stem}.svg"))  # noqa: S314 - of our own page
    assert [width, height] == [2 * int(float(drawing.get(one))) for one in ("width", "height")]
    assert "".join(drawing.itertext()).count("t_e") >= 1
    rows = list(csv.reader(saved(tmp_path, f"{stem}.csv").decode("utf-8").splitlines()))
    assert len({len(row) for row in rows}) == 1
    if plot == "parallel":
        assert sorted(int(row[0]) for row in rows[1:]) == study.document["variants"]["id"]
        head = rows[0].index("value")
        values = dict(zip(study.document["variants"]["id"], study.document["variants"]["value"], strict=True))
        assert all(float(row[head]) == values[int(row[0])] for row in rows[1:] if row[head])
    assert reader.complaints() == []
    assert reader.requests() == []


TEXTS = {
    "acceptability": [],
    "compare": ["of the variant", "kind", "unit"],
    "distributions": ["measure", "of"],
    "effects": ["factor", "level"],
    "failures": ["failure", "in the phase", "see the first"],
    "measures": ["role"],
    "pareto": ["role", "support"],
    "planning": ["planner"],
    "timeline": ["phase", "outcome"],
    "weights": [],
}


def test_numbers_of_a_file_are_numbers_and_intervals_have_columns(reader, page, study, tmp_path):
    reader.open(page)
    reader.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(tmp_path)})
    reader.script("document.getElementById('compare-differing').click()")
    frames = {}
    for plot in TEXTS:
        reader.script("document.querySelector(arguments[0]).click()", f"button[aria-label='Save {plot} as CSV']")
        file = f"{study.document['study']}-{plot}.csv"
        saved(tmp_path, file)
        frames[plot] = pd.read_csv(tmp_path / file)

    for plot, texts in TEXTS.items():
        found = frames[plot].columns.difference(frames[plot].select_dtypes("number").columns, sort=False)
        # Variants side by side have texts, such as planners and verdicts, in the rows of numbers.
        assert list(found)[: len(texts)] == texts, plot
        assert plot == "compare" or len(found) == len(texts), plot
    ids = study.document["variants"]["id"]
    measures = frames["measures"].set_index("Variant")
    uncertain = [one for one in study.document["measures"] if one["from_trials"] and one["weight"] is not None]
    assert uncertain
    for one in uncertain:
        for end, name in (("value", ""), ("low", " low"), ("high", " high")):
            unit = "" if one["unit"] == "1" else f" [{one['unit']}]"
            column = one[end] if isinstance(one[end], list) else [one[end]] * len(ids)
            wanted = [np.nan if value is None else value for value in column]
            assert measures.loc[ids, f"{one['id']}{name}{unit}"].tolist() == pytest.approx(wanted, nan_ok=True)
    effects = frames["effects"]
    assert (effects["effect low"] <= effects["effect"]).all()
    assert (effects["effect"] <= effects["effect high"]).all()
    compared = frames["compare"].set_index("of the variant")
    price = next(name for name in compared.index if name.startswith("C_total"))
    chosen = f"{study.document['decision']['chosen']}"
    prices = next(one for one in study.document["measures"] if one["id"] == "C_total")["value"]
    assert float(compared.loc[price, chosen]) == prices[ids.index(int(chosen))]
    assert compared.loc[price, "unit"] == "USD"


def test_of_one_variant_nothing_is_compared(reader, lone_study, tmp_path):
    assert len(lone_study.document["variants"]["id"]) == 1
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(lone_study.document, lone_study.trace), encoding="utf-8")
    assert "It is the only variant of the study." in file.read_text(encoding="utf-8")
    reader.open(file)
    reader.see_all_plots()

    assert reader.text("#shown") == "The one variant is shown"
    # What compares variants is neither shown nor listed nor found.
    compares = ("explore", "pareto", "distributions", "compare", "acceptability", "effects")
    for one in (*compares, "variant-compare", "clear"):
        assert not reader.driver.find_element(By.ID, one).is_displayed()
    assert not {f"#{one}" for one in compares} & set(
        reader.script("return Array.from(document.querySelectorAll('#contents a, a.skip'), (one) => one.hash)")
    )
    reader.script(
        "const field = document.getElementById('find'); field.value = 'acceptability';"
        "field.dispatchEvent(new Event('input')); "
    )
    reader.until("return document.getElementById('found-count').textContent !== ''")
    assert not reader.script("return document.querySelector('#found a[href=\"#acceptability-title\"]')")
    sensitivity = reader.text("#sensitivity")
    assert "has no feasible rival" in sensitivity
    assert "over the best other design" not in sensitivity
    assert "Designs worth keeping" not in sensitivity
    assert reader.complaints() == []
