"""A study's report as one self-contained HTML page with linked plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

from rgss.errors import DefinitionError
from rgss.reports.page import render_page, template_text
from rgss.reports.replay import REPLAY_SCRIPTS, REPLAY_STYLE, PackedReplay, as_context, rendering_library
from rgss.reports.study import (
    compared_trials,
    comparison_rows,
    data_address,
    embedded_json,
    first_screen_content,
    packed_json,
    parted,
    worst_failure_in_words,
)
from rgss.reports.trace import TraceReport, trace_context
from rgss.trace.views import share_in_words, value_in_words

SCRIPTS = (
    "study/core.js",
    "study/address.js",
    "study/filters.js",
    "study/tables.js",
    "study/downloads.js",
    "study/parallel.js",
    "study/verdicts.js",
    "study/weights.js",
    "study/evidence.js",
    "study/find.js",
    "study/marks.js",
    "study/plots.js",
    "study/compare.js",
    "study/trials.js",
    "study/start.js",
)
"""Parts of the page's script, in order; together they form one function of the document."""

LARGEST_PLAIN = 2_000_000
"""Length in characters above which the document is compressed."""

_SECTIONS = (
    ("glance", "At a glance"),
    ("decision", "Decision"),
    ("explore", "All variants"),
    ("verdicts", "Verdicts"),
    ("measures", "Measures"),
    ("pareto", "Pareto front"),
    ("distributions", "Distributions"),
    ("compare", "Compare variants"),
    ("sensitivity", "Sensitivity"),
    ("weights", "Weights"),
    ("acceptability", "Acceptability"),
    ("effects", "Main effects"),
    ("planning", "Planning times"),
    ("trials", "Trials and failures"),
    ("evidence", "Evidence of a variant"),
    ("pictures", "Pictures"),
    ("traceability", "Traceability"),
    ("provenance", "Provenance"),
)

_SCRIPTED = (
    "explore",
    "verdicts",
    "measures",
    "pareto",
    "distributions",
    "compare",
    "weights",
    "acceptability",
    "effects",
    "trials",
    "evidence",
)
"""Sections that a script fills; without scripts the page leaves them out, and says so."""

_COMPARING = ("explore", "pareto", "distributions", "compare", "acceptability", "effects")
"""Sections that compare variants; the report of a study with one variant hides them."""

