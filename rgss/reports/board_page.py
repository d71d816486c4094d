"""Board edition of a study's report: the choice on at most five printed pages."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rgss.reports.decision import tornado_svgs
from rgss.reports.page import render_page, template_text
from rgss.reports.study import comparison_rows, data_address, entry_at, entry_text, first_screen_content
from rgss.reports.study_page import TrialPictures, chosen_picture

if TYPE_CHECKING:
    from rgss.decision.sensitivity import Tornado

MOST_PAGES = 5
"""Most printed pages, A4 in landscape."""

_MOST_LINES = 5
_MOST_ROWS = 10
_MOST_COMPARED = 18
_MOST_MEASURES = 6
_MOST_FILMS = 2
_LONGEST = 160
_REASON_ROOM = 1300
"""Characters of reasons and cautions that half a page holds; where they have more, each line is cut."""


def board_to_html(
    document: Mapping[str, Any], *, pictures: Sequence[TrialPictures] = (), tornado: Tornado | None = None
) -> str:
    """Write the board edition as one page that makes no request; printed it has at most `MOST_PAGES` pages.

    Lists are cut to what a page holds and say so; the whole report has the rest.

    Args:
        document: The report's document, from `rgss.reports.study.document.report_document`.
        pictures: Pictures of the notable trials.
        tornado: The sensitivity of the choice, whose largest bars are drawn; None if it was not analysed.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    from markupsafe import Markup

    decision, glance = document["decision"], first_screen_content(document)
    if glance is not None:
        glance = {**glance, "changes": _cut(glance["changes"])}
    heads, rows = _best(document)
    ranked = sum(rank is not None for rank in document["variants"]["rank"])
    modelling = _assumptions(decision["modelling"]["rows"])
    compared = [[row["name"], *(cell["text"] for cell in row["cells"])] for row in comparison_rows(document)]
    failures = _failures(document["trials"], document["variants"]["id"])
    facts = [(name, _short(str(value))) for name, value in document["provenance"]["study"]]
    failed = sorted((one for one in pictures if one.failed), key=lambda one: not one.worst)
    repairs, excluded = _repairs(document["conflicts"]), _excluded(document["conflicts"])
    room = sum(map(len, (*decision["reasons"], *decision["cautions"])))
    longest = _REASON_ROOM if room <= _REASON_ROOM else _LONGEST
    return render_page(
        "study/board.html.j2",
        styles=[template_text(f"study/{name}") for name in ("report.css", "tool.css", "board.css")],
        images=True,
        title=f"Board edition: study {document['study']}",
        report=document,
        anchors={},
        glance=glance,
        glance_picture=chosen_picture(decision["chosen"], pictures),
        open=[] if glance is None else _cut(_open_lines(glance)),
        reasons=_cut(decision["reasons"], longest),
        cautions=_cut(decision["cautions"], longest),
        comparison=compared[:_MOST_COMPARED],
        comparison_more=_more(compared, _MOST_COMPARED, "rows"),
        compared_title="The choice" if decision["runner_up"] is None else "The choice beside the runner-up",
        compared_heads=[
            "",
            *(f"variant {one}" for one in (decision["chosen"], decision["runner_up"]) if one is not None),
        ],
        best_heads=heads,
        best=rows,
        left_out=" ".join(filter(None, (_ranked_in_words(ranked, len(rows)), *_columns_left(document)))),
        exchange=(document["sensitivity"] or {}).get("exchange"),
        tornado=Markup("" if tornado is None else tornado_svgs(tornado, most_bars=_MOST_ROWS)),  # noqa: S704 - own drawing
        tornado_more="" if tornado is None else _more(tornado.moving, _MOST_ROWS, "inputs of the tornado"),
        repairs=repairs[:_MOST_LINES],
        repairs_more=_more(repairs, _MOST_LINES, "repairs"),
        excluded=excluded[:_MOST_ROWS],
        excluded_more=_more(excluded, _MOST_ROWS, "requirements"),
        failures=failures[:_MOST_ROWS],
        failures_more=_more(failures, _MOST_ROWS, "kinds of failure"),
        pictures=[
            {**_texts_of(one), "filmstrip": data_address("image/png", one.filmstrip)} for one in failed[:_MOST_FILMS]
        ],
        pictures_more=_more(failed, _MOST_FILMS, "failures with pictures"),
        modelling=modelling[:_MOST_ROWS],
        modelling_more=_more(modelling, _MOST_ROWS, "assumptions"),
        modelling_heads=decision["modelling"]["heads"] if modelling else [],
        facts=facts[:_MOST_COMPARED],
        facts_more=_more(facts, _MOST_COMPARED, "facts"),
    )


def _texts_of(one: TrialPictures) -> dict[str, str]:
    return {"title": one.title, "note": _short(one.note), "replay": one.replay, "worst": one.worst}


def _open_lines(glance: Mapping[str, Any]) -> list[str]:
    missed = [f"{one['id']}: missed. {one['text']}" for one in glance["missed"]]
    return missed + [f"{one['id']}: {one['text']}" for one in glance["open"]]


