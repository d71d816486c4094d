"""Monitors of a released object: its landing, and its displacement by the robot afterwards."""

from __future__ import annotations

import math
from collections import deque

from rgss.evidence import Failure, Metric
from rgss.grasping import configuration_distance_m
from rgss.physics import Contacts, ContactWorld
from rgss.scenes import ObjectShape, Pose, least_height_m
from rgss.trials.monitors.force_sensor import ForceSensor

Violation = tuple[Failure, str]

_LEAST_STEPS = 3
"""Steps of the shortest window: contact stops a fall within two steps."""


class LandingMonitor:
    """Monitor of the landing: drop height of the object, its speed before the impact, and its velocity change.

    The speed that the support takes from the object is the downward speed of its centre of mass at the start of a
    window less that at the end, if it still falls. As the step dt shrinks it converges to the speed of the fall,
    sqrt(2 g h); it is within 1.5 g dt of it, since an object falls freely up to the step in which it enters the
    support. The velocity change, the impulse of the support over a window, minus that of the weight, divided by
    the mass, contains the speed of the rebound too, which depends on the step.
    """

    def __init__(self, world: ContactWorld) -> None:
        """Start while the hand still holds the object."""
        scene = world.scene
        self._world = world
        self._place = scene.place
        self._support = scene.place_support
        workpiece = scene.workpiece
        self._limit_m_s = workpiece.landing_limit_m_s
        self._weight_n = workpiece.mass_kg * scene.gravity_m_s2
        # A window shorter than a step is one step.
        self._over_mass_s_kg = max(workpiece.force_window_s, world.settings.step_s) / workpiece.mass_kg
        self._sensor = ForceSensor(workpiece.force_window_s, world.settings.rate_hz)
        self._height_m = lowest_point_m(world.workpiece_pose(), scene.workpiece.shape) - scene.place.centre_m[2]
        x, y = workpiece.centre_of_mass_across_m
        self._centre = Pose(position_m=(x, y, workpiece.centre_of_mass_m))
        self._centre_height_m = self._centre_now_m()
        steps = max(_LEAST_STEPS, math.ceil(workpiece.force_window_s * world.settings.rate_hz - 1e-9))
        self._falling_m_s: deque[float] = deque(maxlen=1 + steps)

    @property
    def velocity_change_m_s(self) -> float:
        """Greatest velocity change by the support so far."""
        return max(0.0, self._sensor.peak_n - self._weight_n) * self._over_mass_s_kg

    def after_step(self) -> Violation | None:
        """Observe the world after a step; returns a violation, if any."""
        self._sensor.note((self._world.support_force_n(),))
        before_m, self._centre_height_m = self._centre_height_m, self._centre_now_m()
        now_m_s = (before_m - self._centre_height_m) / self._world.settings.step_s
        self._falling_m_s.append(now_m_s)
        speed_m_s = max(self._falling_m_s)
        # Before the first contact, only the hand can slow the object.
        if speed_m_s - max(0.0, now_m_s) <= self._limit_m_s or self._sensor.peak_n == 0.0:
            return None
        return Failure.OBJECT_DAMAGED, (
            f"the object landed with {speed_m_s:.2f} m/s after a drop of {self._height_m * 1e3:.1f} mm, "
            f"above its limit of {self._limit_m_s:g} m/s"
        )

    def after_opening(self) -> Violation | None:
        """Check the height of the release; returns a violation, if any."""
        if self._height_m <= self._place.largest_drop_m:
            return None
        return Failure.OBJECT_DROPPED, (
            f"the object was released {self._height_m * 1e3:.1f} mm above {self._support}, "
            f"at most {self._place.largest_drop_m * 1e3:g} mm"
        )

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        return {
            "release_height_m": self._height_m,
            "landing_force_n": self._sensor.peak_n,
            "landing_speed_m_s": self.velocity_change_m_s,
        }

    def _centre_now_m(self) -> float:
        return (self._world.workpiece_pose() @ self._centre).position_m[2]


class PlacedObjectMonitor:
    """Monitor of a placed object while the hand leaves it; the robot must not move it again.

    A displacement counts from the first contact to the end: a pushed object may roll on or fall over.
    """

    def __init__(self, world: ContactWorld) -> None:
        """Start when the object is at rest and the hand is open."""
        self._world = world
        self._largest_m = world.scene.place.largest_drag_m
        self._half_height_m = world.scene.workpiece.shape.half_height_m
        self._stood_at = world.workpiece_pose()
        self._force_n = 0.0
        self._finger: int | None = None
        self._moved_m = 0.0

    def after_step(self, contacts: Contacts) -> Violation | None:
        """Observe the world after a step; returns a violation, if any."""
        force_n = max(contacts.finger_forces_n)
        if force_n > self._force_n:
            self._force_n, self._finger = force_n, contacts.finger_forces_n.index(force_n)
        return None if self._finger is None else self.finish()

    def finish(self) -> Violation | None:
        """Final observation of the object; returns a violation, if any."""
        if self._finger is None:
            return None
        stands_at = self._world.workpiece_pose()
        self._moved_m = max(self._moved_m, configuration_distance_m(self._stood_at, stands_at, self._half_height_m))
        if self._moved_m <= self._largest_m:
            return None
        return Failure.OBJECT_COLLISION, (
            f"finger_{self._finger} moved the placed object by {self._moved_m * 1e3:.1f} mm "
            f"with {self._force_n:.2f} N, at most {self._largest_m * 1e3:g} mm"
        )

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        return {"workpiece_displacement_m": self._moved_m, "touch_force_n": self._force_n}


def lowest_point_m(pose: Pose, shape: ObjectShape) -> float:
    """Height in m of the lowest point of a solid in the world.

    Args:
        pose: Transform of its frame to the world.
        shape: The solid.
    """
    return pose.position_m[2] + least_height_m(shape, pose.inverse_rotate((0.0, 0.0, 1.0)))
