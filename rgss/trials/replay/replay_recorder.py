"""Recorder of a trial for its replay: postures of arm and fingers, object poses, and finger forces."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rgss.physics import Contacts, ContactWorld, FingerContact
from rgss.scenes import Pose
from rgss.trials.replay.replay_scene import Touch
from rgss.trials.replay.touch_log import TouchLog

Row = tuple[float, ...]
_NO_CONTACT: Row = (math.nan,) * 6


class ReplayRecorder:
    """Observer that samples the world at a fixed rate, without side effects.

    Attributes:
        pressing: Number of forces on the object: one for each finger, or that of a suction cup.
    """

    def __init__(self, objects: tuple[str, ...], *, fingers: int, step_s: float, rate_hz: float) -> None:
        """Start without samples.

        Args:
            objects: Ids of the scene's objects, the first one first.
            fingers: Number of fingers; 0 for a suction cup.
            step_s: Length of a physics step.
            rate_hz: Samples a second, at most one for each step.
        """
        self._objects = objects
        self.pressing = max(1, fingers)
        self._has_fingers = fingers > 0
        self._step_s = step_s
        self._stride = max(1, round(1.0 / (rate_hz * step_s)))
        self._steps = 0
        self._times_s: list[float] = []
        self._joints_rad: list[Row] = []
        self._travel_m: list[Row] = []
        self._poses: list[tuple[Pose, ...]] = []
        self._contacts: list[tuple[Row, ...]] = []
        self._touches = TouchLog()

    def after_step(
        self,
        world: ContactWorld,
        phase: str,
        contacts: Contacts,
        grip_margin: float | None,
        commanded_force_n: float | None,
    ) -> None:
        """Take a sample, if due."""
        del phase, grip_margin, commanded_force_n
        due = self._steps % self._stride == 0
        self._steps += 1
        if struck := contacts.robot_contacts:
            self._touches.add(self._steps * self._step_s, struck, workpiece=world.scene.workpiece.id)
        if not due:
            return
        self._times_s.append(self._steps * self._step_s)
        self._joints_rad.append(world.arm_state()[0])
        self._travel_m.append(world.finger_travel_m())
        self._poses.append(tuple(self._pose(world, name) for name in self._objects))
        if not self._has_fingers:
            point_m, force_n = world.seal_pull() or (_NO_CONTACT[:3], _NO_CONTACT[3:])
            self._contacts.append(((*point_m, *force_n),))
            return
        pressed = world.finger_contacts() if contacts.fingers_touching else ()
        pose = world.workpiece_pose()
        self._contacts.append(tuple(_resultant(pressed, finger, pose) for finger in range(self.pressing)))

    def count_until(self, end_s: float) -> int:
        """Number of samples up to a time."""
        return int(np.searchsorted(np.array(self._times_s), end_s + 1e-9, side="right"))

    def times_s(self, count: int) -> NDArray[np.float64]:
        """Times of the first samples, shape (count,)."""
        return np.array(self._times_s[:count])

    def joints_rad(self, count: int) -> NDArray[np.float64]:
        """Reported joint positions of the first samples, shape (count, joints)."""
        return np.array(self._joints_rad[:count])

    def travel_m(self, count: int) -> NDArray[np.float64]:
        """Travel of each finger in the first samples, shape (count, fingers)."""
        return np.array(self._travel_m[:count]).reshape(count, -1)

    def poses_of(self, name: str, count: int) -> list[Pose]:
        """Poses of an object in the first samples."""
        place = self._objects.index(name)
        return [poses[place] for poses in self._poses[:count]]

    def contacts_of(self, finger: int, count: int) -> NDArray[np.float64]:
        """Centre of contact (m) and force (N) of a finger or the cup in the first samples, in the world.

        Args:
            finger: Its number, from 0; 0 for the cup.
            count: Number of samples.

        Returns:
            Rows of shape (count, 6).
        """
        return np.array([rows[finger] for rows in self._contacts[:count]]).reshape(count, 6)

    def touches(self, end_s: float) -> tuple[Touch, ...]:
        """Contacts of the robot that are no grip and began up to a time."""
        return self._touches.touches(end_s)

    def _pose(self, world: ContactWorld, name: str) -> Pose:
        return world.workpiece_pose() if len(self._objects) == 1 else world.object_pose(name)


def _resultant(pressed: tuple[FingerContact, ...], finger: int, workpiece: Pose) -> Row:
    """Centre of a finger's contact points and the sum of their forces, in the world; NaN without contact."""
    points = [point for point in pressed if point.finger == finger and point.normal_force_n > 0.0]
    if not points:
        return _NO_CONTACT
    normal_n = np.array([point.normal_force_n for point in points])
    centre = normal_n @ np.array([point.position_m for point in points]) / normal_n.sum()
    force = normal_n @ np.array([point.normal for point in points]) + np.sum([one.friction_n for one in points], axis=0)
    x, y, z = centre.tolist()
    fx, fy, fz = force.tolist()
    return (*(workpiece @ Pose(position_m=(x, y, z))).position_m, *workpiece.rotate((fx, fy, fz)))
