"""The simulation engines, an optional part of an installation (``pip install 'rgss[sim]'``)."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from types import MappingProxyType

from rgss.errors import DefinitionError

INSTALL = "pip install 'rgss[sim]'"
INSTALL_MUJOCO = "pip install 'rgss[mujoco]'"

DISTRIBUTIONS: Mapping[str, str] = MappingProxyType(
    {
        "ompl": "ompl",
        "pybullet": "pybullet",
        "pinocchio": "pin",
        "coal": "pin",
        "eaik": "eaik",
        "toppra": "toppra",
        "PIL": "pillow",
        "matplotlib": "matplotlib",
        "pygltflib": "pygltflib",
        "av": "av",
    }
)
"""The distribution that brings each module of the extra ``sim``; pin brings coal."""

_PICTURES = ("PIL", "matplotlib", "pygltflib", "av")


def missing_engines(*, pictures: bool = False) -> tuple[str, ...]:
    """Distributions of the extra ``sim`` that are not installed, sorted.

    Args:
        pictures: Include what draws pictures of trials.
    """
    wanted = [module for module in DISTRIBUTIONS if pictures or module not in _PICTURES]
    return tuple(sorted({DISTRIBUTIONS[module] for module in wanted if not _is_installed(module)}))


def require_engines(purpose: str, *, pictures: bool = False) -> None:
    """Make sure that the simulation engines are installed.

    Args:
        purpose: What needs them, the first words of the message.
        pictures: Include what draws pictures of trials.

    Raises:
        DefinitionError: One is not installed.
    """
    missing = missing_engines(pictures=pictures)
    if missing:
        verb = "is" if len(missing) == 1 else "are"
        raise DefinitionError(
            f"{purpose} needs the simulation engines, of which {', '.join(missing)} {verb} not installed", hint=INSTALL
        )


def require_mujoco(purpose: str) -> None:
    """Make sure that the second physics engine is installed.

    Args:
        purpose: What needs it, the first words of the message.

    Raises:
        DefinitionError: It is not installed.
    """
    if not _is_installed("mujoco"):
        raise DefinitionError(f"{purpose} needs MuJoCo, which is not installed", hint=INSTALL_MUJOCO)


def _is_installed(module: str) -> bool:
    try:
        return importlib.util.find_spec(module) is not None
    except (ImportError, ValueError):
        return False