_RANKING = ("weights", "acceptability")
"""Sections that rank feasible variants; the report hides them where no variant is feasible."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrialPictures:
    """Pictures of one trial.

    Attributes:
        title: The trial, and why it is notable.
        note: Its outcome.
        replay: The command that runs it again.
        filmstrip: A PNG of the ends of its states; empty if nothing moved.
        film: A WebM video; empty if nothing moved.
        player: Its replay in three dimensions; None if nothing moved.
        variant: Id of its variant; None if it is irrelevant.
        still: A PNG of the carried object; empty without one.
        failed: True if the trial failed.
        worst: A sentence on why it is the worst failure; empty for other trials.
    """

    title: str
    note: str
    replay: str
    filmstrip: bytes
    film: bytes
    player: PackedReplay | None = None
    variant: int | None = None
    still: bytes = b""
    failed: bool = False
    worst: str = ""


def study_report_to_html(
    document: Mapping[str, Any],
    trace: TraceReport,
    *,
    drawings: Sequence[Mapping[str, Any]] = (),
    drawings_notice: str = "",
    pictures: Sequence[TrialPictures] = (),
    pictures_notice: str = "",
    tornado: str = "",
) -> str:
    """Write a study's report as one page, which makes no request and runs only its own scripts.

    The same arguments give the same bytes.

    Args:
        document: The report's document, from `rgss.reports.study.document.report_document`.
        trace: The traceability of the same project.
        drawings: Its diagrams, from `rgss.reports.diagrams.diagrams.drawings_for_page`.
        drawings_notice: A note on the diagrams; may be empty.
        pictures: Pictures of the notable trials.
        pictures_notice: A note on the pictures, such as why there are none.
        tornado: The picture of the sensitivity, from `rgss.reports.decision.tornado_svgs`.

    Raises:
        DefinitionError: The package ``jinja2`` or ``plotly`` is not installed.
    """
    script = (
        '"use strict";\nconst rgssReport = (data, later) => {\n' + "\n".join(map(template_text, SCRIPTS)) + "\n};\n"
    )
    glance, plain = first_screen_content(document), embedded_json(document)
    hidden = _hidden_sections(document)
    packed = len(plain) > LARGEST_PLAIN
    first, later = parted(document) if packed else (document, {})
    has_replays = any(one.player is not None for one in pictures)
    return render_page(
        "study/report.html.j2",
        styles=[
            template_text("study/report.css"),
            template_text("study/tool.css"),
            *([template_text(REPLAY_STYLE)] if has_replays else []),
        ],
        scripts=[
            find_and_sort_library(),
            script + template_text("study/data.js"),
            *(map(template_text, REPLAY_SCRIPTS) if has_replays else ()),
        ],
        # Parsing it takes a browser longer than all the rest, and it is not needed before a plot is visible.
        held_scripts=[plotting_library(), *([rendering_library()] if has_replays else [])],
        images=True,
        title=f"Report of the study {document['study']}",
        report=document,
        glance=glance,
        worst=worst_failure_in_words(document),
        glance_picture=chosen_picture(document["decision"]["chosen"], pictures),
        comparison=comparison_rows(document),
        compared_trials=compared_trials(document),
        report_sections=[
            (name, section) for name, section in _SECTIONS if name not in hidden and (name != "glance" or glance)
        ],
        hidden=hidden,
        scripted=_SCRIPTED,
        pictures=[_picture(one) for one in pictures],
        worst_failure=next((place for place, one in enumerate(pictures) if one.worst), None),
        pictures_notice=pictures_notice,
        tornado=_markup(tornado),
        data=_markup(packed_json(embedded_json(first)) if packed else plain),
        later=_markup(packed_json(embedded_json(later))),
        packed=packed,
        refused=_refused(document["decision"]["refused"]),
        words=value_in_words,
        share=share_in_words,
        **trace_context(trace, drawings=drawings, drawings_notice=drawings_notice),
    )


def _hidden_sections(document: Mapping[str, Any]) -> set[str]:
    """Sections that have no use in a study of one variant, or of none that is feasible."""
    variants, ranks = document["variants"], document["decision"]["acceptability"] is not None
    compares = len(variants["id"]) > 1
    return {*(() if compares else _COMPARING), *(() if ranks or any(variants["feasible"]) else _RANKING)}


def plotting_library() -> str:
    """The script of Plotly, from its Python package.

    Raises:
        DefinitionError: The package is not installed.
    """
    try:
        from plotly.offline import get_plotlyjs
    except ImportError as error:
        raise DefinitionError(
            "a report needs the package plotly, which is not installed", hint="pip install plotly"
        ) from (error)
    # Nothing in a script element may look like its end tag, not even a string.
    return str(get_plotlyjs()).replace("</script", "<\\/script").replace("<!--", "<\\!--")


def find_and_sort_library() -> str:
    """Script of MiniSearch and fast-sort; their licences are beside it in this package."""
    place = resources.files("rgss.reports").joinpath("bundles/find_and_sort/find_and_sort.min.js")
    return place.read_text(encoding="utf-8")


def _refused(reasons: Mapping[str, str]) -> dict[str, list[str]]:
    """Names of the analyses that do not apply, grouped by reason."""
    names: dict[str, list[str]] = {}
    for name, reason in reasons.items():
        names.setdefault(reason, []).append(name)
    return names


def chosen_picture(chosen: int | None, pictures: Sequence[TrialPictures]) -> str:
    """Data URL of the first picture of the chosen variant; empty without one."""
    return next((data_address("image/png", one.still) for one in pictures if one.variant == chosen), "")


def _picture(one: TrialPictures) -> dict[str, Any]:
    return {
        "title": one.title,
        "note": one.note,
        "replay": one.replay,
        "worst": one.worst,
        "filmstrip": data_address("image/png", one.filmstrip),
        "film": data_address("video/webm", one.film),
        "replays": [] if one.player is None else [as_context(one.player)],
    }


def _markup(text: str) -> Any:
    from markupsafe import Markup

    return Markup(text)  # noqa: S704 - nothing in it can end the element that it stands in
