"""3D replay of a trial: a glTF file, a self-contained page that plays it, and files for other viewers."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.replay.formats import PAGE_SUFFIX, REPLAY_SUFFIXES, require_viewer_package
    from rgss.reports.replay.packing import packed_replay
    from rgss.reports.replay.replay_page import (
        REPLAY_SCRIPTS,
        REPLAY_STYLE,
        PackedReplay,
        as_context,
        rendering_library,
        replay_to_html,
    )
    from rgss.reports.replay.viewer_file import replay_to_viewer_file
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
