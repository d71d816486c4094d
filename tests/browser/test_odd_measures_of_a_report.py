"""Charts of measures that are the same everywhere, or that crowd: what opens, what is said, what covers what."""

from __future__ import annotations

import copy
from itertools import combinations

import pytest

from rgss.reports.study_page import study_report_to_html

pytestmark = pytest.mark.browser

_MARKS_AND_NUMBERS = """
const boxes = (found) => Array.from(found, (one) => {
  const box = one.getBoundingClientRect();
  return [box.left, box.top, box.right, box.bottom];
});
const texts = Array.from(document.querySelectorAll('#pareto-plot .textpoint text'));
return {
  marks: boxes(document.querySelectorAll('#pareto-plot .scatterlayer .points path')),
  numbers: boxes(texts.filter((one) => one.textContent.startsWith('\u00d7'))),
};
"""


def _written(document, study, tmp_path):
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    return file


def _seen(reader, name):
    reader.script(f"document.getElementById('{name}-plot').scrollIntoView()")
    reader.until(f"return document.querySelector('#{name}-plot').querySelector('.main-svg, p') !== null")


def _choose(reader, select, value):
    reader.script(
        "const select = document.getElementById(arguments[0]); select.value = arguments[1];"
        "select.dispatchEvent(new Event('change'))",
        select,
        value,
    )


def _offered(reader, name):
    return reader.script(
        "return Array.from(document.getElementById(`${arguments[0]}-plot`).nextElementSibling"
        ".querySelectorAll('button')).filter((one) => one.checkVisibility()).map((one) => one.textContent)",
        name,
    )


