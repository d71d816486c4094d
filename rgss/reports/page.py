"""Self-contained HTML pages: escaping templates, inline styles and scripts, no network."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Sequence
from html import escape
from importlib import resources
from typing import Any

from rgss.errors import DefinitionError
from rgss.invisible_characters import visible

_WHOLE = re.compile(r"(?<![\w-])(?:--[a-z][a-z-]*|[A-Z][A-Z0-9]*(?:-[A-Z0-9]+)*-\d+[a-z]?(?![\w-]))")
"""Option of a command, or id of a requirement: at its hyphens a browser would break the line.

The page's script has the same expression (``WHOLE`` in ``study/core.js``).
"""

_BREAKS = re.compile(r"(?<=\w)(?:[_/]|\.(?=[^\W\d]))(?=\w)|[^\W_]{24}(?=[^\W_])")
"""End of a part of a long id; a part without an end of its own has one after 24 characters."""


def render_page(
    template: str,
    *,
    styles: Sequence[str] = (),
    scripts: Sequence[str] = (),
    held_scripts: Sequence[str] = (),
    images: bool = False,
    connects: bool = False,
    **context: Any,
) -> str:
    """Fill a template of this package.

    The context is escaped, except `markupsafe.Markup`. The content security policy allows only the
    page's own scripts, by their digests, and no request unless `connects` is set.

    Args:
        template: Path of the template below ``templates``, such as ``trace/trace.html.j2``.
        styles: More style sheets, after that of every page.
        scripts: More scripts, which run in their order after that of every page.
        held_scripts: Scripts that the page contains and that its other scripts run on demand.
        images: True if the page shows pictures, which it contains as data.
        connects: True if the page requests data from its own server; otherwise it makes no request.
        context: The variables of the template.

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
        loader=FunctionLoader(_text),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        # Markup is a str too, and its methods return Markup; invisible characters are escaped where it is made.
        finalize=lambda value: visible(value) if type(value) is str else value,
    )
    environment.filters["whole_options"] = lambda text: Markup(options_to_html(text))  # noqa: S704 - it is escaped
    environment.filters["breakable"] = lambda text: Markup(breakable_to_html(text))  # noqa: S704 - it is escaped
    own = [_text("page/page.js"), *([_text("page/diagram_pages.js")] if context.get("drawings") else []), *scripts]
    return environment.get_template(template).render(
        style=Markup(_text("page/page.css") + "".join(styles)),  # noqa: S704 - this package's own files
        scripts=[Markup(script) for script in own],  # noqa: S704 - this package's own files
        held_scripts=[Markup(script) for script in held_scripts],  # noqa: S704 - a package's own file
        script_hashes=[script_hash(script) for script in (*own, *held_scripts)],
        images=images,
        connects=connects,
        **context,
    )


def options_to_html(text: str) -> str:
    """A text as HTML in which no line breaks within an option or an id, such as ``--what-if`` or ``SYS-3``."""
    return _WHOLE.sub(r'<span class="option">\g<0></span>', escape(visible(text)))


def breakable_to_html(text: str) -> str:
    """A text as HTML whose long ids break at the ends of their parts; options and ids of requirements are whole."""
    parts = re.split(f"({_WHOLE.pattern})", visible(text))
    # Every second part is whole.
    return "".join(
        f'<span class="option">{escape(part)}</span>' if place % 2 else _BREAKS.sub(r"\g<0><wbr>", escape(part))
        for place, part in enumerate(parts)
    )


def script_hash(script: str) -> str:
    """Digest of a script in the notation of a content security policy."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode("utf-8")).digest()).decode("ascii")


def template_text(name: str) -> str:
    """The text of one of this package's templates, styles or scripts.

    Args:
        name: Its path below ``templates``, such as ``study/core.js``.
    """
    return _text(name)


def _text(name: str) -> str:
    return resources.files("rgss.reports").joinpath(f"templates/{name}").read_text(encoding="utf-8")
