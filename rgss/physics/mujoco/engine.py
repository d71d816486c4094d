"""Lazy import of MuJoCo and compilation of models; no other module imports it."""

from __future__ import annotations

import importlib.metadata
from functools import lru_cache
from typing import Any

from rgss.errors import SimulationError


@lru_cache(maxsize=1)
def mujoco() -> Any:
    """The engine's module, imported on first use so that start-up stays light."""
    import mujoco as module

    # By default a warning is appended to a file MUJOCO_LOG.TXT in the current folder; worlds read the warning counters.
    module.set_mju_user_warning(_ignore)
    return module


def engine_version() -> str:
    """Installed release of the engine."""
    return importlib.metadata.version("mujoco")


def compiled(description: str) -> Any:
    """Compiled model of an MJCF description.

    Raises:
        SimulationError: The engine rejected it.
    """
    try:
        return mujoco().MjModel.from_xml_string(description)
    except ValueError as error:
        raise SimulationError(
            f"the physics engine rejected the world: {' '.join(str(error).split())}", hint="check the scene"
        ) from error


def _ignore(_: str) -> None:
    """Discard a warning; worlds read the warning counters."""
