"""HTML page of a study whose sweep is running."""

from __future__ import annotations

from rgss.reports.page import render_page, template_text


def live_page_to_html(study: str) -> str:
    """HTML page that polls its server for the state of a study, and shows it.

    Args:
        study: The study's id.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    return render_page(
        "live/live.html.j2",
        styles=[template_text("live/live.css")],
        scripts=[template_text("live/live.js")],
        connects=True,
        title=f"Study {study}",
    )
