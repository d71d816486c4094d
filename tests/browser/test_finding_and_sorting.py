"""Contents, the search over everything and the sorting of tables, driven as a reader would."""

from __future__ import annotations

import copy
import re
import statistics

import pytest
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from rgss.designs import picked
from rgss.reports.study_page import study_report_to_html
from rgss.studies.project import load_project

pytestmark = pytest.mark.browser

FOUND = (
    "return Object.fromEntries(Array.from(document.querySelectorAll('#found > div'),"
    " (one) => [one.querySelector('h3').textContent, Array.from(one.querySelectorAll('a'), (a) => a.textContent)]))"
)


def find(reader, words: str) -> dict[str, list[str]]:
    """What the search over everything finds: the titles by kind."""
    field = reader.driver.find_element(By.ID, "find")
    field.clear()
    reader.script("document.getElementById('found').hidden = true; document.getElementById('found').replaceChildren()")
    reader.script("document.getElementById('found-count').textContent = ''")
    # At once: on a busy machine typing takes longer than the page waits for the next letter.
    field.click()
    reader.script(
        "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input', {bubbles: true}))",
        field,
        words,
    )
    reader.until("return document.getElementById('found-count').textContent !== ''")
    return reader.script(FOUND)


def kinds(reader) -> list[str]:
    """The kinds of what was found, in order; the driver sorts the keys of objects."""
    return reader.script("return Array.from(document.querySelectorAll('#found h3'), (one) => one.textContent)")


def verdicts_of_chosen(study) -> dict[str, str]:
    place = study.document["variants"]["id"].index(study.document["decision"]["chosen"])
    columns = {one["id"]: one["verdict"] for one in study.document["requirements"]}
    return {name: column[place] if isinstance(column, list) else column for name, column in columns.items()}


@pytest.mark.parametrize("verdict", ["met", "inconclusive"])
def test_the_search_finds_a_verdict_and_no_other(searcher, study, verdict):
    wanted = {name for name, one in verdicts_of_chosen(study).items() if one == verdict}
    found = find(searcher, verdict)

    assert wanted
    assert {title.split(":")[0] for title in found["Requirements"]} <= wanted
    assert len(found["Requirements"]) == min(8, len(wanted))
    assert searcher.complaints() == []
    assert searcher.requests() == []


def test_the_search_finds_names_the_beginnings_of_words_and_what_is_misspelled(searcher):
    assert any(title.startswith("t_e:") for title in find(searcher, "t_e")["Measures"])
    assert any("gripper" in title for title in find(searcher, "gripp")["Parameters"])
    assert any("gripper" in title for title in find(searcher, "gripepr")["Parameters"])
    assert "Provenance" in find(searcher, "provenance")["Sections"]
    assert any("planning" in title for title in find(searcher, "planning limit")["Failures"])
    assert find(searcher, "31")["Variants"] == ["Variant 31"]
    assert find(searcher, "zzzzqq") == {}
    assert searcher.text("#found-count") == "Nothing found"


@pytest.mark.parametrize("words", ["Variant 30", "variant 7", "28"])
def test_a_variant_named_by_its_title_or_number_comes_first(searcher, words):
    found = find(searcher, words)
    assert kinds(searcher)[0] == "Variants"
    assert found["Variants"] == [f"Variant {words.split()[-1]}"]


def test_a_number_does_not_find_the_decimals_of_another(searcher):
    texts = "return Array.from(document.querySelectorAll('#found li'), (one) => one.textContent)"
    for words in ("28", "25"):
        find(searcher, words)
        shown = [one for one in searcher.script(texts) if not one.startswith("Variant ") and "and " not in one[:4]]
        assert all(re.search(rf"(?<![\d.]){words}(?![\d.]*\d)", one) or one.endswith("…") for one in shown)


