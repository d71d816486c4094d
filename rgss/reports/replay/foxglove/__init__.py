"""Replay of a trial as an MCAP file for Foxglove."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.replay.foxglove.mcap_file import replay_to_mcap
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
