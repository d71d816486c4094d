"""Small HTML tables for views in Jupyter."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def html_view(title: str, body: str) -> str:
    """A heading, given as text, above a body of HTML."""
    return f"<div><p><strong>{escape(title)}</strong></p>{body}</div>"


def html_table(heads: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table of texts.

    Args:
        heads: Heads of the columns; none if empty.
        rows: Cells of each row.
    """
    head = "".join(f"<th>{escape(one)}</th>" for one in heads)
    body = "".join(f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{f'<thead><tr>{head}</tr></thead>' if heads else ''}<tbody>{body}</tbody></table>"
