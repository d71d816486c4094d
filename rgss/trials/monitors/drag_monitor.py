"""Monitor of a release: the opening hand must not drag the object."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.evidence import Failure, Metric
from rgss.physics import Contacts, ContactWorld
from rgss.scenes import Pose
from rgss.trials.monitors.release_monitor import Violation
from rgss.trials.plants import ControlSettings


class DragMonitor:
    """Monitor of the displacement of the object by the hand, from the command to open on.

    A displacement counts while the net work of a finger on the object since contact is positive, and until the object
    is at rest, since a dragged object may slide on. A fall, a landing, and an object that strikes a finger or leans on
    it do not count. The displacement is horizontal, of the centre of the bottom face: a tilted object lands on its edge
    and rights itself without displacing it. An increase of the tilt counts with half of the object's height.
    """

    def __init__(self, world: ContactWorld, control: ControlSettings) -> None:
        """Start while the hand still holds the object.

        Args:
            world: The world.
            control: Speed below which the object is at rest.
        """
        self._world = world
        self._largest_m = world.scene.place.largest_drag_m
        self._work_j = [0.0] * max(1, world.gripper.geometry.fingers)
        self._half_height_m = world.scene.workpiece.shape.half_height_m
        self._still_m = control.settled_speed_m_s * world.settings.step_s
        self._pose = world.workpiece_pose()
        self._x_m = self._y_m = self._leant_rad = 0.0
        self._is_counting = False
        self._finger, self._force_n = 0, 0.0
        self._moved_m = 0.0

    def after_step(self, contacts: Contacts) -> Violation | None:
        """Observe the world after a step; returns a violation, if any."""
        before, now = self._pose, self._world.workpiece_pose()
        self._pose = now
        was, foot_m = self._foot_m(before), self._foot_m(now)
        x_m, y_m = foot_m[0] - was[0], foot_m[1] - was[1]
        driving = self._driving(before, now, contacts.finger_forces_n)
        if driving is not None:
            self._is_counting = True
            self._finger, self._force_n = driving, contacts.finger_forces_n[driving]
        elif math.hypot(x_m, y_m) <= self._still_m:
            self._is_counting = False
        if not self._is_counting:
            return None
        self._x_m += x_m
        self._y_m += y_m
        self._leant_rad += now.tilt_rad - before.tilt_rad
        moved_m = math.hypot(self._x_m, self._y_m, self._half_height_m * max(0.0, self._leant_rad))
        self._moved_m = max(self._moved_m, moved_m)
        if moved_m <= self._largest_m:
            return None
        return Failure.OBJECT_COLLISION, (
            f"finger_{self._finger} dragged the released object by {moved_m * 1e3:.1f} mm "
            f"with {self._force_n:.2f} N, at most {self._largest_m * 1e3:g} mm"
        )

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        return {"workpiece_displacement_m": self._moved_m}

    def _foot_m(self, pose: Pose) -> tuple[float, float, float]:
        return (pose @ Pose(position_m=(0.0, 0.0, -self._half_height_m))).position_m

    def _driving(self, before: Pose, now: Pose, forces_n: Sequence[float]) -> int | None:
        """Finger with the greatest net work on the object since contact; None if no work is positive."""
        work_j = self._work_j
        for finger, force_n in enumerate(forces_n):
            if force_n <= 0.0:
                work_j[finger] = 0.0
        if max(forces_n) <= 0.0:
            return None
        motion = before.inverse() @ now
        for contact in self._world.finger_contacts():
            moved = (motion @ Pose(position_m=contact.position_m)).position_m
            for axis in range(3):
                force_n = contact.normal_force_n * contact.normal[axis] + contact.friction_n[axis]
                work_j[contact.finger] += force_n * (moved[axis] - contact.position_m[axis])
        most_j = max(work_j)
        return work_j.index(most_j) if most_j > 0.0 else None
