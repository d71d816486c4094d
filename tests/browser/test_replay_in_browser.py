"""The page of a replay in headless Chromium: it plays, is scrubbed and turned, and asks for nothing."""

from __future__ import annotations

import json
import math
from itertools import combinations
from operator import mul
from pathlib import Path

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

from rgss.reports.replay.gltf_scene import replay_to_glb
from rgss.reports.replay.packing import packed_replay
from rgss.reports.replay.replay_page import replay_to_html
from tests.fixtures.made_replay import JOINTS, made_record, made_scene, made_trace

pytestmark = pytest.mark.browser

PLAYER = "replays.playerOf(document.querySelector('[data-replay]'))"


def page_of(folder: Path, *records) -> Path:
    packed = [packed_replay(record, made_trace(), made_scene(), joints=JOINTS) for record in records]
    file = folder / "report.html"
    file.write_text(replay_to_html(packed), encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def page(tmp_path_factory) -> Path:
    return page_of(tmp_path_factory.mktemp("replay"), made_record())


@pytest.fixture(scope="module")
def pair(tmp_path_factory) -> Path:
    return page_of(tmp_path_factory.mktemp("pair"), made_record(), made_record(variant=6, fails=False))


def errors(reader):
    """What the console has to say, but for remarks of a driver without a graphics processor on its own speed."""
    return [one for one in reader.complaints() if "GL Driver Message (OpenGL, Performance" not in one]


def time_of(reader) -> float:
    return float(reader.script("return document.querySelector('[data-replay]').dataset.time"))


def button(reader, text):
    """The button with a text; one question, since each takes a second while the page plays."""
    return reader.script(
        "return Array.from(document.querySelectorAll('.replay button'))"
        ".find((one) => one.innerText.startsWith(arguments[0]))",
        text,
    )


def world_position(reader, name, trial=0):
    """Where the page has a node, in the world of the trial, whose z is up."""
    return reader.script(
        f"const trial = {PLAYER}.trials[arguments[1]];"
        "const node = Object.values(trial.kinds).flat().find((one) => one.userData.kind !== 'perceived' &&"
        " one.name.replaceAll('_', ' ') === arguments[0]);"
        "trial.group.updateMatrixWorld(true);"
        "return trial.world.worldToLocal(node.getWorldPosition(new THREE.Vector3())).toArray()",
        name,
        trial,
    )


def colours(reader):
    """Number of colours in the picture, of which an empty one has one."""
    return reader.script(
        f"const view = {PLAYER}.view; view.draw();"
        "const from = view.renderer.domElement, to = document.createElement('canvas');"
        "[to.width, to.height] = [200, 150];"
        "const pen = to.getContext('2d'); pen.drawImage(from, 0, 0, 200, 150);"
        "const found = new Set(); const bytes = pen.getImageData(0, 0, 200, 150).data;"
        "for (let at = 0; at < bytes.length; at += 4) found.add(bytes[at] << 16 | bytes[at + 1] << 8 | bytes[at + 2]);"
        "return found.size"
    )


def test_it_draws_and_asks_for_nothing(reader, page):
    reader.open(page)

    assert reader.script("return document.querySelectorAll('.replay-plots figure > svg').length") == 4
    assert errors(reader) == []
    assert reader.requests() == []
    assert colours(reader) > 50


def test_it_plays_and_pauses_and_ends(reader, page):
    reader.open(page)
    speed = Select(reader.driver.find_element(By.XPATH, "//label[starts-with(., 'Speed')]/select"))
    # Slow enough that a busy machine pauses it before its end.
    speed.select_by_value("0.1")
    button(reader, "Play").click()
    reader.until("return Number(document.querySelector('[data-replay]').dataset.time) > 0.05")
    # The driver's pointer waits for frames, which take long to draw without a graphics processor.
    reader.script("arguments[0].click()", button(reader, "Pause"))
    stopped = time_of(reader)
    assert not reader.script(f"return {PLAYER}.playing")
    assert button(reader, "Play").text == "Play"

    speed.select_by_value("4")
    button(reader, "Play").click()
    reader.until(f"return !{PLAYER}.playing")
    assert stopped < time_of(reader) == pytest.approx(made_scene().time_s[-1], abs=1e-3)


def test_scrubbing_poses_every_object_as_the_scene_has_it(reader, page):
    reader.open(page)
    scene = made_scene()
    for sample in (0, 17, 55, len(scene.time_s) - 1):
        reader.script(
            "const scrub = document.querySelector('.replay-scrub'); scrub.step = 'any'; scrub.value = arguments[0];"
            "scrub.dispatchEvent(new Event('input'))",
            float(scene.time_s[sample]),
        )
        for node in (scene.nodes[2], scene.nodes[3]):
            expected = node.positions_m[sample]
            assert world_position(reader, node.name.replace("_", " ")) == pytest.approx(expected, abs=1e-4)


def test_chapters_lead_to_phases_and_follow_the_time(reader, page):
    reader.open(page)
    button(reader, "3 carry").click()
    assert time_of(reader) == pytest.approx(2.0)
    current = reader.script("return document.querySelector('[aria-current=true]').textContent")
    assert current == "3 carryfailed"
    assert reader.script("return Array.from(document.querySelectorAll('.replay-chapters button')).pop().disabled")
    assert "</script><b>it slipped</b> 21.0 mm" in reader.text(".replay-side")
    # The graph of a phase is seen in that phase alone.
    graph = f"return {PLAYER}.trials[0].kinds.graph.map((one) => one.visible)"
    assert reader.script(graph) == [True]
    button(reader, "1 reach out").click()
    assert reader.script(graph) == [False]


def test_the_keyboard_steps_and_turns_pages(reader, page):
    reader.open(page)
    view = reader.driver.find_element(By.CSS_SELECTOR, ".replay-view")
    view.send_keys(Keys.PAGE_DOWN)
    assert time_of(reader) == pytest.approx(1.0)
    view.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
    assert time_of(reader) == pytest.approx(1.2)
    view.send_keys(Keys.PAGE_UP, Keys.ARROW_LEFT)
    assert time_of(reader) == pytest.approx(0.9)
    # Slow enough that a busy machine sees it begin anew.
    Select(reader.driver.find_element(By.XPATH, "//label[starts-with(., 'Speed')]/select")).select_by_value("0.1")
    view.send_keys(Keys.END)
    assert time_of(reader) == pytest.approx(made_scene().time_s[-1], abs=1e-3)
    view.send_keys(Keys.SPACE)
    reader.until("return Number(document.querySelector('[data-replay]').dataset.time) < 1")


def test_plots_have_a_cursor_that_follows_and_leads(reader, page):
    reader.open(page)
    svg = reader.driver.find_elements(By.CSS_SELECTOR, ".replay-plots figure > svg")[2]
    reader.script("arguments[0].scrollIntoView({block: 'center'})", svg)
    ActionChains(reader.driver).move_to_element(svg).click().perform()
    middle = time_of(reader)
    assert 1.5 < middle < 2.6
    places = reader.script(
        "return Array.from(document.querySelectorAll('.cursor')).map((one) => one.getAttribute('x1'))"
    )
    assert len(places) == 4
    assert len(set(places)) == 1
    trace = made_trace()
    shown = reader.script(
        "return Array.from(document.querySelectorAll('.replay-legend')[2].querySelectorAll('b'))"
        ".map((one) => Number(one.textContent))"
    )
    near = forces_near(trace, middle)
    assert near[0] - 0.02 <= shown[0] <= near[1] + 0.02


def forces_near(trace, time_s):
    """Least and greatest force of the first finger around a time."""
    forces = trace.finger_forces_n[abs(trace.time_s - time_s) < 0.1, 0]
    return forces.min(), forces.max()


def test_what_is_shown_is_chosen(reader, page):
    reader.open(page)
    button(reader, "3 carry").click()
    state = (
        f"const one = {PLAYER}.trials[0]; return [one.arrows.some((each) => each.visible),"
        " one.kinds.path[0].visible, one.kinds.graph[0].visible, one.kinds.perceived[0].visible]"
    )
    assert reader.script(state) == [True] * 4
    for place, name in enumerate(("forces", "path", "graph", "perceived"), start=1):
        reader.driver.find_element(By.CSS_SELECTOR, f"input[data-show={name}]").click()
        assert reader.script(state) == [False] * place + [True] * (4 - place)


def test_an_arrow_ends_where_the_finger_presses(reader, page):
    reader.open(page)
    scene = made_scene()
    sample = 50
    reader.script(f"{PLAYER}.seek(arguments[0])", float(scene.time_s[sample]))
    ends = reader.script(
        f"const one = {PLAYER}.trials[0]; one.group.updateMatrixWorld(true);"
        "return one.arrows.map((each) => one.world.worldToLocal(each.userData.head.localToWorld("
        "new THREE.Vector3(0, 1, 0))).toArray())"
    )
    for end, contact in zip(ends, scene.contacts, strict=True):
        assert end == pytest.approx(contact.points_m[sample], abs=1e-4)


def test_it_is_turned_and_follows_the_hand(reader, page):
    reader.open(page)
    place = f"return {PLAYER}.view.camera.position.toArray()"
    before = reader.script(place)
    view = reader.driver.find_element(By.CSS_SELECTOR, ".replay-view")
    ActionChains(reader.driver).move_to_element(view).click_and_hold().move_by_offset(80, 20).release().perform()
    reader.until(f"const now = {PLAYER}.view.camera.position; return Math.abs(now.x - arguments[0]) > 0.05", before[0])

    Select(reader.driver.find_element(By.XPATH, "//label[starts-with(., 'View')]/select")).select_by_value("hand")
    for time_s in (0.5, 3.0):
        reader.script(f"{PLAYER}.seek(arguments[0])", time_s)
        target = reader.script(
            f"const player = {PLAYER};"
            "return player.trials[0].world.worldToLocal(player.view.controls.target.clone()).toArray()"
        )
        assert target == pytest.approx(world_position(reader, "gripper base"), abs=1e-6)


def test_a_second_trial_is_a_ghost_or_beside(reader, pair):
    reader.open(pair)
    assert "as a ghost Variant 6, seed 1" in reader.text(".replay-names")
    solid = f"let found; {PLAYER}.trials[1].kinds.object[0].traverse((one) => {{ if (one.isMesh) found = one; }});"
    assert reader.script(f"{solid} return found.material.transparent")
    assert reader.script(f"return {PLAYER}.trials[1].group.parent === {PLAYER}.trials[0].scene")

    Select(reader.driver.find_element(By.XPATH, "//label[starts-with(., 'Second')]/select")).select_by_value("beside")
    assert not reader.script(f"{solid} return found.material.transparent")
    assert reader.script(
        "return Array.from(document.querySelectorAll('.replay-names span')).map((one) => one.textContent)"
    ) == ["Variant 5, seed 1", "Variant 6, seed 1"]
    assert errors(reader) == []
    assert colours(reader) > 50


@pytest.mark.parametrize("width", [1440, 1024, 390])
def test_it_fits_the_width_and_axe_has_nothing_serious(reader, pair, width):
    reader.open(pair, width=width)
    assert reader.script("return document.documentElement.scrollWidth") <= width
    assert reader.accessibility_findings() == []


def test_it_is_saved_as_the_glb_that_it_carries(reader, page):
    reader.open(page)
    saved = json.loads(
        reader.script(
            "let blob; const real = URL.createObjectURL;"
            "URL.createObjectURL = (one) => { blob = one; return real(one); };"
            "Array.from(document.querySelectorAll('.replay button'))"
            ".find((one) => one.textContent === 'Save as GLB').click();"
            "URL.createObjectURL = real;"
            "return JSON.stringify([blob.type, blob.size])"
        )
    )
    assert saved == ["model/gltf-binary", len(replay_to_glb(made_scene(), title="Variant 5, seed 1"))]


EIGHT_JOINTS = (
    "const [lead] = replays.playerOf(document.querySelector('[data-replay]')).timelines, [plot] = lead.plots;"
    "const series = Array.from({length: 8}, (_, at) => ({...plot.series[0], name: `joint ${at + 1}`}));"
    "const place = document.createElement('div'); place.className = 'replay-plots'; document.body.append(place);"
    "new replayPlots.Plot(place, [{...lead, plots: [{...plot, series}]}], 0, lead.end_s, () => {}).draw();"
    "const seen = (all) => Array.from(place.querySelectorAll(all), (one) => getComputedStyle(one))"
    ".map((one) => [one.stroke.match(/\\d+/g).map(Number), one.strokeDasharray]);"
    "const found = [seen('path.series'), seen('.replay-key .series')]; place.remove();"
    "return [...found, getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)]"
)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_lines_of_eight_joints_are_told_apart_and_have_a_key_each(reader, page, theme):
    reader.driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]}
    )
    try:
        reader.open(page)
        lines, keys, paper = reader.script(EIGHT_JOINTS)
    finally:
        reader.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    assert len(lines) == 8
    assert keys == lines
    for (one, _), (other, _) in combinations(lines, 2):
        assert math.dist(lab_of(one), lab_of(other)) > 20
    # WCAG 2.2, 1.4.11: graphics have a contrast of 3 to 1 with what is beside them.
    assert all(contrast(colour, paper) >= 3 for colour, _ in lines)
    patterns = [pattern for _, pattern in lines]
    assert set(patterns[:4]) == {"none"}
    assert "none" not in patterns[4:]


