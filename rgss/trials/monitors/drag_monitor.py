"""Monitor of an object that is let go of: the opening hand must not drag it along."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.evidence import Failure, Metric
from rgss.physics import Contacts, ContactWorld
from rgss.scenes import Pose
from rgss.trials.monitors.release_monitor import Violation
from rgss.trials.plants import ControlSettings


class DragMonitor:
    """Monitor of a release: the displacement of the object by the hand from the command to open on.

    A displacement counts while a finger has done more work on the object than it took since the two touched, and on
    until the object is still: what was dragged may slide on. A fall, a landing, and an object that strikes a finger
    or leans on it do not count. Displaced is the foot, the centre of the bottom face, horizontally: an object that
    leans stays on its foot as it lands and rights itself.
    What the object leans more counts with half of its height.
    """

    def __init__(self, world: ContactWorld, control: ControlSettings) -> None:
        """Begin when the hand still holds the object.

        Args:
            world: The world that is stepped.
            control: The speed below which the object is still.
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
        """Observe the world after a step; returns what goes wrong."""
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
        """The observations by name with unit."""
        return {"workpiece_displacement_m": self._moved_m}

    def _foot_m(self, pose: Pose) -> tuple[float, float, float]:
        return (pose @ Pose(position_m=(0.0, 0.0, -self._half_height_m))).position_m

    def _driving(self, before: Pose, now: Pose, forces_n: Sequence[float]) -> int | None:
        """The finger that has done most work on the object since they touched; None if no work is above zero."""
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
