"""A guard's report as JSON, as JUnit XML, and as Markdown for a pull request."""

from __future__ import annotations

import re
from typing import Any
from xml.etree import ElementTree as ET

from rgss.documents import escaped_for_xml
from rgss.invisible_characters import visible
from rgss.regression import TARGET, Comparison, FailureCause, Outcome, Power, RegressionReport
from rgss.reports.regression.words import (
    behaviour_of,
    counts_of,
    detail_of,
    inputs_of,
    listed,
    power_lines,
    power_text,
    quantity,
    reasons_of,
    remedy_of,
)

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_MARKDOWN = re.compile(r"([\\`*_{}\[\]()#+!|~$@-])")
_SIGNS = {
    Outcome.MISSING: "❌",
    Outcome.WORSE: "❌",
    Outcome.MOVED: "❗",
    Outcome.INCONCLUSIVE: "❔",
    Outcome.BETTER: "✅",
    Outcome.SAME: "✅",
}


def report_to_json(report: RegressionReport) -> dict[str, Any]:
    """The report as plain data; quantities are in the unit beside them."""
    return {
        "study": report.study,
        "baseline": report.baseline,
        "verdict": report.verdict,
        "fails": report.fails,
        "changed": report.has_changes,
        "accepted": report.accepted,
        "error_rate": report.error_rate,
        "looks": report.looks,
        "seeds": dict(report.trials),
        "failing": [{"trouble": one.trouble.value, "text": one.text} for one in report.failing],
        "comparisons": [_comparison(one, report.powers.get(one.subject)) for one in report.comparisons],
        "behaviour": {
            "compared": report.behaviour.compared,
            "changed": [
                {"run": one.run, "variant": one.variant, "seed": one.seed, "phase": one.phase}
                for one in report.behaviour.changed
            ],
            "machine": report.behaviour.machine,
        },
        "inputs": [
            {"kind": one.kind.value, "name": one.name, "then": one.then, "now": one.now, "where": one.where}
            for one in report.inputs
        ],
        "undecided": list(report.undecided),
        "notes": list(report.notes),
    }


def report_to_junit(report: RegressionReport) -> bytes:
    """The report as JUnit XML: a case for each comparison, for each other failure and for behaviour.

    What fails the guard fails its case, and so does changed behaviour without a stated reason; a trial that
    could not be run is an error; what is inconclusive is skipped, with the reason. The power of each comparison
    is a property of the suite.
    """
    cases: list[tuple[str, str, str, str, str]] = [
        (
            f"rgss.regress.{one.subject.run}",
            str(one.subject),
            _element_of(one.outcome, unexplained=report.is_unexplained),
            one.outcome.value,
            detail_of(one),
        )
        for one in report.comparisons
    ]
    cases += [
        (
            "rgss.regress",
            f"{one.trouble.value}: {one.text}",
            _element_of_error(one.trouble),
            one.trouble.value,
            one.text,
        )
        for one in report.failing
    ]
    inconclusive = Outcome.INCONCLUSIVE.value
    cases += [("rgss.regress", text, "skipped", inconclusive, text) for text in report.undecided]
    element = "failure" if report.is_unexplained and list(reasons_of(report)) else "system-out"
    said = dict.fromkeys([behaviour_of(report), *reasons_of(report), *inputs_of(report), remedy_of(report)])
    cases.append(("rgss.regress", "behaviour", element, "changed", "; ".join(each for each in said if each)))
    suite = ET.Element(
        "testsuite",
        name=_xml(f"rgss regress {report.study}"),
        tests=str(len(cases)),
        failures=str(sum(case[2] == "failure" for case in cases)),
        errors=str(sum(case[2] == "error" for case in cases)),
        skipped=str(sum(case[2] == "skipped" for case in cases)),
    )
    properties = ET.SubElement(suite, "properties")
    for one in report.comparisons:
        power = report.powers.get(one.subject)
        if power is not None:
            name = _xml(f"power: {one.subject} (run {one.subject.run})")
            ET.SubElement(properties, "property", name=name, value=_xml(power_text(power, one.guard)))
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
    """The report as Markdown; content of files is escaped."""
    lines = [f"### Regression guard: {report.verdict}", "", _text(f"{report.study} against {report.baseline}"), ""]
    if report.failing:
        lines += [f"- ❌ **{one.trouble.value}**: {_text(one.text)}" for one in report.failing]
        lines.append("")
    reasons = list(reasons_of(report))
    if reasons:
        sign, word = ("✅", "accepted") if report.accepted else ("❗", "changed")
        lines += [*(f"- {sign} **{word}**: {_text(reason)}" for reason in reasons), ""]
    if report.undecided:
        word = Outcome.INCONCLUSIVE
        lines += [*(f"- {_SIGNS[word]} **{word.value}**: {_text(change)}" for change in report.undecided), ""]
    shown = [one for one in listed(report) if one.outcome is not Outcome.SAME]
    if shown:
        lines += ["| | metric | phase | run | baseline | now | finding |", "|---|---|---|---|---:|---:|---|"]
        lines += [_row(one) for one in shown]
        lines.append("")
    lines.append(_text(counts_of(report)) + ".")
    lines += ["", _text(behaviour_of(report)) + "."]
    notes = [*inputs_of(report), *report.notes, *power_lines(report, everything=False)]
    if notes:
        lines += ["", *(f"- {_text(note)}" for note in notes)]
    if remedy_of(report):
        lines += ["", _text(remedy_of(report)) + "."]
    return "\n".join(lines) + "\n"


def _comparison(one: Comparison, power: Power | None) -> dict[str, Any]:
    return {
        "run": one.subject.run,
        "metric": one.subject.metric,
        "phase": one.subject.phase,
        "verdict": one.outcome.value,
        "unit": one.guard.unit,
        "better": one.guard.direction,
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
        "power": None
        if power is None
        else {
            "loss": power.loss,
            "probability": power.probability,
            "seeds": power.seeds,
            "target": TARGET,
            "seeds_needed": power.seeds_needed,
            "detectable": power.detectable,
        },
    }


def _element_of(outcome: Outcome, *, unexplained: bool) -> str:
    if outcome in (Outcome.WORSE, Outcome.MISSING) or (unexplained and outcome in (Outcome.BETTER, Outcome.MOVED)):
        return "failure"
    return "skipped" if outcome is Outcome.INCONCLUSIVE else "system-out"


def _element_of_error(trouble: FailureCause) -> str:
    return "error" if trouble is FailureCause.NOT_RUN else "failure"


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
    """Text escaped for Markdown: marks and HTML are escaped, lines are joined."""
    plain = " ".join("".join(sign if sign.isprintable() else " " for sign in visible(text)).split())
    escaped = _MARKDOWN.sub(r"\\\1", plain)
    return escaped.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _xml(text: str) -> str:
    return _NOT_XML.sub("�", text)