def test_a_measure_that_is_the_same_everywhere_is_not_the_first_that_is_shown(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    reader.open(_written(document, study, tmp_path))
    opened = reader.script("return document.getElementById('effect-choice').value")
    alike = next(one for one in document["measures"] if one["id"] == opened)
    alike |= {"value": 2e-9, "low": 2e-9, "high": 2e-9}
    designs = next(one for one in document["effects"] if one["measure"] == opened)["designs"]

    reader.open(_written(document, study, tmp_path))
    for select in ("effect-choice", "measure-choice"):
        chosen = reader.script("return document.getElementById(arguments[0]).value", select)
        assert len(set(next(one for one in document["measures"] if one["id"] == chosen)["value"])) > 1
    _seen(reader, "effects")
    assert _offered(reader, "effects") == ["PNG", "SVG", "CSV"]

    _choose(reader, "effect-choice", opened)
    assert reader.text("#effect-note").startswith(f"{opened} is 2e-9")
    assert reader.text("#effect-note").endswith(f" in all {designs} designs: no factor changes it.")
    assert _offered(reader, "effects") == ["CSV"]

    _seen(reader, "pareto")
    _choose(reader, "pareto-x", opened)
    ends = reader.script("return Array.from(document.getElementById('pareto-plot').layout.xaxis.range)")
    assert ends == pytest.approx([1.8e-9, 2.2e-9])
    assert reader.complaints() == []


def test_a_plot_without_a_picture_and_a_table_offers_no_file(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    document["decision"]["acceptability"] = None
    reader.open(_written(document, study, tmp_path))
    _seen(reader, "acceptability")

    assert reader.text("#acceptability-plot") == "There is nothing to draw here."
    assert _offered(reader, "acceptability") == []


def test_marks_and_numbers_of_many_variants_do_not_cover_each_other(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    count = len(document["variants"]["id"])
    document["variants"] |= {"feasible": [1] * count, "pareto": [None] * count, "rank": [None] * count}
    document["decision"] |= {"chosen": None, "runner_up": None}
    reader.open(_written(document, study, tmp_path))
    axes = [reader.script("return document.getElementById(arguments[0]).value", f"pareto-{one}") for one in "xy"]
    for axis, step in zip(axes, (7, 11), strict=True):
        measure = next(one for one in document["measures"] if one["id"] == axis)
        measure["value"] = [float((step * place**2) % 61) for place in range(count)]

    reader.open(_written(document, study, tmp_path), width=1440)
    _seen(reader, "pareto")
    found = reader.script(_MARKS_AND_NUMBERS)
    assert len(found["numbers"]) > 2
    for one, other in combinations(found["marks"], 2):
        across = min(one[2], other[2]) - max(one[0], other[0])
        up = min(one[3], other[3]) - max(one[1], other[1])
        assert min(across, up) < 4, (one, other)
    for left, top, right, bottom in found["numbers"]:
        for mark in found["marks"]:
            apart = mark[2] <= left + 1 or right - 1 <= mark[0] or mark[3] <= top + 3 or bottom - 3 <= mark[1]
            assert apart, ((left, top, right, bottom), mark)


def test_marks_are_merged_anew_when_the_plot_gets_another_width(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    count = len(document["variants"]["id"])
    reader.open(_written(document, study, tmp_path))
    across, up = (reader.script("return document.getElementById(arguments[0]).value", f"pareto-{one}") for one in "xy")
    for one in document["measures"]:
        if one["id"] in (across, up):
            one["value"] = [float(place) if one["id"] == across else 1.0 for place in range(count)]
    marks = "return document.querySelectorAll('#pareto-plot .scatterlayer .points path').length"
    found = []
    for width in (1440, 390):
        reader.open(_written(document, study, tmp_path), width=width)
        _seen(reader, "pareto")
        found.append(reader.script(marks))
    assert found[0] > found[1]

    size = {"width": 1440, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    reader.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    reader.script("document.getElementById('pareto-plot').scrollIntoView()")
    reader.until(f"{marks} === {found[0]}")


def test_a_parameter_named_role_is_not_the_role_in_the_decision(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    varying = next(one for one in document["parameters"] if one["varies"] and len(set(one["values"])) == 2)
    varying |= {"id": "role", "name": "role of the arm"}
    reader.open(_written(document, study, tmp_path))
    values = "Array.from(document.getElementById('distribution-by').options, (one) => one.value)"
    offered = reader.script(f"return {values}")
    assert len(offered) == len(set(offered))
    for value in ("role", next(one for one in offered if "role" in one and one != "role")):
        reader.open(_written(document, study, tmp_path))
        _choose(reader, "distribution-by", value)
        reader.until("return location.hash.includes('by=')")
        address = reader.script("return location.href")
        reader.driver.get("about:blank")
        reader.driver.get(address)
        reader.until("return document.documentElement.dataset.ready === 'yes'")
        assert reader.script("return document.getElementById('distribution-by').value") == value


@pytest.mark.parametrize("width", [1440, 320])
def test_a_name_of_eighty_characters_without_a_blank_stays_in_its_place(reader, study, tmp_path, width):
    document = copy.deepcopy(study.document)
    for one in document["measures"]:
        one["name"] = f"{one['id']}_{'of_the_cup_upon_the_tray_' * 4}"[:80]
    page = tmp_path / "report.html"
    page.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(page, width=width)
    assert reader.script("return document.querySelectorAll('.bullet').length") > 2
    assert reader.script("return document.documentElement.scrollWidth - document.documentElement.clientWidth") == 0
    beyond = reader.script(
        "return Array.from(document.querySelectorAll('.bullet-verdict, .weight output'), (one) =>"
        " one.getBoundingClientRect().right - one.parentElement.getBoundingClientRect().right).filter((by) => by > 1)"
    )
    assert beyond == []


_LEGENDS = """
return Array.from(document.querySelectorAll('.plot.js-plotly-plot'))
  .filter((one) => one.querySelector('.legend .bg') && one.checkVisibility())
  .map((one) => {
    const tops = Array.from(one.querySelectorAll('.draglayer .nsewdrag'), (each) => each.getBoundingClientRect().top);
    const legend = one.querySelector('.legend .bg').getBoundingClientRect();
    return [one.id, legend.bottom - Math.min(...tops), one.getBoundingClientRect().top - legend.top];
  });
"""


@pytest.mark.parametrize(("before", "after"), [(390, 1440), (1440, 390)])
def test_no_legend_covers_a_plot_whose_window_changed_its_width(reader, page, before, after):
    reader.open(page, width=before)
    reader.see_all_plots()
    reader.driver.execute_cdp_cmd(
        "Emulation.setDeviceMetricsOverride", {"width": after, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    )
    reader.until(
        "return Array.from(document.querySelectorAll('.plot.js-plotly-plot'))"
        ".every((one) => Math.abs(one._fullLayout.width - one.clientWidth) < 4)"
    )
    found = reader.script(_LEGENDS)
    assert len(found) > 5
    for name, over, outside in found:
        assert over <= 0, name
        # The room above a plot is no larger than its legend needs.
        assert outside == pytest.approx(-13, abs=3), name


def test_marks_of_one_kind_have_a_legend(reader, study, tmp_path):
    document = copy.deepcopy(study.document)
    count = len(document["variants"]["id"])
    document["variants"] |= {"feasible": [0] * count, "pareto": [None] * count, "rank": [None] * count}
    document["decision"] |= {"chosen": None, "runner_up": None}
    reader.open(_written(document, study, tmp_path))
    _seen(reader, "pareto")
    assert (
        reader.script("return document.querySelector('#pareto-plot .legend')?.textContent") == "infeasible by estimates"
    )
    assert reader.text("#pareto-note").startswith("No variant is feasible by its estimates")
