"""Replay of a trial in three dimensions: a glTF file, and a page that plays it without a network."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.replay.gltf_scene import replay_to_glb
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