@pytest.mark.parametrize(
    ("words", "kind", "title"),
    [("SYS-024", "Requirements", "SYS-024: "), ("t_e", "Measures", "t_e: "), ("provenance", "Sections", "Provenance")],
)
def test_an_id_or_a_title_comes_before_what_mentions_it(searcher, words, kind, title):
    found = find(searcher, words)
    assert kinds(searcher)[0] == kind
    assert found[kind][0].startswith(title)
    assert len(found) > 1


def test_a_verdict_finds_the_requirements_first(searcher):
    for verdict in ("met", "inconclusive"):
        find(searcher, verdict)
        assert kinds(searcher)[0] == "Requirements"


def test_the_search_finds_parts_of_a_name_without_spaces(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    next(one for one in document["measures"] if one["id"] == "t_e")["name"] = "\u5939\u722a\u5f00\u53e3\u5bbd\u5ea6"
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    assert find(reader, "\u5f00\u53e3")["Measures"] == ["t_e: \u5939\u722a\u5f00\u53e3\u5bbd\u5ea6"]
    assert any("gripper" in title for title in find(reader, "rippe")["Parameters"])


def test_cells_of_a_found_row_do_not_run_together(searcher):
    found = find(searcher, "S")
    assert "S: Task success score" in found["Rows of tables"]
    entries = searcher.script(
        "const group = Array.from(document.querySelectorAll('#found > div'))"
        ".find((one) => one.querySelector('h3').textContent === 'Rows of tables');"
        "return Array.from(group.querySelectorAll('li'), (one) => {"
        " const link = one.querySelector('a'), row = link && document.getElementById(link.hash.slice(1));"
        " const section = row?.closest('section').querySelector('h2').textContent;"
        " return row && [one.querySelector('.small').textContent, section,"
        "  Array.from(row.cells, (cell) => cell.textContent)]; }).filter(Boolean)"
    )
    assert len(entries) > 1
    for text, section, cells in entries:
        whole = f"{section}: " + " · ".join(" ".join(cell.split()) for cell in cells if cell.strip())
        assert whole.startswith(text.strip().rstrip("…"))
    assert not any(
        "As a page" in text
        for text in searcher.script(
            "return Array.from(document.querySelectorAll('#found li'), (one) => one.textContent)"
        )
    )


def test_the_keyboard_leads_from_the_search_to_what_is_found(reader, page):
    reader.open(page)
    reader.driver.find_element(By.TAG_NAME, "body").send_keys("/")
    assert reader.script("return document.activeElement.id") == "find"
    find(reader, "31")
    field = reader.driver.find_element(By.ID, "find")
    for _ in range(30):
        reader.driver.switch_to.active_element.send_keys(Keys.ARROW_DOWN)
        if reader.script("return document.activeElement.textContent") == "Variant 31":
            break
    reader.driver.switch_to.active_element.send_keys(Keys.ENTER)
    reader.until("return document.getElementById('variant-choice').value === '31'")
    assert reader.script("return document.getElementById('found').hidden")
    field.send_keys(Keys.ESCAPE)


def test_what_is_found_is_unfolded(reader, page):
    reader.open(page)
    reader.script("document.querySelector('#provenance details:not([open]) tbody tr').id = 'sought-row'")
    reader.script("location.hash = '#sought-row'")
    reader.until("return document.getElementById('sought-row').closest('details').open")


def test_a_table_finds_verdicts_alone_and_of_a_requirement(searcher, study):
    requirement = next(one for one in study.document["requirements"] if isinstance(one["verdict"], list))
    ids = study.document["variants"]["id"]
    field = searcher.driver.find_element(By.CSS_SELECTOR, "#verdict-table input")
    for verdict in set(requirement["verdict"]):
        wanted = [name for name, one in zip(ids, requirement["verdict"], strict=True) if one == verdict]
        field.clear()
        field.send_keys(f"{requirement['id']}={verdict}")
        searcher.until(
            "return document.querySelectorAll('#verdict-table tbody tr').length === arguments[0]", len(wanted)
        )
        assert sorted(int(row[0]) for row in searcher.rows("#verdict-table")) == wanted
    planner = next(one for one in study.document["parameters"] if one["name"] == "planner")
    field.clear()
    field.send_keys("planner=stride")
    searcher.until(
        "return document.querySelectorAll('#verdict-table tbody tr').length === arguments[0]",
        planner["values"].count("STRIDE"),
    )


def filtered(reader, words: str) -> tuple[list[int], str]:
    """The variants that the Find of the table of verdicts leaves, and what is said beside it."""
    field = reader.driver.find_element(By.CSS_SELECTOR, "#verdict-table input")
    reader.script(
        "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input', {bubbles: true}))",
        field,
        words,
    )
    return sorted(int(row[0]) for row in reader.rows("#verdict-table")), reader.text("#verdict-table output")


def test_a_table_takes_the_filters_of_the_command_line(searcher, study):
    space = load_project(study.folder).designs
    terms = ["gripper=three", "fingers=two", "Fingers=TWO", "gripper.fingers=3", "planner=rrt", "d8=RRT", "d8!=RRT"]
    terms += ["component.gripper=three", "design.d8=trrt", "planner=rrt,fingers=two", "gripper_mass=light"]
    for term in terms:
        wanted = [one.id for one in picked(space, [term])]
        assert 0 < len(wanted) < 72
        assert filtered(searcher, term)[0] == wanted, term
    assert filtered(searcher, "gripper=three planner=rrt")[0] == [
        one.id for one in picked(space, ["gripper=three", "planner=rrt"])
    ]


def estimates(study, name: str) -> dict[int, float | None]:
    """A measure of each variant, from the document."""
    values = next(one["value"] for one in study.document["measures"] if one["id"] == name)
    ids = study.document["variants"]["id"]
    return dict(zip(ids, values if isinstance(values, list) else [values] * len(ids), strict=True))


def test_a_table_takes_comparisons_of_parameters_as_the_command_line_does(searcher, study):
    space = load_project(study.folder).designs
    speeds = sorted({one.parameters["d7"] for one in space.expand()})
    terms = [f"d7 <= {speeds[0]:g} m/s", f"d7>{speeds[0]:g} m/s", f"robot.tool_speed < {speeds[-1]:g} m/s", "d1>=3"]
    for term in terms:
        wanted = [one.id for one in picked(space, [term])]
        assert 0 < len(wanted) < 72
        assert filtered(searcher, term)[0] == wanted, term


def test_a_table_takes_comparisons_of_estimates(searcher, study):
    times, costs = estimates(study, "t_p"), estimates(study, "C_total")
    limit = statistics.median(one for one in times.values() if one is not None)
    below = [one for one, time in times.items() if time is not None and time < limit - 1e-6]
    cheap = [one for one, cost in costs.items() if cost < 40_000]
    assert 0 < len(below) < 72
    assert 0 < len(cheap) < 72
    for term in (f"t_p<{limit}", f"T_p < {limit} s", f"total_planning_time<{limit}"):
        assert filtered(searcher, term)[0] == below, term
    for term in ("C_total<40000", "SYS-004 < 40,000 USD"):
        assert filtered(searcher, term)[0] == cheap, term
    assert filtered(searcher, f"t_p<{limit} c_total<40000")[0] == sorted({*below} & {*cheap})
    share = sum(one is not None and one >= 0.9 for one in estimates(study, "S").values())
    assert len(filtered(searcher, "S >= 90 %")[0]) == share
    assert find(searcher, "C_total < 40,000")["Variants"] == [f"Variant {one}" for one in cheap[:8]]


def test_the_page_says_that_find_takes_comparisons_and_its_examples_are_some(searcher):
    assert "comparisons of their parameters and estimates, such as " in searcher.text("#find-note")
    examples = searcher.script(
        "return Array.from(document.querySelectorAll('#find-note code'), (one) => one.textContent)"
    )
    assert len(examples) == 2
    for example in examples:
        assert re.fullmatch(r"\d+ rows?", filtered(searcher, example)[1])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("t_pp<3", "0 rows; nothing is named t_pp: did you mean t_p?"),
        ("cost<43000", "0 rows; nothing is named cost: did you mean C_total?"),
        ("t_p<fast", "0 rows; t_p is compared with a number in s, got fast"),
        ("planner>rrt", "0 rows; planner has no order: compare it by = or !="),
        ("plannr=rrt", "0 rows; nothing is named plannr: did you mean planner?"),
        ("planner=rtr", "0 rows; planner is never rtr: did you mean rrt?"),
        ("fingers=nine", "0 rows; fingers is never nine: known are three, two"),
        ("qqqqqq=1", "0 rows; nothing is named qqqqqq"),
    ],
)
def test_an_unknown_filter_of_a_table_gets_a_suggestion(searcher, words, said):
    assert filtered(searcher, words) == ([], said)
    find(searcher, words)
    assert re.fullmatch(rf"(Nothing|\d+) found{re.escape(said.removeprefix('0 rows'))}", searcher.text("#found-count"))


