"""The sensitivity on the page for terminals, in the document and in the report."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from types import SimpleNamespace

import pytest

from rgss.decision.sensitivity import InputKind, RangeBasis, Tornado, TornadoBar, TornadoEnd
from rgss.reports.decision.json.sensitivity import tornado_to_json
from rgss.reports.decision.meanings import meanings
from rgss.reports.decision.sensitivity_sentences import keep_rule
from rgss.reports.decision.text.tornado import PAGE_WIDTH, tornado_lines
from rgss.reports.decision.tornado_picture import tornado_svg


def end(value, lead, *, feasible=True, flip=None):
    return TornadoEnd(
        value=value,
        lead=lead,
        feasible=feasible,
        winners=(1,) if lead is not None and lead >= 0 else (2, 3),
        rival=2,
        flip=flip,
        flip_winners=() if flip is None else (2, 3),
    )


def bar(name, low, high, *, swing=None):
    leads = [one.lead for one in (low, high) if one.lead is not None]
    return TornadoBar(
        id=name,
        kind=InputKind.WEIGHT,
        unit="1",
        base=0.5,
        basis=RangeBasis.SHARE,
        low=low,
        high=high,
        swing=max([0.1, *leads]) - min([0.1, *leads]) if swing is None else swing,
        exact=True,
    )


@pytest.fixture
def tornado():
    return Tornado(
        chosen=1,
        rival=2,
        lead=0.1,
        bars=(
            bar("SYS-001.threshold", end(0.4, None, feasible=False, flip=0.45), end(0.6, 0.1), swing=math.inf),
            bar("weight.<a>", end(0.4, -0.1, flip=0.42), end(0.6, 0.3)),
            bar("weight.b", end(0.4, 0.05), end(0.6, 0.02)),
            bar("weight.c", end(0.4, 0.1), end(0.6, 0.1)),
        ),
        without_range=("catalogue.free.cost",),
    )


def test_bars_are_drawn_to_scale_within_eighty_columns(tornado):
    lines = list(tornado_lines(tornado))
    drawn = {line.split()[0]: line for line in lines if line.startswith(("SYS", "weight.")) and "│" in line}
    both = drawn["weight.<a>"]

    assert all(len(line) <= PAGE_WIDTH for line in drawn.values())
    # From -0.1 over 0.1 to 0.3: the same length on both sides of the middle.
    assert both.count("▒") == pytest.approx(both.count("█"), abs=1)
    assert both.count("│") == 1
    assert "✕" in drawn["SYS-001.threshold"]
    # Both ends on one side: the longer one reaches beyond the shorter one.
    assert re.search(r"█+▒+│", drawn["weight.b"])
    assert "weight.c" not in drawn
    assert "1 more input moves nothing within its range (--json names them)." in lines
    assert any("catalogue.free.cost" in line for line in lines)
    assert any(re.match(r"weight\.<a>\s+below 0\.42\s+variants 2, 3", line) for line in lines)


@pytest.mark.parametrize(
    ("margin", "bounded", "rule"),
    [
        (0.0, False, "best for some weights"),
        (0.0, True, "best for some elicited weights"),
        (0.05, False, "within 0.05 of the best for some weights, and no other ahead by more at all weights"),
    ],
)
def test_the_rule_of_designs_worth_keeping_names_a_margin_only_if_there_is_one(margin, bounded, rule):
    assert keep_rule(SimpleNamespace(keep_margin=margin, bounded_weights=bounded)) == rule


def test_a_choice_without_rival(tornado):
    alone = replace(tornado, lead=None, rival=None, bars=())

    assert next(iter(tornado_lines(alone))) == "Tornado: variant 1 has no feasible rival, and so no lead."
    assert tornado_svg(alone) == ""
    # Only an end at which it is infeasible: there is no lead to draw.
    infeasible = bar("SYS-004.threshold", end(0.4, None, feasible=False, flip=0.45), end(0.6, None), swing=math.inf)
    alone = replace(tornado, lead=None, rival=None, bars=(infeasible,))
    lines = list(tornado_lines(alone))
    assert tornado_svg(alone) == ""
    assert not any("+0.0000" in line for line in lines)
    assert any(line.startswith("SYS-004.threshold  below 0.45") for line in lines)


def test_designs_that_are_tied_with_the_choice_are_named(tornado):
    near = replace(tornado, tied=(4,))
    assert next(iter(tornado_lines(near))) == (
        "Tornado: lead of variant 1 over the best other design that is not tied with it (variant 4 is); as it is, "
        "0.1000 over variant 2"
    )
    equal = replace(
        tornado, lead=None, rival=None, tied=(3, 4), bars=(bar("weight.b", end(0.4, -0.05), end(0.6, None)),)
    )
    lines = list(tornado_lines(equal))
    assert lines[0] == "Tornado: every other feasible design is tied with variant 1: variants 3, 4 are worth as much."
    assert any(line.startswith("weight.b") for line in lines)
    assert tornado_svg(equal)


def test_a_lead_that_only_an_end_has_is_drawn_from_0_without_a_present_one(tornado):
    moving = bar("weight.a", end(0.4, None), end(0.6, 0.3))
    texts = [one.text for one in ET.fromstring(tornado_svg(replace(tornado, lead=None, rival=None, bars=(moving,))))]  # noqa: S314
    assert "0" in texts
    assert "0.0000" not in texts


@pytest.mark.parametrize(
    ("lead", "low", "high", "numbers"),
    [
        (0.1, -0.1, 0.3, ["-0.1", "0", "0.2", "0.3", "0.1000"]),
        (0.0158, 0.0009, 0.0201, ["0", "0.005", "0.01", "0.02", "0.0158"]),
    ],
)
def test_the_axis_has_round_numbers_once_and_says_which_end_is_better(tornado, lead, low, high, numbers):
    moving = bar("weight.a", end(0.4, low), end(0.6, high))
    root = ET.fromstring(tornado_svg(replace(tornado, lead=lead, bars=(moving,))))  # noqa: S314 (made here)
    texts = [one.text for one in root if one.tag == "text"]
    assert texts[0] == "lead, greater is better"
    assert [one for one in texts[1:] if one != "weight.a"] == numbers


def test_the_picture_is_well_formed_and_to_scale(tornado):
    root = ET.fromstring(tornado_svg(tornado))  # noqa: S314 (made here)
    rectangles = [one for one in root if one.tag == "rect"]
    widths = {one.find("title").text: float(one.get("width")) for one in rectangles}

    assert not [one for one in root.iter() if one.tag in ("script", "style") or one.get("style")]
    assert widths["weight.<a> at 0.4: lead -0.1000; variants 2, 3"] == pytest.approx(
        widths["weight.<a> at 0.6: lead 0.3000; variant 1"], abs=0.02
    )
    assert "✕" in [one.text for one in root if one.tag == "text"]


def test_the_document_has_no_infinite_number(tornado):
    document = json.loads(json.dumps(tornado_to_json(tornado), allow_nan=False))

    assert document["inputs"][0]["swing"] is None
    assert [one["input"] for one in document["inputs"]] == [one.id for one in tornado.bars]


def test_each_figure_of_acceptability_has_a_sentence():
    for with_noise in (False, True):
        # Without noise, a confidence of 100 % would say nothing.
        names = ("weights", "first", "confidence") if with_noise else ("weights", "first")
        for name, meaning in zip(names, meanings(with_noise=with_noise), strict=True):
            assert meaning.startswith(f"{name}: ")
            assert ("noise" in meaning) == (with_noise and name == "first")
