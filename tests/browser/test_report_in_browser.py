"""The report as a reader meets it: it opens, it is brushed and weighed, and it asks for nothing."""

from __future__ import annotations

import copy

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from rgss.invisible_characters import visible
from rgss.reports.study import parted
from rgss.reports.study_page import study_report_to_html

pytestmark = pytest.mark.browser

HOSTILE = "</script><script>window.hacked=1</script><img src=x onerror=window.hacked=2>\"'`=1+1 \u2028🤖<b>bold</b>"


def test_it_opens_draws_everything_and_asks_for_nothing(reader, page):
    reader.open(page)
    reader.see_all_plots()

    assert reader.complaints() == []
    assert reader.requests() == []
    # All but the pictures are there: a plot of each kind, and lines for every variant.
    assert reader.script("return document.querySelectorAll('.plot .main-svg').length") >= 9
    drawn = reader.script("return document.querySelector('#parallel canvas').dataset.drawn").split()
    assert sum(map(int, drawn)) == 72


def test_a_trial_is_replayed_in_the_report(reader, page):
    reader.open(page)
    place = "document.querySelector('#pictures [data-replay]')"
    assert reader.script(f"return typeof THREE + {place}.querySelectorAll('canvas').length") == "undefined0"
    reader.driver.find_element(By.XPATH, "//summary[. = 'Replay in three dimensions']").click()
    reader.until(f"return {place}.dataset.state === 'ready'")
    reader.script("Array.from(document.querySelectorAll('.replay-chapters button'))[2].click()")

    assert float(reader.script(f"return {place}.dataset.time")) == 2.0
    reader.until(f"return Number({place}.dataset.drawn) > 0")
    assert [one for one in reader.complaints() if "GL Driver Message" not in one] == []
    assert reader.requests() == []


def test_a_film_plays_pauses_and_shows_the_time_that_is_sought(reader, page):
    reader.open(page)
    driver = reader.driver
    driver.find_element(By.XPATH, "//summary[. = 'Play the film']").click()
    film = "document.querySelector('.film video')"
    reader.until(f"return {film}.readyState >= 2")

    assert reader.script(f"return [{film}.error, {film}.controls, {film}.paused]") == [None, True, True]
    assert reader.script(f"return {film}.duration") == pytest.approx(4.0, abs=0.2)
    reader.script(f"{film}.muted = true; {film}.play()")
    reader.until(f"return {film}.currentTime > 0")
    reader.script(f"{film}.pause()")
    assert reader.script(f"return {film}.paused")
    # 3.06 s is within frame 24 of 8 a second, whose grey is 192; and so on.
    for time_s, grey in ((3.06, 8 * 24), (0.56, 8 * 4), (2.06, 8 * 16)):
        shown = driver.execute_async_script(
            "const [time, done] = arguments; const film = document.querySelector('.film video');"
            "film.addEventListener('seeked', () => {"
            " const canvas = document.createElement('canvas'); [canvas.width, canvas.height] = [200, 150];"
            " const pen = canvas.getContext('2d'); pen.drawImage(film, 0, 0);"
            " done([...pen.getImageData(100, 20, 1, 1).data]); }, {once: true}); film.currentTime = time;",
            time_s,
        )
        assert shown[:3] == pytest.approx([grey] * 3, abs=6), time_s
    assert reader.complaints() == []
    assert reader.requests() == []


