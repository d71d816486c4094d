"""The traceability page: one file, everything in it escaped, nothing loaded, the same bytes every time."""

from __future__ import annotations

import builtins
import re
from html.parser import HTMLParser

import pytest

from rgss.errors import DefinitionError
from rgss.reports.diagrams.diagrams import diagrams_of, drawings_for_page
from rgss.reports.page import script_hash
from rgss.reports.trace import html as trace_html
from rgss.reports.trace.report import trace_report
from rgss.trace.views.chain import chain_of
from rgss.trace.views.impact import impact_of

from .one_file import only_file

HOSTILE = "</title><script>alert(1)</script><img src=x onerror=alert(2)> \" ' & {{ 7 * 7 }} 🤖"
VOID = {"meta", "input", "br", "link", "img", "hr"}


class Page(HTMLParser):
    """Reads a page: its elements with their attributes, its text, and whether every element is closed."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self._open: list[str] = []
        self.feed(text)
        self.close()
        assert self._open == []

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self._open.pop() == tag

    def handle_data(self, data):
        if self._open and self._open[-1] not in ("script", "style"):
            self.text += data

    def tags(self, name: str) -> list[dict[str, str | None]]:
        return [attributes for tag, attributes in self.elements if tag == name]


@pytest.fixture
def model(tmp_path, story):
    return story.model(story.write(tmp_path / "requirements"))


@pytest.fixture
def report(model, story):
    return trace_report(model, story.evidence(), title="Traceability of the story")


def page_of(report, **options) -> str:
    return only_file(report, None, "html", **options).decode("utf-8")


def test_the_matrices_are_those_of_the_model(report):
    text = page_of(report)

    for part in report.matrices:
        section = text.split(f'<section id="matrix-{part.name}"')[1].split("</section>")[0]
        grid = section.split('<table class="matrix"')[1].split("</table>")[0]
        columns = re.findall(r'<div class="upright">.*?class="id"[^>]*>([^<]*)<', grid)
        rows = re.findall(r'<tr data-row="[a-z]*" data-id="([^"]*)".*?</tr>', grid, re.DOTALL)
        cells = [
            re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL)
            for row in re.findall(r"<tr data-row.*?</tr>", grid, re.DOTALL)
        ]
        assert (tuple(columns), tuple(rows)) == (part.matrix.columns, part.matrix.rows)
        marked = tuple(tuple(index for index, cell in enumerate(row) if "linked" in cell) for row in cells)
        assert marked == part.matrix.linked


def test_every_link_within_the_page_has_an_end(report):
    page = Page(page_of(report))
    anchors = [attributes["id"] for _, attributes in page.elements if attributes.get("id")]

    assert len(anchors) == len(set(anchors))
    assert {link["href"][1:] for link in page.tags("a")} <= set(anchors)
    named = {name for _, attributes in page.elements for name in (attributes.get("aria-labelledby") or "").split()}
    assert named <= set(anchors)


def test_it_loads_nothing_and_runs_only_its_own_script(report):
    text = page_of(report)
    page = Page(text)
    scripts = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    (policy,) = [one["content"] for one in page.tags("meta") if one.get("http-equiv") == "Content-Security-Policy"]

    # That of every page, and that of the pages of diagrams.
    assert len(scripts) == 2
    assert "script-src " + " ".join(f"'{script_hash(script)}'" for script in scripts) + ";" in policy
    assert "default-src 'none'" in policy
    assert not [name for name, _ in page.elements if name in ("link", "img", "iframe", "object", "embed", "base")]
    loading = [
        value for _, attributes in page.elements for key, value in attributes.items() if key in ("src", "srcset")
    ]
    assert loading == []
    assert not re.search(r"url\(|@import|https?://(?!www\.w3\.org/2000/svg)", text)
    assert not [key for _, attributes in page.elements for key in attributes if key.startswith("on")]


@pytest.mark.parametrize("kind", ["report", "gaps", "chain", "impact"])
def test_texts_are_shown_and_never_executed(tmp_path, story, kind):
    quoted = "'" + HOSTILE.replace("'", "''") + "'"
    folder = story.write(
        tmp_path / "hostile",
        {
            "system.yaml": {
                "The gripper shall open.": quoted,
                "It opens in 20 of 20 runs.": quoted,
                "The script shall stop.": quoted,
            },
            "stakeholder.yaml": {"The system shall cost little.": quoted},
            "architecture.yaml": {"text: Touches.": f"text: {quoted}", "name: Hook": f"name: {quoted}"},
        },
    )
    model, evidence = story.model(folder), story.evidence(choice=HOSTILE)
    report = trace_report(model, evidence, title=HOSTILE)
    text = {
        "report": lambda: page_of(report),
        "gaps": lambda: page_of(report, gaps_only=True),
        "chain": lambda: only_file(report, chain_of(model, evidence, "SYS-2"), "html").decode("utf-8"),
        "impact": lambda: only_file(report, impact_of(model, evidence, "SYS-1"), "html").decode("utf-8"),
    }[kind]()
    page = Page(text)

    assert HOSTILE in page.text
    assert "49" not in page.text.replace(HOSTILE, "")
    assert len(page.tags("script")) == (2 if kind == "report" else 1)
    assert page.tags("img") == []
    assert not [key for _, attributes in page.elements for key in attributes if key.startswith("on")]


def test_the_same_report_gives_the_same_page(report):
    assert page_of(report) == page_of(report)


def test_headers_are_headers(report):
    page = Page(page_of(report))

    assert all(head.get("scope") in ("col", "row") for head in page.tags("th"))
    assert page.tags("html") == [{"lang": "en", "class": "no-js"}]
    assert page.tags("meta")[1] == {"name": "viewport", "content": "width=device-width, initial-scale=1"}
    skips = [link["href"] for link in page.tags("a") if link.get("class") == "skip"]
    assert skips[:3] == ["#main", "#coverage", "#matrix-stakeholder-moe"]


def test_diagrams_are_in_the_page_each_with_ids_of_its_own(report):
    page = Page(page_of(report))
    drawings = diagrams_of(report.model.requirements)

    assert len(page.tags("svg")) == len(drawings) == len(drawings_for_page(drawings))
    assert [figure["id"] for figure in page.tags("figure")] == [f"d-{drawing.name}" for drawing in drawings]
    # One for the page, one for all diagrams: a style in each would be as many times the same.
    assert len(page.tags("style")) == 2


def test_without_graphviz_the_page_says_what_is_left_out(report, monkeypatch):
    without(monkeypatch, "pygraphviz")
    page = Page(page_of(report))

    assert page.tags("svg") == []
    assert "The diagrams are left out: diagrams need the package pygraphviz, which is not installed" in page.text


def test_gaps_only_has_neither_matrices_nor_diagrams(report):
    page = Page(page_of(report, gaps_only=True))

    assert [section["id"] for section in page.tags("section")] == ["coverage", "gaps", "verification"]
    assert page.tags("svg") == []


def test_a_page_that_would_be_too_long_shows_what_has_gaps(report, monkeypatch):
    monkeypatch.setattr(trace_html, "MOST_ROWS", 3)
    page = Page(page_of(report))
    rows = [row["id"] for row in page.tags("tr") if row.get("id", "").startswith("r-")]

    assert rows == ["r-SYS-3", "r-SYS-4"]
    assert "These are 4 rows, too many for a page: it shows the 2 of them with a gap." in page.text
    anchors = {attributes.get("id") for _, attributes in page.elements}
    assert {link["href"][1:] for link in page.tags("a")} <= anchors


def test_without_jinja2_one_line_says_what_to_do(report, monkeypatch):
    without(monkeypatch, "jinja2")
    with pytest.raises(DefinitionError) as caught:
        page_of(report, gaps_only=True)

    assert str(caught.value) == "an HTML page needs the package jinja2, which is not installed (pip install jinja2)"


def without(monkeypatch, package: str) -> None:
    """Make a package one that is not installed."""
    original = builtins.__import__

    def refuse(name, *arguments, **options):
        if name.split(".")[0] == package:
            raise ImportError(name)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", refuse)
