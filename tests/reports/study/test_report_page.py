"""What a report's page carries: data that no text can break out of, and a library that stays asleep."""

from __future__ import annotations

import base64
import builtins
import gzip
import json

import pytest

from rgss.errors import DefinitionError
from rgss.invisible_characters import visible_throughout
from rgss.reports.page import breakable_to_html, options_to_html, render_page, script_hash, template_text
from rgss.reports.study import embedded_json, packed_json, parted
from rgss.reports.study_page import plotting_library

HOSTILE = "</script><!--<script>alert(1)</script> & \u2028\u2029 \"'` =SUM(1) 🤖 ]]>"


def test_embedded_json_ends_no_element_and_reads_back():
    document = {HOSTILE: [HOSTILE, 1.5, None, {"deep": HOSTILE}]}
    text = embedded_json(document)

    assert text.isascii()
    assert not set("<>&\u2028\u2029") & set(text)
    assert json.loads(text) == visible_throughout(document)


def test_embedded_json_refuses_what_is_no_json():
    with pytest.raises(ValueError, match="not JSON compliant"):
        embedded_json({"value": float("nan")})


def test_packed_json_is_the_same_text_and_the_same_bytes():
    text = embedded_json({"text": HOSTILE, "numbers": list(range(1000))})
    packed = packed_json(text)

    assert gzip.decompress(base64.b64decode(packed)).decode("ascii") == text
    assert packed_json(text) == packed
    assert len(packed) < len(text)


def test_what_nothing_weighs_or_demands_comes_later():
    column = [1.0, 2.0]

    def measure(name, *, kind="mop", weight=None, value=column):
        return {"id": name, "kind": kind, "weight": weight, "value": value, "low": column, "high": column, "n": 3}

    measures = [
        measure("effective", kind="moe"),
        measure("weighed", weight=0.2),
        measure("demanded"),
        measure("other"),
        measure("alike", value=4.0) | {"low": 3.0, "high": 5.0},
    ]
    document = {"measures": measures, "requirements": [{"measure": "demanded"}], "rest": 1}
    before = json.dumps(document)
    first, later = parted(document)

    assert later == {"other": {"value": column, "low": column, "high": column}}
    assert first["measures"][3] == {"id": "other", "kind": "mop", "weight": None, "n": 3}
    assert [*first["measures"][:3], first["measures"][4]] == [*measures[:3], measures[4]]
    assert first["rest"] == 1
    assert json.dumps(document) == before


def test_the_plotting_library_cannot_end_its_element():
    library = plotting_library()

    assert "plotly.js v" in library[:200]
    assert "</script" not in library.lower()
    assert "<!--" not in library


def test_a_missing_library_is_told_in_one_line(monkeypatch):
    imported = builtins.__import__

    def without_plotly(name, *arguments, **options):
        if name.startswith("plotly"):
            raise ImportError(name)
        return imported(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", without_plotly)
    with pytest.raises(DefinitionError, match="needs the package plotly, which is not installed") as error:
        plotting_library()
    assert error.value.hint == "pip install plotly"


def test_a_held_script_is_carried_but_not_run():
    page = render_page(
        "trace/impact.html.j2", title="T", groups=[], scripts=["one();"], held_scripts=["two();"], styles=["b { }"]
    )

    assert '<script type="text/plain" class="held">two();</script>' in page
    assert "<script>one();</script>" in page
    assert f"'{script_hash('one();')}' '{script_hash('two();')}'" in page
    assert "b { }</style>" in page
    assert "img-src" not in page


def test_a_browser_cannot_break_an_id_at_its_hyphen():
    assert options_to_html("open (by SYS-2, SYS-030), an A-1-B, UTF-8-like") == (
        'open (by <span class="option">SYS-2</span>, <span class="option">SYS-030</span>), an A-1-B, UTF-8-like'
    )


def test_a_long_id_breaks_at_the_ends_of_its_parts():
    text = f"t_mean.of<b> SYS-030 --what-if 0.25 a/b {'x' * 30}"
    html = breakable_to_html(text)
    assert html == (
        't_<wbr>mean.<wbr>of&lt;b&gt; <span class="option">SYS-030</span> <span class="option">--what-if</span> 0.25 '
        f"a/<wbr>b {'x' * 24}<wbr>{'x' * 6}"
    )
    assert html.replace("<wbr>", "") == options_to_html(text)


def test_a_browser_cannot_break_an_option_between_its_hyphens():
    assert options_to_html('rgss trade --what-if "a<b--c" --run, -- 5') == (
        'rgss trade <span class="option">--what-if</span> &quot;a&lt;b--c&quot; <span class="option">--run</span>, -- 5'
    )
    assert "\n.option { white-space: nowrap; }\n" in template_text("page/page.css")
