"""3D replay of a trial: a glTF file, and a self-contained page that plays it."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.replay.packing import packed_replay
    from rgss.reports.replay.replay_page import (
        REPLAY_SCRIPTS,
        REPLAY_STYLE,
        PackedReplay,
        as_context,
        rendering_library,
        replay_to_html,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