def test_a_column_sorts_up_down_and_not_at_all(reader, page, study):
    reader.open(page)
    values = study.document["variants"]["value"]
    by_rank = [row[0] for row in reader.rows("#verdict-table")]
    head = "//*[@id='verdict-table']//th[. = 'value']"
    there = sorted(one for one in values if one is not None)

    for expected, direction in ((there, "ascending"), (there[::-1], "descending")):
        reader.driver.find_element(By.XPATH, f"{head}/button").click()
        shown = [row[3] for row in reader.rows("#verdict-table")]
        assert [float(one) for one in shown if one != "–"] == pytest.approx(expected, rel=1e-3)
        # What has no value comes last either way.
        assert set(shown[len(there) :]) <= {"–"}
        assert reader.driver.find_element(By.XPATH, head).get_attribute("aria-sort") == direction
    reader.driver.find_element(By.XPATH, f"{head}/button").click()
    assert [row[0] for row in reader.rows("#verdict-table")] == by_rank
    assert reader.driver.find_element(By.XPATH, head).get_attribute("aria-sort") is None


def test_a_table_of_the_template_sorts_too(reader, page):
    reader.open(page)
    table = "#verification .scroll"
    ids = [row[0] for row in reader.rows(table)]
    reader.script("document.querySelector(arguments[0] + ' button.sort').click()", table)
    assert [row[0] for row in reader.rows(table)] == sorted(ids)
    reader.script("document.querySelector(arguments[0] + ' button.sort').click()", table)
    assert [row[0] for row in reader.rows(table)] == sorted(ids, reverse=True)


def test_the_contents_stay_in_view_and_mark_where_the_reader_is(reader, page):
    reader.open(page, width=1440)
    reader.script("document.getElementById('pareto').scrollIntoView()")
    reader.until("return document.querySelector('#contents [aria-current]')?.hash === '#pareto'")
    box = reader.script("const b = document.getElementById('contents').getBoundingClientRect(); return [b.top, b.left]")
    assert box == [0, 0]
    links = reader.script(
        "return Array.from(document.querySelectorAll('#contents a'), (one) => one.hash.slice(1))"
        ".filter((id) => document.getElementById(id) === null)"
    )
    assert links == []

    reader.open(page, width=400)
    assert not reader.script("return document.getElementById('contents').open")
    reader.driver.find_element(By.CSS_SELECTOR, "#contents summary").click()
    reader.driver.find_element(By.CSS_SELECTOR, "#contents a[href='#weights']").click()
    assert not reader.script("return document.getElementById('contents').open")
    assert reader.accessibility_findings(without=("main",)) == []
