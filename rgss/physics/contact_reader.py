"""Reader of the engine's contact points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from rgss.physics.contacts import Contacts, FingerContact
from rgss.scenes import Pose


class ContactReader:
    """Reader of the engine's contact points of one world, sorted by the touching bodies."""

    def __init__(
        self,
        engine: Any,
        client: int,
        *,
        robot: int,
        workpiece: int,
        finger_of_link: Mapping[int, int],
        link_names: Mapping[int, str],
        scene_names: Mapping[int, str],
        principal: Pose | None = None,
    ) -> None:
        """Register the engine's ids of bodies and links.

        Args:
            engine: The engine's module.
            client: The physics client.
            robot: The robot's body.
            workpiece: The workpiece's body.
            finger_of_link: The finger to which a link belongs, for each link of one.
            link_names: Names of the robot's links.
            scene_names: Names of the scene's bodies.
            principal: Transform of the workpiece's principal axes, whose pose the engine reports, to the frame of its
                shape, in which positions are given; None if they coincide.
        """
        self._principal = Pose() if principal is None else principal
        self._is_turned = self._principal.quaternion_xyzw != Pose().quaternion_xyzw
        self._engine = engine
        self._client = client
        self._robot = robot
        self._workpiece = workpiece
        self._fingers = len(set(finger_of_link.values()))
        self._finger_of_link = finger_of_link
        self._link_names = link_names
        self._scene_names = scene_names
        self._resting: dict[tuple[str, ...], Contacts] = {}

    def contacts(self, standing: Contacts | None = None) -> Contacts:  # noqa: C901 - each step of each trial calls it
        """Contacts after the last step.

        The arm's base link does not move and so is never reported, wherever it is mounted.

        Args:
            standing: Contacts observed when the workpiece last rested without contact to the robot, if it did; they
                remain valid as long as the robot touches nothing.
        """
        if standing is not None and not self._engine.getContactPoints(self._robot, -1, -2, -2, self._client):
            return standing
        forces = [0.0] * self._fingers
        other, pressed = 0.0, []
        robot_bodies: tuple[tuple[str, str], ...] = ()
        workpiece_bodies: tuple[str, ...] = ()
        pressing_links: tuple[str, ...] = ()
        struck: list[tuple[str, str | None, float, Any]] = []
        robot, workpiece = self._robot, self._workpiece
        names, finger_of_link = self._scene_names, self._finger_of_link
        is_robot_touching = False
        # All contacts are queried: a query for one body reports it as A without inverting the friction.
        for point in self._engine.getContactPoints(-1, -1, -2, -2, self._client):
            force = point[9]
            if force <= 0.0 and point[8] > 0.0:
                continue
            body_a, body_b = point[1], point[2]
            if body_a == robot:
                link, partner, sign = point[3], body_b, -1.0
            elif body_b == robot:
                link, partner, sign = point[4], body_a, 1.0
            else:
                if body_a == workpiece or body_b == workpiece:
                    body = names[body_b if body_a == workpiece else body_a]
                    if body not in workpiece_bodies:
                        workpiece_bodies = (*workpiece_bodies, body)
                continue
            is_robot_touching = True
            if partner != workpiece:
                pair = (self._link_names[link], names[partner])
                if pair not in robot_bodies:
                    robot_bodies = (*robot_bodies, pair)
                struck.append((*pair, -sign, point))
                continue
            finger = finger_of_link.get(link)
            if finger is None:
                other += force
                if self._link_names[link] not in pressing_links:
                    pressing_links = (*pressing_links, self._link_names[link])
                struck.append((self._link_names[link], None, -sign, point))
                continue
            forces[finger] += force
            # The engine reports friction as it acts on body A.
            pressed.append((sign, point))
        if is_robot_touching:
            return Contacts(
                tuple(forces), other, tuple(pressed), robot_bodies, workpiece_bodies, pressing_links, tuple(struck)
            )
        # This is the case half of the time, with one body under the workpiece or none.
        resting = self._resting.get(workpiece_bodies)
        if resting is None:
            nothing = (0.0,) * len(forces)
            resting = self._resting[workpiece_bodies] = Contacts(nothing, 0.0, (), (), workpiece_bodies, ())
        return resting

    def scene_force_n(self) -> float:
        """Sum of the normal forces of the scene's bodies on the workpiece in the last step."""
        robot = self._robot
        points = self._engine.getContactPoints(self._workpiece, -1, -2, -2, self._client)
        return math.fsum(point[9] for point in points if robot not in (point[1], point[2]))

    def finger_contacts(self, step_s: float) -> tuple[FingerContact, ...]:
        """Contact points of the fingers on the workpiece in the last step, by finger and ascending height.

        Args:
            step_s: Length of that step, at whose start the engine detected them.
        """
        found = []
        transform = self._workpiece_pose_before(step_s).inverse()
        tx, ty, tz = transform.position_m
        cx, cy, cz = self._principal.position_m
        if self._is_turned:
            transform = self._principal @ transform
            tx, ty, tz = transform.position_m
        elif cx or cy or cz:
            tx, ty, tz = tx + cx, ty + cy, tz + cz
        for point in self._engine.getContactPoints(-1, -1, -2, -2, self._client):
            bodies = (point[1], point[2])
            if self._workpiece not in bodies or self._robot not in bodies or point[9] <= 0.0:
                continue
            workpiece_is_a = bodies[0] == self._workpiece
            finger = self._finger_of_link.get(point[4] if workpiece_is_a else point[3])
            if finger is None:
                continue
            # The engine's normal points from body B to body A, its friction acts on A.
            sign = 1.0 if workpiece_is_a else -1.0
            nx, ny, nz = point[7]
            first, (ax, ay, az), second, (bx, by, bz) = sign * point[10], point[11], sign * point[12], point[13]
            px, py, pz = transform.rotate(point[5 if workpiece_is_a else 6])
            found.append(
                FingerContact(
                    finger,
                    (tx + px, ty + py, tz + pz),
                    transform.rotate((sign * nx, sign * ny, sign * nz)),
                    point[8],
                    point[9],
                    transform.rotate((first * ax + second * bx, first * ay + second * by, first * az + second * bz)),
                )
            )
        return tuple(sorted(found, key=lambda point: (point.finger, point.position_m[2])))

    def _workpiece_pose_before(self, step_s: float) -> Pose:
        """Pose of the workpiece before a step, which the engine integrates with the velocity after the step."""
        engine, client = self._engine, self._client
        (x, y, z), turned = engine.getBasePositionAndOrientation(self._workpiece, physicsClientId=client)
        (vx, vy, vz), (wx, wy, wz) = engine.getBaseVelocity(self._workpiece, physicsClientId=client)
        spin = math.sqrt(wx * wx + wy * wy + wz * wz)
        half = spin * step_s / 2
        share = -math.sin(half) / spin if spin > 0.0 else 0.0
        back = Pose(quaternion_xyzw=(share * wx, share * wy, share * wz, math.cos(half)))
        before = back @ Pose(quaternion_xyzw=turned)
        return Pose(
            position_m=(x - vx * step_s, y - vy * step_s, z - vz * step_s), quaternion_xyzw=before.quaternion_xyzw
        )