def light_of(colour):
    """Linear light of sRGB channels, IEC 61966-2-1."""
    shares = [one / 255 for one in colour[:3]]
    return [one / 12.92 if one <= 0.04045 else ((one + 0.055) / 1.055) ** 2.4 for one in shares]


def contrast(one, other):
    luminances = sorted(sum(map(mul, (0.2126, 0.7152, 0.0722), light_of(colour))) for colour in (one, other))
    return (luminances[1] + 0.05) / (luminances[0] + 0.05)


def lab_of(colour):
    """CIELAB under D65, in which a distance of 2.3 is just noticeable."""
    red, green, blue = light_of(colour)
    xyz = (
        (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505,
        0.2126 * red + 0.7152 * green + 0.0722 * blue,
        (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.0888,
    )
    x, y, z = (one ** (1 / 3) if one > 216 / 24389 else one * 841 / 108 + 4 / 29 for one in xyz)
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


@pytest.mark.parametrize("width", [1440, 390])
def test_the_camera_has_all_that_moves_in_the_picture_and_no_more_than_it_needs(reader, page, width):
    reader.open(page, width=width)
    scene = made_scene()
    for view in ("overview", "side", "top"):
        Select(reader.driver.find_element(By.XPATH, "//label[starts-with(., 'View')]/select")).select_by_value(view)
        # Positions in the picture, from -1 to 1, of the middle of what moves at each instant.
        seen = reader.script(
            f"const {{trials: [trial], view: {{camera}}}} = {PLAYER}; camera.updateMatrixWorld(true);"
            "return arguments[0].map((one) => trial.world.localToWorld(new THREE.Vector3(...one))"
            ".project(camera).toArray())",
            [place.tolist() for node in scene.nodes[2:4] for place in node.positions_m],
        )
        assert all(max(abs(across), abs(up)) < 1 for across, up, _ in seen)
        whole = reader.script(
            f"const {{view}} = {PLAYER}; return view.corners.map((one) => one.clone().project(view.camera).toArray())"
        )
        extents = [max(abs(one[axis]) for one in whole) for axis in (0, 1)]
        # In its tighter direction the picture is full, up to its border.
        assert max(extents) == pytest.approx(1 / 1.04, abs=1e-3)
