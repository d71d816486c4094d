"""A confirmation as lines for a terminal and as Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from rgss.confirmation import Confirmation
from rgss.counted import counted
from rgss.findings import printable
from rgss.reports.confirmation.sentences import summary_sentences
from rgss.reports.confirmation.tables import confirmation_tables
from rgss.reports.plain_text import aligned_table
from rgss.reports.tables import cell_text

_MARKDOWN = re.compile(r"([\\`*_{}\[\]()#+!|~$@<>-])")


def confirmation_lines(confirmation: Confirmation) -> Iterator[str]:
    """The sentences, and the tables below them."""
    for sentence in summary_sentences(confirmation):
        yield printable(sentence)
    for table in confirmation_tables(confirmation):
        yield ""
        yield f"{table.title}:"
        yield from aligned_table(table.heads, ([cell_text(cell) for cell in row] for row in table.rows))
    yield ""
    yield printable(_origin(confirmation))


def confirmation_to_markdown(confirmation: Confirmation) -> str:
    """The same as a page in Markdown."""
    lines = [f"# Confirmation of {_escaped(confirmation.study)}", ""]
    for sentence in summary_sentences(confirmation):
        lines += [_escaped(sentence), ""]
    for table in confirmation_tables(confirmation):
        lines += [f"## {_escaped(table.title)}", "", _row(table.heads), "|---" * len(table.heads) + "|"]
        lines += [_row([cell_text(cell) for cell in row]) for row in table.rows]
        lines.append("")
    return "\n".join([*lines, _escaped(_origin(confirmation)), ""])


def _origin(confirmation: Confirmation) -> str:
    settings = len(confirmation.results)
    total = len(confirmation.trials) * settings
    return (
        f"{counted(len(confirmation.trials), 'trial')} under {settings} settings: {confirmation.made} run, "
        f"{total - confirmation.made} from evidence. Evidence: {confirmation.evidence}"
    )


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(map(_escaped, cells))} |"


def _escaped(text: str) -> str:
    return _MARKDOWN.sub(r"\\\1", printable(text))
