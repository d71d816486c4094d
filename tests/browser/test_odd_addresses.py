"""Addresses and words that make no sense: the page says what it ignores, without an error; files saved in the dark."""

from __future__ import annotations

import base64
import xml.etree.ElementTree as ET

import pytest
from selenium.webdriver.common.by import By

pytestmark = pytest.mark.browser

SVG = "{http://www.w3.org/2000/svg}"


def follow(reader, sent: str) -> str:
    """The note on an address, once it was followed within the page."""
    reader.script("location.hash = '#decision'")
    reader.until("return document.getElementById('address-note').textContent === ''")
    reader.script("location.hash = arguments[0]", sent)
    reader.until("return document.getElementById('address-note').textContent !== ''")
    return reader.text("#address-note")


def test_what_an_address_cannot_lead_to_or_has_twice_is_named(reader, page):
    reader.open(page)
    for sent, named in (
        ("#variant-9999", "#variant-9999 (no such place)"),
        ("#variant-31/nothing", "#variant-31/nothing (no such place)"),
        ("#%E0%A4%A", "#%E0%A4%A (no such place)"),
        ("#page-pareto", "#page-pareto (no such place)"),
        ("#nowhere?measure=t_p", "#nowhere (no such place)"),
        ("#?measure=t_p&measure=C_total", "measure=C_total (given twice)"),
        ("#?only=d8:TRRT:TRRT&only=d8:RRT:RRT", "only=d8:RRT:RRT (an axis has one range)"),
        ("#?only=d8:TRRT:TRRT:RRT", "only=d8:TRRT:TRRT:RRT (no such range)"),
        ("#?weights=t_p:0.5,t_p:0.7", "weights=t_p:0.5,t_p:0.7 (a weight is given twice)"),
        (f"#{'a' * 5000}", f"#{'a' * 78}… (no such place)"),
    ):
        assert follow(reader, sent) == f"Ignored of the address: {named}."
    for sent in ("#variant-31/t_p", "#variant-31/trials", "#variant-31", "#r-SYS-024", "#pareto?measure=t_p", "#top"):
        reader.script("location.hash = arguments[0]", sent)
        reader.until("return document.getElementById('address-note').textContent === ''")
    assert reader.complaints() == []

    reader.driver.get("about:blank")
    reader.driver.get(f"{page.as_uri()}#variant-9999")
    reader.until("return document.documentElement.dataset.ready === 'yes'")
    assert reader.text("#address-note") == "Ignored of the address: #variant-9999 (no such place)."


def test_words_of_every_kind_are_sought_without_an_error(searcher):
    for words in (
        "constructor",
        "__proto__",
        "SYS-024=constructor",
        "(((",
        "[a-z]+*",
        "\\",
        '"',
        "<script>alert(1)</script>",
        "日本語",
        "x" * 3000,
        " \t ",
        "t_p<",
        "t_p<NaN",
        "=",
    ):
        searcher.script(
            "const field = document.getElementById('find'); field.value = arguments[0];"
            "document.getElementById('found-count').textContent = '…';"
            "field.dispatchEvent(new Event('input', {bubbles: true}))",
            words,
        )
        searcher.until("return document.getElementById('found-count').textContent !== '…'")
        if words == "SYS-024=constructor":
            assert "sys-024 is compared with a number" in searcher.text("#found-count")
    assert searcher.complaints() == []


@pytest.mark.parametrize("plot", ["parallel", "pareto"])
def test_a_picture_saved_in_the_dark_has_its_own_paper(reader, page, plot):
    reader.driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
    )
    try:
        reader.open(page)
        # What would be written to a file.
        reader.script(
            "window.saved = null; HTMLAnchorElement.prototype.click = function () { window.saved = this.href; };"
        )
        button = reader.driver.find_element(By.CSS_SELECTOR, f"button[aria-label='Save {plot} as SVG']")
        reader.script("arguments[0].dispatchEvent(new Event('click'))", button)
        reader.until("return window.saved !== null")
        text = reader.script("return btoa(unescape(saved.slice(saved.indexOf(',') + 1)))")
        paper = reader.script("return getComputedStyle(document.documentElement).getPropertyValue('--paper').trim()")
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    drawing = ET.fromstring(base64.b64decode(text))  # noqa: S314 - of our own page
    first = drawing[0]
    assert paper == "#12161c"
    assert (first.tag, first.get("width"), first.get("height"), first.get("fill")) == (
        f"{SVG}rect",
        "100%",
        "100%",
        paper,
    )
