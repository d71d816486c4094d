"""Speed of the workpiece, which the product has no use for."""

from __future__ import annotations

import math


def workpiece_speed(world):
    """Linear (m/s) and angular (rad/s) speed of the workpiece of a world, as the engine has them."""
    linear, angular = world._engine.getBaseVelocity(world._workpiece, physicsClientId=world._client)
    return math.fsum(v * v for v in linear) ** 0.5, math.fsum(w * w for w in angular) ** 0.5
