"""Named frames of scenes and robots: poses to which steps of a task may move."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.frames.document import FrameEntry
    from rgss.scenes.frames.named_frame import NamedFrame
    from rgss.scenes.frames.reading import ROBOT, WORLD, frames_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
