"""Reading the engine's contact points."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rgss.physics.contacts import Contacts, FingerContact
from rgss.scenes import Pose


class ContactReader:
    """Sorts the engine's contact points of one world by who touches whom."""

    def __init__(
        self,
        engine: Any,
        client: int,
        *,
        robot: int,
        workpiece: int,
        finger_links: Sequence[int],
        link_names: Mapping[int, str],
        scene_names: Mapping[int, str],
    ) -> None:
        """Say what the engine's numbers stand for.

        Args:
            engine: The engine's module.
            client: The physics client.
            robot: The robot's body.
            workpiece: The workpiece's body.
            finger_links: The link of each finger.
            link_names: Names of the robot's links.
            scene_names: Names of the scene's bodies.
        """
        self._engine = engine
        self._client = client
        self._robot = robot
        self._workpiece = workpiece
        self._finger_joints = tuple(finger_links)
        self._finger_of_link = {link: finger for finger, link in enumerate(finger_links)}
        self._link_names = link_names
        self._scene_names = scene_names

    def contacts(self) -> Contacts:
        """What touches what after the last step.

        The arm's base link does not move and so is never reported, wherever it is mounted.
        """
        forces = [0.0] * len(self._finger_joints)
        other = fx = fy = fz = 0.0
        robot_bodies: tuple[tuple[str, str], ...] = ()
        workpiece_bodies: tuple[str, ...] = ()
        robot, workpiece = self._robot, self._workpiece
        # All are asked for: asked for one body's, the engine names it A, yet does not turn the friction round.
        for point in self._engine.getContactPoints(-1, -1, -2, -2, self._client):
            _, body_a, body_b, link_a, link_b, _, _, _, gap, force, first, along_first, second, along_second = point
            if force <= 0.0 and gap > 0.0:
                continue
            if body_a == robot:
                link, partner, sign = link_a, body_b, -1.0
            elif body_b == robot:
                link, partner, sign = link_b, body_a, 1.0
            else:
                if body_a == workpiece or body_b == workpiece:
                    body = self._scene_names[body_b if body_a == workpiece else body_a]
                    if body not in workpiece_bodies:
                        workpiece_bodies = (*workpiece_bodies, body)
                continue
            if partner != workpiece:
                pair = (self._link_names[link], self._scene_names[partner])
                if pair not in robot_bodies:
                    robot_bodies = (*robot_bodies, pair)
                continue
            finger = self._finger_of_link.get(link)
            if finger is None:
                other += force
                continue
            forces[finger] += force
            # The engine gives friction as it acts on body A.
            ax, ay, az = along_first
            bx, by, bz = along_second
            fx += sign * (first * ax + second * bx)
            fy += sign * (first * ay + second * by)
            fz += sign * (first * az + second * bz)
        return Contacts(tuple(forces), other, (fx, fy, fz), robot_bodies, workpiece_bodies)

    def finger_contacts(self, step_s: float) -> tuple[FingerContact, ...]:
        """The points at which fingers press on the workpiece after the last step.

        Args:
            step_s: Length of that step, at whose start the engine found them.
        """
        found = []
        transform = self._workpiece_pose_before(step_s).inverse()
        turn = Pose(quaternion_xyzw=transform.quaternion_xyzw)
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
            found.append(
                FingerContact(
                    finger,
                    (transform @ Pose(position_m=point[5 if workpiece_is_a else 6])).position_m,
                    turn.rotate((sign * nx, sign * ny, sign * nz)),
                    point[8],
                    point[9],
                    turn.rotate((first * ax + second * bx, first * ay + second * by, first * az + second * bz)),
                )
            )
        return tuple(found)

    def points_by_finger(self) -> dict[int, int]:
        """Number of points that the engine has between each finger, by its link, and the workpiece."""
        counts = dict.fromkeys(self._finger_joints, 0)
        for point in self._engine.getContactPoints(self._workpiece, self._robot, -2, -2, self._client):
            link = point[4] if point[1] == self._workpiece else point[3]
            if link in counts:
                counts[link] += 1
        return counts

    def _workpiece_pose_before(self, step_s: float) -> Pose:
        """Where the workpiece was before a step: the engine moves a body with the velocity that it has afterwards."""
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