def _cut(lines: Sequence[str], longest: int = _LONGEST) -> list[str]:
    """The lines that fit a page, each shortened to its width, and the number of the others."""
    # A single line more takes no more room than the words that there is one.
    fitting = len(lines) if len(lines) == _MOST_LINES + 1 else _MOST_LINES
    shown = [_short(line, longest) for line in lines[:fitting]]
    more = len(lines) - len(shown)
    return [*shown, f"and {more} more, in the whole report"] if more else shown


def _assumptions(rows: Sequence[Mapping[str, Any]]) -> list[list[str]]:
    """Rows of the table of assumptions, each with its name in words."""
    return [[_short(text) for text in (row["title"], *map(str, row["cells"][1:]))] for row in _by_effect(rows)]


def _by_effect(rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Assumptions that change the choice, then those that have no trials yet, then those that do not change it."""
    return sorted(rows, key=lambda row: (True, None, False).index(row["changes"]))


def _more(whole: Sequence[Any], shown: int, what: str) -> str:
    """Sentence on the number of omitted rows; empty if there are none."""
    left = len(whole) - shown
    return f"{left} more {what} in the whole report." if left > 0 else ""


def _short(text: str, longest: int = _LONGEST) -> str:
    return text if len(text) <= longest else f"{text[: longest - 1].rpartition(' ')[0] or text[: longest - 1]} …"


def _ranked_in_words(ranked: int, shown: int) -> str:
    if ranked == 0:
        return "No variant is ranked."
    if ranked == 1:
        return "One variant is ranked."
    shown_words = f"the first {shown}" if ranked > shown else "all"
    return f"{ranked} variants are ranked; {shown_words} are shown."


def _columns_left(document: Mapping[str, Any]) -> tuple[str, str]:
    """Sentences on the parameters and the weighted measures for which the table of the best has no room."""
    varying = [one for one in document["parameters"] if one["varies"]]
    weighted = [one for one in document["measures"] if one["weight"]]
    return (
        _more(varying, min(len(varying), _MOST_MEASURES), "parameters"),
        _more(weighted, min(len(weighted), _MOST_MEASURES), "weighted measures"),
    )


def _best(document: Mapping[str, Any]) -> tuple[list[str], list[list[str]]]:
    """The best variants with their weighted measures: heads and rows."""
    variants = document["variants"]
    weighted = sorted(
        (one for one in document["measures"] if one["weight"]), key=lambda one: (-one["weight"], one["id"])
    )[:_MOST_MEASURES]
    order = sorted(
        (place for place, rank in enumerate(variants["rank"]) if rank is not None),
        key=lambda place: variants["rank"][place],
    )
    varying = [one for one in document["parameters"] if one["varies"]][:_MOST_MEASURES]
    heads = ["variant", "rank", "value", *(one["name"] for one in varying), *(one["id"] for one in weighted)]
    rows = [
        [
            str(variants["id"][place]),
            str(variants["rank"][place]),
            entry_text(entry_at(variants["value"], place)),
            *(_figure(one["values"], place, one["unit"]) for one in varying),
            *(_figure(one["value"], place, one["unit"]) for one in weighted),
        ]
        for place in order[:_MOST_ROWS]
    ]
    return heads, rows


def _repairs(conflicts: Mapping[str, Any] | None) -> list[list[str]]:
    """Changes of limits, each of which makes a variant feasible: rows; none where a variant is feasible."""
    return [
        [
            " and ".join(one["requirements"]),
            "; ".join(f"{_short(change['demand'])} → {change['needed']}" for change in one["changes"]),
            "; ".join(change["relative"] or "–" for change in one["changes"]),
            "–" if one["winner"] is None else f"variant {one['winner']}",
            str(one["unlocked"]),
        ]
        for one in (conflicts["joint"] if conflicts else ())
        if one["changes"]
    ]


def _excluded(conflicts: Mapping[str, Any] | None) -> list[list[str]]:
    """Requirements with the number of variants that each excludes: rows; none where a variant is feasible."""
    excluding = conflicts["requirements"] if conflicts else ()
    return [[one["requirement"], _short(one["demand"]), str(one["excludes"])] for one in excluding]


def _figure(column: Any, place: int, unit: str) -> str:
    return entry_text(entry_at(column, place), unit)


def _failures(trials: Mapping[str, Any], ids: Sequence[int]) -> list[list[str]]:
    """Failures of trials, the most frequent first: failure, phase, number of trials, first trial."""

    def at(name: str, trial: int) -> Any:
        return entry_at(trials[name], trial)

    counted: Counter[tuple[int, int]] = Counter()
    first: dict[tuple[int, int], int] = {}
    for trial in range(len(trials["variant"])):
        failure = at("failure", trial)
        if failure >= 0:
            kind = (failure, at("failed_phase", trial))
            counted[kind] += 1
            first.setdefault(kind, trial)

    def phase(place: int) -> str:
        return trials["phases"][place] if 0 <= place < len(trials["phases"]) else "–"

    return [
        [
            trials["failures"][failure],
            phase(ended),
            str(count),
            f"variant {ids[at('variant', first[failure, ended])]}, seed {at('seed', first[failure, ended])}",
        ]
        for (failure, ended), count in sorted(counted.items(), key=lambda one: (-one[1], one[0]))
    ]