def test_a_brush_on_an_axis_filters_every_other_view(reader, page, study):
    # Wide enough for the whole canvas, from whose middle the pointer is placed.
    reader.open(page, width=1700)
    reader.see_all_plots()
    before = {name: reader.text(f"#{name}-note") for name in ("failure",)}
    canvas = reader.driver.find_element(By.CSS_SELECTOR, "#parallel canvas")
    reader.script("arguments[0].scrollIntoView({block: 'center'})", canvas)
    box = canvas.rect
    # The fourth axis is the planner's, with RRT at its foot: a drag over its lower quarter keeps RRT alone.
    step = int(canvas.get_attribute("data-step"))
    axis_x, foot, height = 64 + 3 * step, 420 - 46, 420 - 62 - 46
    to = (axis_x - box["width"] / 2, foot - 0.25 * height - box["height"] / 2)
    start = (axis_x - box["width"] / 2, foot + 4 - box["height"] / 2)
    (
        ActionChains(reader.driver)
        .move_to_element_with_offset(canvas, round(start[0]), round(start[1]))
        .click_and_hold()
        .move_to_element_with_offset(canvas, round(to[0]), round(to[1]))
        .release()
        .perform()
    )
    planner = next(one for one in study.document["parameters"] if one["name"] == "planner")
    kept = [study.document["variants"]["id"][p] for p, name in enumerate(planner["values"]) if name == "RRT"]
    reader.until("return document.getElementById('shown').textContent === arguments[0]", "24 of 72 variants are shown")
    reader.until("return document.querySelectorAll('#verdict-table tbody tr').length === 24")

    assert sorted(int(row[0]) for row in reader.rows("#verdict-table")) == kept
    assert reader.text("#failure-note") != before["failure"]
    assert reader.text("#failure-note").startswith("0 of 72 trials")
    assert {int(row[1]) for row in reader.rows("#ranking-table")} <= set(kept)
    reader.script("document.querySelector('#planning-table').closest('details').open = true")
    reader.until("return document.querySelectorAll('#planning-table tbody tr').length > 0")
    assert [row[0] for row in reader.rows("#planning-table")] == ["RRT"]
    # A plot is drawn anew when it comes into sight.
    reader.script("document.getElementById('planning-plot').scrollIntoView()")
    reader.until("return document.getElementById('planning-plot').data.map((one) => one.name).join() === 'RRT'")
    reader.script("document.getElementById('pareto-plot').scrollIntoView()")
    reader.until(
        "return document.getElementById('pareto-plot').data.flatMap((one) => one.meta)"
        ".every((one) => arguments[0].includes(one))",
        kept,
    )

    reader.driver.find_element(By.ID, "clear").click()
    reader.until("return document.querySelectorAll('#verdict-table tbody tr').length === 72")
    assert reader.text("#failure-note") == before["failure"]


def test_the_keyboard_brushes_too(reader, page):
    reader.open(page)
    reader.script("document.getElementById('axis-ends').open = true")
    slider = reader.driver.find_element(By.CSS_SELECTOR, "input[aria-label='gripper fingers to']")
    slider.send_keys(Keys.HOME)

    reader.until("return document.getElementById('shown').textContent === '36 of 72 variants are shown'")
    assert slider.get_attribute("aria-valuetext") == "2"


def test_a_variant_leads_to_its_trials_and_the_commands_that_run_them_again(reader, page, study):
    reader.open(page)
    link = reader.driver.find_element(By.CSS_SELECTOR, "#verdict-table a[href='#variant-31']")
    reader.script("arguments[0].scrollIntoView({block: 'center'})", link)
    link.click()

    reader.until("return document.getElementById('variant-choice').value === '31'")
    assert reader.script("return document.activeElement.id") == "evidence-title"
    trials = study.document["trials"]
    keys = [
        key
        for key, at in zip(trials["key"], trials["variant"], strict=True)
        if study.document["variants"]["id"][at] == 31
    ]
    text = reader.text("#variant-evidence")
    assert all(f"rgss replay {key}" in text for key in keys)
    assert "rgss run 31 --seed 1 --fidelity contact" in text


# The traceability sections are long, and the same at every width but for their layout.
@pytest.mark.parametrize(("width", "without"), [(1400, ()), (400, (".matrix", "#verification", "#architecture"))])
def test_an_audit_finds_nothing_serious_and_nothing_sticks_out(reader, page, width, without):
    reader.open(page, width=width)
    reader.script("for (const one of document.querySelectorAll('details')) one.open = true")
    reader.see_all_plots()

    assert reader.script("return document.documentElement.scrollWidth") <= width
    assert reader.accessibility_findings(without=without) == []


