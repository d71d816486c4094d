"""Page on a terminal: wrapped lines, fitted tables, coloured verdicts."""

from __future__ import annotations

import os
import re
import shutil
import sys
import textwrap
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO, cast

from rgss.cli.safe_output import SafeStream, own_stream
from rgss.cli.terminal.column_groups import GAP, column_groups, columns_with_room
from rgss.cli.terminal.pager import Pager
from rgss.cli.terminal.styles import STYLES, colour_system

if TYPE_CHECKING:
    from rgss.reports import TextTable

_NUMBER_AND_UNIT = re.compile(r"(?<=\d)()\s(?=(?:%|[a-zA-Z]{1,3}(?:/\w+)?\b)(?![a-z]))")
LEAST_WIDTH = 40
"""Least width in characters; a narrower terminal is treated as this wide."""


class TerminalPage(SafeStream):
    """Standard output that is a terminal."""

    def __init__(self, stream: TextIO, *, width: int) -> None:
        """Create a page.

        Args:
            stream: The stream of the terminal.
            width: Characters of a line.
        """
        super().__init__(stream)
        self._width = width
        self._begun = ""

    def write(self, text: str) -> int:
        """Write text; complete lines are wrapped between words."""
        *lines, self._begun = (self._begun + text).split("\n")
        for line in lines:
            self._write_line(line)
        return len(text)

    def isatty(self) -> bool:
        """True: a pager displays on a terminal too."""
        return True

    def flush(self) -> None:
        """Write an incomplete line, such as a prompt."""
        if self._begun:
            super().write(self._begun)
            self._begun = ""
        self.own.flush()

    def show_table(self, table: TextTable) -> None:
        """Write a table in parts that fit."""
        from rich.box import SIMPLE_HEAD
        from rich.table import Table
        from rich.text import Text

        from rgss.cli.terminal.console import PageConsole

        console = PageConsole(
            file=self.own, width=self._width, force_terminal=True, highlight=False, color_system=colour_system()
        )
        whole = (table.titles, *table.rows)
        kept = columns_with_room(whole, self._width, spare=table.spare)
        cells = [[row[column] for column in kept] for row in whole]
        parts = [(tuple(kept[place] for place in part), widths) for part, widths in column_groups(cells, self._width)]
        for place, (part, widths) in enumerate(parts):
            shown = Table(
                box=SIMPLE_HEAD, pad_edge=False, padding=(0, GAP - 1, 0, 0), show_edge=False, header_style="bold"
            )
            for column, width in zip(part, widths, strict=True):
                shown.add_column(
                    Text(table.titles[column]),
                    width=width,
                    justify="right" if column in table.right else "left",
                    overflow="fold",
                )
            for row in table.rows:
                shown.add_row(*(Text(row[column], style=STYLES.get(row[column], "")) for column in part))
            console.print(shown)
            if place < len(parts) - 1:
                console.print()
        omitted = [table.titles[column] for column in table.spare if column not in kept]
        if omitted:
            console.print(Text(f"(no room for: {', '.join(omitted)}; --wide has all columns)"))

    def _write_line(self, line: str) -> None:
        if len(line) <= self._width:
            super().write(f"{line}\n")
            return
        indent = line[: len(line) - len(line.lstrip())]
        broken = textwrap.wrap(
            _NUMBER_AND_UNIT.sub("\\1\u00a0", line),
            self._width,
            subsequent_indent=f"{indent}  ",
            break_long_words=False,
            break_on_hyphens=False,
            drop_whitespace=True,
        )
        super().write("\n".join(broken).replace("\u00a0", " ") + "\n")


@contextmanager
def fitted_page(
    *, is_wide: bool, is_paged: bool, environment: Mapping[str, str] = os.environ
) -> Iterator[TerminalPage | None]:
    """Fit the output of the block to the terminal; without effect where standard output is not a terminal.

    Args:
        is_wide: True if lines may be wider than the terminal.
        is_paged: True if a long page goes through a pager.
        environment: Variables of the process: ``PAGER``, ``RGSS_PAGER``.
    """
    before = sys.stdout
    if before is None or not before.isatty():
        yield None
        return
    width = shutil.get_terminal_size().columns
    pager = Pager.of(environment) if is_paged and sys.stdin is not None and sys.stdin.isatty() else None
    own = own_stream(before) if pager is None else pager.start()
    page = TerminalPage(own, width=10**6 if is_wide else max(width, LEAST_WIDTH))
    sys.stdout = cast("TextIO", page)
    try:
        yield page
        page.flush()
    finally:
        sys.stdout = before
        if pager is not None:
            pager.end()
