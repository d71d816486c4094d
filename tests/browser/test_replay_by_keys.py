"""The page of a replay without a mouse, and in a browser that draws nothing in three dimensions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from rgss.reports.replay.packing import packed_replay
from rgss.reports.replay.replay_page import replay_to_html
from tests.fixtures.made_replay import JOINTS, made_record, made_scene, made_trace

pytestmark = pytest.mark.browser

PLAYER = "replays.playerOf(document.querySelector('[data-replay]'))"
WITHOUT_WEBGL = "HTMLCanvasElement.prototype.getContext = () => null"


@pytest.fixture(scope="module")
def replay(tmp_path_factory) -> Path:
    file = tmp_path_factory.mktemp("keys") / "report.html"
    packed = packed_replay(made_record(), made_trace(), made_scene(), joints=JOINTS)
    file.write_text(replay_to_html([packed]), encoding="utf-8")
    return file


@pytest.fixture
def plain_reader(reader) -> Iterator:
    """A reader whose browser has no WebGL."""
    added = reader.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": WITHOUT_WEBGL})
    yield reader
    reader.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": added["identifier"]})


def camera(reader) -> dict[str, float]:
    """The distance of the camera from its target, its azimuth, and its angle to the vertical."""
    return reader.script(
        f"const {{camera, controls}} = {PLAYER}.view, from = camera.position.clone().sub(controls.target);"
        "return {distance: from.length(), azimuth: Math.atan2(from.x, from.z) * 180 / Math.PI,"
        " polar: from.angleTo(camera.up) * 180 / Math.PI}"
    )


def shifted(reader, *keys: str) -> None:
    ActionChains(reader.driver).key_down(Keys.SHIFT).send_keys(*keys).key_up(Keys.SHIFT).perform()


def test_keys_turn_the_scene_and_bring_it_closer(reader, replay):
    reader.open(replay)
    view = reader.driver.find_element(By.CSS_SELECTOR, ".replay-view")
    reader.script("arguments[0].focus()", view)
    first = camera(reader)
    shifted(reader, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
    turned = camera(reader)
    assert (turned["azimuth"] - first["azimuth"]) % 360 == pytest.approx(20, abs=1e-3)
    assert first["polar"] - turned["polar"] == pytest.approx(10, abs=1e-3)
    assert turned["distance"] == pytest.approx(first["distance"])
    view.send_keys("+")
    assert camera(reader)["distance"] < 0.9 * first["distance"]
    view.send_keys("-")
    assert camera(reader)["distance"] == pytest.approx(first["distance"])
    # The time is as it was; at the zenith it stops, and turns back.
    assert reader.script(f"return {PLAYER}.time") == 0
    shifted(reader, *[Keys.ARROW_UP] * 30)
    assert 0 < camera(reader)["polar"] < 5
    shifted(reader, Keys.ARROW_DOWN)
    assert 10 < camera(reader)["polar"] < 15
    assert "shift and an arrow turn" in reader.text(".replay-side")


def test_the_wheel_scrolls_the_page_until_the_reader_is_in_the_scene(reader, replay):
    reader.open(replay)
    view = reader.driver.find_element(By.CSS_SELECTOR, ".replay-view")
    wheel = (
        "const event = new WheelEvent('wheel', {deltaY: -300, bubbles: true, cancelable: true});"
        "arguments[0].querySelector('canvas').dispatchEvent(event); return event.defaultPrevented"
    )
    before = camera(reader)["distance"]
    assert not reader.script(wheel, view)
    assert camera(reader)["distance"] == pytest.approx(before)
    reader.script("arguments[0].focus()", view)
    assert reader.script(wheel, view)
    nearer = f"const one = {PLAYER}.view; return one.camera.position.distanceTo(one.controls.target) < arguments[0]"
    reader.until(nearer, 0.99 * before)


def test_without_three_dimensions_phases_and_plots_are_there(plain_reader, replay):
    plain_reader.open(replay)
    alert = plain_reader.text(".replay [role=alert]")
    assert alert.startswith("This browser draws nothing in three dimensions (")
    assert plain_reader.script("return document.querySelectorAll('.replay-plots path.series').length") > 3
    plain_reader.script("document.querySelectorAll('.replay-chapters button')[1].click()")
    assert plain_reader.script(f"return {PLAYER}.time") == pytest.approx(1.0)
    view = plain_reader.driver.find_element(By.CSS_SELECTOR, ".replay-view")
    view.send_keys(Keys.ARROW_RIGHT, "+")
    assert plain_reader.script(f"return {PLAYER}.time") == pytest.approx(1.1)
