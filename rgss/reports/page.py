"""Self-contained HTML pages: templates that escape everything, own style, own script, no network."""

from __future__ import annotations

import base64
import hashlib
from importlib import resources
from typing import Any

from rgss.errors import DefinitionError


def render_page(template: str, **context: Any) -> str:
    """Fill a template of this package.

    Whatever the context holds is escaped, except `markupsafe.Markup`. The page allows no script
    but its own, by its digest, and no request at all.

    Args:
        template: Name of the template.
        context: What it shows.

    Raises:
        DefinitionError: The package ``jinja2`` is not installed.
    """
    try:
        from jinja2 import Environment, FunctionLoader, StrictUndefined
        from markupsafe import Markup
    except ImportError as error:
        raise DefinitionError(
            "an HTML page needs the package jinja2, which is not installed", hint="pip install jinja2"
        ) from error
    environment = Environment(
        loader=FunctionLoader(_text), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    script = _text("page.js")
    return environment.get_template(template).render(
        style=Markup(_text("page.css")),  # noqa: S704 - this package's own file
        script=Markup(script),  # noqa: S704 - this package's own file
        script_hash=script_hash(script),
        **context,
    )


def script_hash(script: str) -> str:
    """A script's digest as a content security policy names it."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode("utf-8")).digest()).decode("ascii")


def _text(name: str) -> str:
    return resources.files("rgss.reports").joinpath(f"templates/{name}").read_text(encoding="utf-8")
