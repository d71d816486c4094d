"""Contact worlds in a second engine, MuJoCo."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.physics.mujoco.engine import engine_version
    from rgss.physics.mujoco.settings import MujocoSettings
    from rgss.physics.mujoco.world import MujocoWorld
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
