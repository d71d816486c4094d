"""Reference tables of the frames' columns in Markdown, and their insertion into docs/api.md."""

from __future__ import annotations

import re

from rgss.api.columns import FRAMES
from rgss.errors import DefinitionError

_MARKED = re.compile(r"<!-- columns of (\w+) -->\n(?:.*?\n)??<!-- end of columns -->\n", re.DOTALL)


def reference_table(name: str) -> str:
    """The columns of a frame as a table in Markdown.

    Args:
        name: The frame's name.

    Raises:
        DefinitionError: There is no such frame.
    """
    if name not in FRAMES:
        raise DefinitionError(f"unknown frame {name!r}", hint=f"frames: {', '.join(FRAMES)}")
    frame = FRAMES[name]
    lines = [f"One row: {frame.row}.", "", "| column | unit | meaning |", "|---|---|---|"]
    lines += [f"| `{one.title}` (index) | {one.unit or '–'} | {one.meaning} |" for one in frame.index]
    lines += [f"| `{one.title}` | {one.unit or '–'} | {one.meaning} |" for one in frame.columns]
    return "\n".join(lines) + "\n"


def with_reference_tables(page: str) -> str:
    """A page with the present table of each frame between its two markers.

    Args:
        page: The text of the page, with ``<!-- columns of trials -->`` and ``<!-- end of columns -->``.
    """
    return _MARKED.sub(
        lambda mark: f"<!-- columns of {mark[1]} -->\n{reference_table(mark[1])}<!-- end of columns -->\n",
        page,
    )
