"""Visual meshes: how a robot looks in pictures, which nothing that is simulated depends on."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.looks.visual_meshes import DrawnMesh, drawn_mesh, looks_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
