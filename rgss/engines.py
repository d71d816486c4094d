"""Simulation engines, an optional part of an installation (``pip install 'rgss[sim]'``)."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from types import MappingProxyType

from rgss.errors import DefinitionError

INSTALL = "pip install 'rgss[sim]'"
INSTALL_MUJOCO = "pip install 'rgss[mujoco]'"
INSTALL_XACRO = "pip install 'rgss[xacro]', or expand it: xacro FILE > arm.urdf"

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
        "fast_simplification": "fast-simplification",
        "pygltflib": "pygltflib",
        "av": "av",
    }
)
"""Distribution of each module of the extra ``sim``; pin includes coal."""

_PICTURES = ("PIL", "matplotlib", "fast_simplification", "pygltflib", "av")


def missing_engines(*, pictures: bool = False) -> tuple[str, ...]:
    """Distributions of the extra ``sim`` that are not installed, sorted.

    Args:
        pictures: True to include the packages for pictures of trials.
    """
    wanted = [module for module in DISTRIBUTIONS if pictures or module not in _PICTURES]
    return tuple(sorted({DISTRIBUTIONS[module] for module in wanted if not _is_installed(module)}))


def require_engines(purpose: str, *, pictures: bool = False) -> None:
    """Require that the simulation engines are installed.

    Args:
        purpose: Subject of the error message.
        pictures: True to include the packages for pictures of trials.

    Raises:
        DefinitionError: An engine is not installed.
    """
    missing = missing_engines(pictures=pictures)
    if missing:
        verb = "is" if len(missing) == 1 else "are"
        raise DefinitionError(
            f"{purpose} needs the simulation engines, of which {', '.join(missing)} {verb} not installed", hint=INSTALL
        )


def require_mujoco(purpose: str) -> None:
    """Require that the second physics engine is installed.

    Args:
        purpose: Subject of the error message.

    Raises:
        DefinitionError: MuJoCo is not installed.
    """
    _require("mujoco", "MuJoCo", purpose, INSTALL_MUJOCO)


def require_xacro(purpose: str) -> None:
    """Require that the package that expands xacros is installed.

    Args:
        purpose: Subject of the error message.

    Raises:
        DefinitionError: It is not installed.
    """
    _require("xacrodoc", "xacrodoc", purpose, INSTALL_XACRO)


def _require(module: str, name: str, purpose: str, hint: str) -> None:
    if not _is_installed(module):
        raise DefinitionError(f"{purpose} needs {name}, which is not installed", hint=hint)


def _is_installed(module: str) -> bool:
    try:
        return importlib.util.find_spec(module) is not None
    except (ImportError, ValueError):
        return False
