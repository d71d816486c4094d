"""Physics settings of contact trials in MuJoCo instead of PyBullet."""

from __future__ import annotations

from rgss.engines import require_mujoco
from rgss.physics.mujoco import MujocoSettings, engine_version
from rgss.trials.code import source_digest

_ADAPTER = "rgss.physics.mujoco.settings"


def mujoco_settings(*, rate_hz: float | None = None) -> MujocoSettings:
    """Settings of a trial in the installed MuJoCo, with its release and the digest of its adapter.

    Args:
        rate_hz: Steps a second; that of `MujocoSettings` by default.

    Raises:
        DefinitionError: MuJoCo is not installed.
    """
    require_mujoco("a trial in MuJoCo")
    version, code = engine_version(), source_digest(_ADAPTER)
    if rate_hz is None:
        return MujocoSettings(version=version, code=code)
    return MujocoSettings(version=version, code=code, rate_hz=rate_hz)
