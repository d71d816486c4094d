"""Pictures of a stage: cameras, their framing, light and shadows."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.physics.pictures.camera import VIEWS, Camera, View
    from rgss.physics.pictures.rendering import Picture
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
