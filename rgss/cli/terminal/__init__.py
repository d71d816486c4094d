"""Output on a terminal: fitted pages, colours, a pager."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.cli.terminal.page import TerminalPage, fitted_page
    from rgss.cli.terminal.remaining_time import ESTIMATING, RemainingTime, left_in_words
    from rgss.cli.terminal.stages import stage_progress
    from rgss.cli.terminal.styles import colour_system
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
