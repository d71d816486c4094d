"""Weights that are moved in a report: the ranking is the one of the trade-off."""

from __future__ import annotations

from copy import deepcopy
from itertools import product

import pytest
from selenium.webdriver.common.by import By

from rgss.reports.study_page import study_report_to_html

pytestmark = pytest.mark.browser


def test_a_weight_ranks_the_variants_anew_as_the_figures_say(reader, page, study):
    reader.open(page)
    document = study.document
    ids, feasible = document["variants"]["id"], document["variants"]["feasible"]
    weighted = document["weights"]["measures"]
    ranked = sorted((rank, one) for rank, one in zip(document["variants"]["rank"], ids, strict=True) if rank)

    before = [int(row[1]) for row in reader.rows("#ranking-table")]
    assert before == [variant for _, variant in ranked[:10]]
    assert reader.text("#weight-winner") == f"Variant {document['decision']['chosen']} stays the best."

    def worth(row, raw):
        worths = [one["worth"][row] if isinstance(one["worth"], list) else one["worth"] for one in weighted]
        return sum(share / sum(raw) * worth for share, worth in zip(raw, worths, strict=True) if share)

    def ranking(moved, to):
        # What one weight gains the others lose in proportion.
        rest = sum(one["weight"] for at, one in enumerate(weighted) if at != moved)
        raw = [to if at == moved else (1.0 - to) * one["weight"] / rest for at, one in enumerate(weighted)]
        return sorted((-round(worth(row, raw), 9), ids[row]) for row in range(len(ids)) if feasible[row])

    # A weight that changes the first place.
    chosen = document["decision"]["chosen"]
    moves = product(range(len(weighted)), (0.0, 0.25, 0.5, 0.75, 0.9))
    moved, to = next(move for move in moves if ranking(*move)[0][1] != chosen)
    expected = ranking(moved, to)
    reader.script(
        "const [id, to] = arguments; const slider = document.getElementById(id);"
        "slider.value = String(to); slider.dispatchEvent(new Event('input'))",
        f"weight-{moved}",
        to,
    )
    shares = reader.script("return Array.from(document.querySelectorAll('#weight-rows output'), (one) => one.value)")
    assert sum(map(float, shares)) == pytest.approx(1.0, abs=0.003)
    assert float(shares[moved]) == to
    sliders = reader.script("return Array.from(document.querySelectorAll('#weight-rows input'), (one) => one.value)")
    assert [float(one) for one in sliders] == pytest.approx([float(one) for one in shares], abs=0.006)
    after = reader.rows("#ranking-table")
    assert [int(row[1]) for row in after] == [variant for _, variant in expected[:10]]
    assert [float(row[2]) for row in after] == pytest.approx([-one for one, _ in expected[:10]], abs=5e-5)
    assert [int(row[1]) for row in after] != before
    assert f"Variant {expected[0][1]} would be the best" in reader.text("#weight-winner")

    reader.driver.find_element(By.ID, "weight-reset").click()
    assert [int(row[1]) for row in reader.rows("#ranking-table")] == before


def test_the_scale_of_a_target_names_both_of_its_ends(reader, study, tmp_path):
    document = deepcopy(study.document)
    first, second = document["weights"]["measures"][:2]
    first |= {"worst": 2, "best": 4, "too_high": 6}
    second |= {"worst": 2, "best": 4}
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)
    scales = reader.script(
        "return Array.from(document.querySelectorAll('#weight-rows .small'), (one) => one.textContent)"
    )
    units = {one["id"]: "" if one["unit"] == "1" else f" {one['unit']}" for one in document["measures"]}
    unit, other = units[first["id"]], units[second["id"]]
    assert scales[:2] == [f"0 at 2{unit} and 6{unit}, 1 at 4{unit}", f"0 at 2{other}, 1 at 4{other}"]


def test_of_equals_only_measures_that_have_a_weight_now_are_compared(reader, study, tmp_path):
    document = deepcopy(study.document)
    weighted = document["weights"]["measures"]
    document["weights"]["of_equals"] = "first"
    columns = {one["id"]: one for one in document["measures"]}
    rows = [row for row, feasible in enumerate(document["variants"]["feasible"]) if feasible]
    least, one, other = (document["variants"]["id"][row] for row in rows[:3])
    # All are worth 1 at any weights; one is better in the first measure beyond its best end, another in the second.
    better = {weighted[0]["id"]: rows[1], weighted[1]["id"]: rows[2]}
    for measure in weighted:
        measure["worth"] = 1.0
        quantities = [5.0] * len(document["variants"]["id"])
        if measure["id"] in better:
            quantities[better[measure["id"]]] = 6.0 if measure["more_is_better"] else 4.0
        columns[measure["id"]]["value"] = quantities
    file = tmp_path / "report.html"
    file.write_text(study_report_to_html(document, study.trace), encoding="utf-8")
    reader.open(file)

    def first_with(place, weight):
        reader.driver.find_element(By.ID, "weight-reset").click()
        reader.script(
            "const [id, to] = arguments; const slider = document.getElementById(id);"
            "slider.value = String(to); slider.dispatchEvent(new Event('input'))",
            f"weight-{place}",
            weight,
        )
        return int(reader.rows("#ranking-table")[0][1])

    assert first_with(0, weighted[0]["weight"]) == one
    assert first_with(0, 0.0) == other
    assert first_with(1, 0.0) == one
    assert first_with(2, 1.0) == least