def test_texts_are_shown_as_texts(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    document["study"] = document["study_file"] = HOSTILE
    for requirement in document["requirements"]:
        requirement["text"] = requirement["criterion"] = HOSTILE
    for parameter in document["parameters"]:
        parameter["name"] = HOSTILE
    for measure in document["measures"]:
        measure["name"] = HOSTILE
    for factor in document["effects"]:
        for term in factor["main"]:
            term["levels"] = [f"{HOSTILE} {level}" for level in term["levels"]]
    document["planning"]["planners"][0]["name"] = HOSTILE
    document["trials"]["failures"] = [HOSTILE] * len(document["trials"]["failures"])
    lists = ("standing", "reasons", "cautions", "readings")
    document["decision"] |= {key: [HOSTILE] for key in lists}
    document["provenance"]["files"].append([HOSTILE, HOSTILE])
    document["assumptions"].append({"where": HOSTILE, "about": HOSTILE, "why": HOSTILE})
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    reader.script("for (const one of document.querySelectorAll('details')) one.open = true")
    reader.see_all_plots()

    assert reader.script("return window.hacked === undefined")
    assert reader.script("return document.querySelectorAll('img, main b').length") == 0
    assert reader.requests() == []
    assert reader.complaints() == []
    told = reader.script(
        "return Array.from(document.querySelectorAll('#decision .reasons li')).map((one) => one.textContent)"
    )
    assert told == [visible(HOSTILE)] * len(lists)
    assert visible(HOSTILE) in reader.text("#variant-evidence")
    assert "<b>bold</b>" in reader.text("#planning-plot")


FIGURES_WITHOUT_EVIDENCE = """
const told = [];
const leads = (link) => (link.hash.startsWith('#variant-')
  ? /^#variant-\\d+/.test(link.hash)
  : document.getElementById(link.hash.slice(1)) !== null);
for (const table of document.querySelectorAll('main table')) {
  const region = table.closest('.scroll') ?? table;
  const named = region.parentElement.querySelector(':scope > .source') !== null;
  for (const cell of table.querySelectorAll('td.number')) {
    if (!/\\d/.test(cell.textContent)) continue;
    const links = Array.from(cell.querySelectorAll('a[href]'));
    const sound = links.every(leads) && (links.length > 0 || named);
    if (!sound) told.push(`${table.closest('section').id}: ${cell.outerHTML.slice(0, 120)}`);
  }
}
return told;
"""


def test_every_figure_of_the_page_has_a_link_or_a_named_source(reader, page):
    reader.open(page)
    reader.script("for (const one of document.querySelectorAll('details')) one.open = true")
    reader.until("return document.querySelectorAll('#acceptability-table td').length > 0")

    cells = reader.script(
        "return Array.from(document.querySelectorAll('main td.number'))"
        ".filter((one) => /\\d/.test(one.textContent)).length"
    )
    assert cells > 1500
    assert reader.script(FIGURES_WITHOUT_EVIDENCE) == []
    # It would tell of one that had lost its link.
    reader.script("document.querySelector('.compared td a[href$=t_e]').removeAttribute('href')")
    assert [one.split(":")[0] for one in reader.script(FIGURES_WITHOUT_EVIDENCE)] == ["decision"]


def test_a_figure_leads_to_its_row_and_from_there_to_the_command(reader, page, study):
    reader.open(page)
    chosen = study.document["decision"]["chosen"]
    reader.driver.find_element(By.CSS_SELECTOR, f".compared a[href='#variant-{chosen}/t_e']").click()
    reader.until("return document.activeElement.dataset.key === 't_e'")
    assert reader.script("return document.activeElement.classList.contains('sought')")

    reader.driver.find_element(By.CSS_SELECTOR, "#variant-evidence tr[data-key='t_e'] a").click()
    trials = study.document["trials"]
    key = trials["key"][trials["variant"].index(study.document["variants"]["id"].index(chosen))]
    reader.until("return document.activeElement.dataset.key === arguments[0]", key)
    assert f"rgss replay {key}" in reader.script("return document.activeElement.textContent")
    # What is no figure of a variant leads to the variant.
    reader.script("location.hash = arguments[0]", f"#variant-{chosen}/%E0%A4%A")
    reader.until("return document.activeElement.id === 'evidence-title'")
    assert reader.complaints() == []


def test_conflicts_are_shown_at_every_width(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    moved = {"requirement": "SYS-004", "demand": HOSTILE, "needed": "41,750 USD", "relative": "3.1 %"}
    document["decision"] |= {"chosen": None, "runner_up": None, "headline": "No variant is chosen.", "reasons": ["x"]}
    document["decision"]["demands"] = {"SYS-004": HOSTILE, "SYS-012": HOSTILE}
    document["conflicts"] = {
        "conflicts": [{"requirements": ["SYS-004", "SYS-012"], "survives": 0.22, "unmeasured": False}],
        "more_conflicts": 0,
        "complete": True,
        "joint": [
            {"requirements": ["SYS-004"], "changes": [moved], "unlocked": 3, "winner": 13},
            {"requirements": ["SYS-012"], "changes": [], "unlocked": 0, "winner": None},
        ],
        "more_joint": 2,
        "requirements": [
            {"requirement": "SYS-004", "demand": "d", "excludes": 9, "changes": [moved], "unlocked": 3, "winner": 13}
        ],
        "example": "rgss trade --what-if 'SYS-004.threshold=41750 USD'",
        "noise": "Survives.",
        "nearest": {"variant": 19, "requirements": ["SYS-004"]},
    }
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    for width in (1400, 400):
        reader.open(file, width=width)
        assert reader.script("return document.documentElement.scrollWidth") <= width
        assert reader.complaints() == []
    assert reader.rows(".repairs")[0] == ["SYS-004 and SYS-012", visible(HOSTILE) * 2, "22 %"]
    assert "evidence is missing" in reader.text(".repairs")
    assert reader.script("return document.querySelector('.repairs b') === null")


def test_a_study_without_a_choice_says_so(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    count = len(document["variants"]["id"])
    document["variants"] |= {"feasible": [0] * count, "pareto": [None] * count, "rank": [None] * count}
    document["decision"] |= {
        "chosen": None,
        "runner_up": None,
        "acceptability": None,
        "headline": "No variant is chosen.",
    }
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    reader.see_all_plots()

    assert reader.complaints() == []
    assert reader.text(".headline") == "No variant is chosen."
    worst = document["trials"]["worst"]
    reader.script("scrollTo(0, 0)")
    reader.driver.find_element(By.LINK_TEXT, "The worst failure").click()
    reader.until(
        "return document.activeElement.dataset.key === arguments[0]", document["trials"]["key"][worst["trial"]]
    )
    assert worst["why"] in reader.text("#worst-why")
    # Nothing is ranked: no empty table is shown, or linked.
    for one in ("weights", "acceptability"):
        assert not reader.driver.find_element(By.ID, one).is_displayed()
        assert reader.script("return document.querySelector(`#contents a[href='#${arguments[0]}']`)", one) is None
    assert reader.driver.find_element(By.ID, "pareto").is_displayed()


def test_ten_thousand_variants_can_be_used(reader, large_page, study):
    reader.open(large_page)
    reader.see_all_plots()

    assert large_page.stat().st_size < 15e6
    assert reader.complaints() == []
    # Many lines are one picture of how many there are; a table shows a page of them.
    assert "density" in reader.script("return document.querySelector('#parallel canvas').dataset.drawn")
    assert len(reader.rows("#verdict-table")) == 100
    assert "Rows 1 to 100 of 10000" in reader.text("#verdict-table")
    points = reader.script(
        "return ['pareto', 'measures'].map((id) => document.getElementById(`${id}-plot`).data"
        ".filter((one) => one.type !== 'histogram2d').reduce((sum, one) => sum + one.x.length, 0))"
    )
    assert max(points) < 5000
    # Measures that nothing weighs came after the page stood, and are there like any other.
    late = next(iter(parted(study.document)[1]))
    reader.script(
        "const choice = document.getElementById('measure-choice');"
        "document.getElementById('measures-plot').scrollIntoView();"
        "choice.value = arguments[0]; choice.dispatchEvent(new Event('change'))",
        late,
    )
    assert reader.script("return document.getElementById('measure-choice').value") == late
    reader.until(
        "return document.getElementById('measures-plot').layout.yaxis.title.text.startsWith(arguments[0])", late
    )
    assert late in reader.script(
        "return Array.from(document.querySelectorAll('#variant-evidence tr[data-key]')).map((row) => row.dataset.key)"
    )
    search = reader.driver.find_element(By.CSS_SELECTOR, "#verdict-table input")
    search.send_keys("9999")
    reader.until("return document.querySelectorAll('#verdict-table tbody tr').length === 1")
    assert reader.rows("#verdict-table")[0][0] == "9999"
