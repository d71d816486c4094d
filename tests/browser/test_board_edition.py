"""The board edition as a browser prints it."""

from __future__ import annotations

import base64
import dataclasses
import re

import pytest

from rgss.reports.board_page import MOST_PAGES, board_to_html

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

    assert 3 <= printed_pages(reader, file) <= MOST_PAGES
    assert reader.complaints() == []


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
