"""A guard's report as JSON, as JUnit XML, and as Markdown for a pull request."""

from __future__ import annotations

import re
from typing import Any
from xml.etree import ElementTree as ET

from rgss.documents.steering import escaped_for_xml
from rgss.invisible_characters import visible
from rgss.regression.comparing import Comparison, Outcome
from rgss.regression.report import RegressionReport, Trouble
from rgss.reports.regression_words import behaviour_of, counts_of, detail_of, listed, quantity

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_MARKDOWN = re.compile(r"([\\`*_{}\[\]()#+!|~$@-])")
_SIGNS = {
    Outcome.MISSING: "❌",
    Outcome.WORSE: "❌",
    Outcome.INCONCLUSIVE: "❔",
    Outcome.BETTER: "✅",
    Outcome.SAME: "✅",
}


def report_to_json(report: RegressionReport) -> dict[str, Any]:
    """The report as plain data; quantities in the unit that stands beside them."""
    return {
        "study": report.study,
        "baseline": report.baseline,
        "verdict": report.verdict,
        "fails": report.fails,
        "error_rate": report.error_rate,
        "looks": report.looks,
        "seeds": dict(report.trials),
        "failing": [{"trouble": one.trouble.value, "text": one.text} for one in report.failing],
        "comparisons": [_comparison(one) for one in report.comparisons],
        "behaviour": {
            "compared": report.behaviour.compared,
            "changed": [
                {"run": one.run, "variant": one.variant, "seed": one.seed, "phase": one.phase}
                for one in report.behaviour.changed
            ],
            "platform": report.behaviour.platform,
        },
        "notes": list(report.notes),
    }


def report_to_junit(report: RegressionReport) -> bytes:
    """The report as JUnit XML: a case for each comparison, for each other failure and for behaviour.

    What fails the guard fails its case; a trial that could not be run is an error; what is
    inconclusive is skipped, with the reason.
    """
    cases: list[tuple[str, str, str, str, str]] = [
        (
            f"rgss.regress.{one.subject.run}",
            str(one.subject),
            _element_of(one.outcome),
            one.outcome.value,
            detail_of(one),
        )
        for one in report.comparisons
    ]
    cases += [
        (
            "rgss.regress",
            f"{one.trouble.value}: {one.text}",
            _element_of_trouble(one.trouble),
            one.trouble.value,
            one.text,
        )
        for one in report.failing
    ]
    cases.append(("rgss.regress", "behaviour", "system-out", "", behaviour_of(report)))
    suite = ET.Element(
        "testsuite",
        name=_xml(f"rgss regress {report.study}"),
        tests=str(len(cases)),
        failures=str(sum(case[2] == "failure" for case in cases)),
        errors=str(sum(case[2] == "error" for case in cases)),
        skipped=str(sum(case[2] == "skipped" for case in cases)),
    )
    for owner, name, element, word, text in cases:
        case = ET.SubElement(suite, "testcase", classname=_xml(owner), name=_xml(name), time="0")
        if element in ("failure", "error", "skipped"):
            ET.SubElement(case, element, message=_xml(f"{word}: {text}"))
        else:
            ET.SubElement(case, "system-out").text = _xml(text)
    ET.indent(suite)
    text = escaped_for_xml(ET.tostring(suite, encoding="unicode"))
    return f"<?xml version='1.0' encoding='utf-8'?>\n{text}\n".encode()


def report_to_markdown(report: RegressionReport) -> str:
    """The report as Markdown; what comes from files shows as text, whatever it is."""
    lines = [f"### Regression guard: {report.verdict}", "", _text(f"{report.study} against {report.baseline}"), ""]
    if report.failing:
        lines += [f"- ❌ **{one.trouble.value}**: {_text(one.text)}" for one in report.failing]
        lines.append("")
    shown = [one for one in listed(report) if one.outcome is not Outcome.SAME]
    if shown:
        lines += ["| | metric | phase | run | baseline | now | finding |", "|---|---|---|---|---:|---:|---|"]
        lines += [_row(one) for one in shown]
        lines.append("")
    lines.append(_text(counts_of(report)) + ".")
    lines += ["", _text(behaviour_of(report)) + "."]
    if report.notes:
        lines += ["", *(f"- {_text(note)}" for note in report.notes)]
    return "\n".join(lines) + "\n"


def _comparison(one: Comparison) -> dict[str, Any]:
    return {
        "run": one.subject.run,
        "metric": one.subject.metric,
        "phase": one.subject.phase,
        "verdict": one.outcome.value,
        "unit": one.guard.unit,
        "better": "higher" if one.guard.higher_is_better else "lower",
        "margin": one.guard.margin,
        "baseline": one.baseline_mean,
        "now": one.current_mean,
        "worse_by": one.worsening,
        "low": one.low,
        "high": one.high,
        "pairs": one.pairs,
        "lost": one.lost,
        "seeds": one.seeds,
        "look": one.look,
        "identical": one.identical,
        "p_values": dict(one.p_values),
    }


def _element_of(outcome: Outcome) -> str:
    if outcome in (Outcome.WORSE, Outcome.MISSING):
        return "failure"
    return "skipped" if outcome is Outcome.INCONCLUSIVE else "system-out"


def _element_of_trouble(trouble: Trouble) -> str:
    return "error" if trouble is Trouble.NOT_RUN else "failure"


def _row(one: Comparison) -> str:
    cells = (
        f"{_SIGNS[one.outcome]} {one.outcome.value}",
        _text(one.subject.metric),
        _text(one.subject.phase),
        _text(one.subject.run),
        quantity(one.baseline_mean, one.guard.unit),
        quantity(one.current_mean, one.guard.unit),
        _text(detail_of(one)),
    )
    return f"| {' | '.join(cells)} |"


def _text(text: str) -> str:
    """Text that Markdown shows as it is: marks are escaped, HTML is written out, lines are joined."""
    plain = " ".join("".join(sign if sign.isprintable() else " " for sign in visible(text)).split())
    escaped = _MARKDOWN.sub(r"\\\1", plain)
    return escaped.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _xml(text: str) -> str:
    return _NOT_XML.sub("�", text)
