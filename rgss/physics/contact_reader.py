"""Reading the engine's contact points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rgss.physics.contacts import Contacts, FingerContact


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
        robot_bodies: list[tuple[str, str]] = []
        workpiece_bodies: list[str] = []
        robot, workpiece = self._robot, self._workpiece
        # All are asked for: asked for one body's, the engine names it A, yet does not turn the friction round.
        for point in self._engine.getContactPoints(physicsClientId=self._client):
            force = point[9]
            if force <= 0.0 and point[8] > 0.0:
                continue
            body_a, body_b = point[1], point[2]
            if body_a == robot or body_b == robot:
                robot_is_a = body_a == robot
                link, partner = (point[3], body_b) if robot_is_a else (point[4], body_a)
                if partner != workpiece:
                    robot_bodies.append((self._link_names[link], self._scene_names[partner]))
                    continue
                finger = self._finger_of_link.get(link)
                if finger is None:
                    other += force
                    continue
                forces[finger] += force
                # The engine gives friction as it acts on body A.
                sign = -1.0 if robot_is_a else 1.0
                first, along_first, second, along_second = point[10], point[11], point[12], point[13]
                fx += sign * (first * along_first[0] + second * along_second[0])
                fy += sign * (first * along_first[1] + second * along_second[1])
                fz += sign * (first * along_first[2] + second * along_second[2])
            elif body_a == workpiece or body_b == workpiece:
                workpiece_bodies.append(self._scene_names[body_b if body_a == workpiece else body_a])
        return Contacts(
            finger_forces_n=tuple(forces),
            other_force_n=other,
            friction_n=(fx, fy, fz),
            robot_bodies=tuple(dict.fromkeys(robot_bodies)),
            workpiece_bodies=tuple(dict.fromkeys(workpiece_bodies)),
        )

    def finger_contacts(self) -> tuple[FingerContact, ...]:
        """The points at which fingers press on the workpiece after the last step."""
        found = []
        for point in self._engine.getContactPoints(physicsClientId=self._client):
            bodies = (point[1], point[2])
            if self._workpiece not in bodies or self._robot not in bodies or point[9] <= 0.0:
                continue
            workpiece_is_a = bodies[0] == self._workpiece
            finger = self._finger_of_link.get(point[4] if workpiece_is_a else point[3])
            if finger is None:
                continue
            # The engine's normal points from body B to body A, its friction acts on A.
            sign = 1.0 if workpiece_is_a else -1.0
            normal = tuple(sign * value for value in point[7])
            friction = tuple(
                sign * (point[10] * first + point[12] * second)
                for first, second in zip(point[11], point[13], strict=True)
            )
            position = tuple(point[5 if workpiece_is_a else 6])
            found.append(
                FingerContact(
                    finger, position, normal, point[8], point[9], friction, self._relative_velocity(finger, position)
                )
            )
        return tuple(found)

    def _relative_velocity(self, finger: int, point_m: Sequence[float]) -> tuple[float, float, float]:
        """Velocity of the workpiece at a point of the world relative to a finger's."""
        engine, client = self._engine, self._client
        centre, _ = engine.getBasePositionAndOrientation(self._workpiece, physicsClientId=client)
        linear, angular = engine.getBaseVelocity(self._workpiece, physicsClientId=client)
        state = engine.getLinkState(
            self._robot,
            self._finger_joints[finger],
            computeLinkVelocity=1,
            computeForwardKinematics=1,
            physicsClientId=client,
        )
        one = _velocity_at(point_m, centre, linear, angular)
        other = _velocity_at(point_m, state[0], state[6], state[7])
        return (one[0] - other[0], one[1] - other[1], one[2] - other[2])


def _velocity_at(
    point_m: Sequence[float], centre_m: Sequence[float], linear: Sequence[float], angular: Sequence[float]
) -> tuple[float, float, float]:
    """Velocity of a rigid body at a point of the world: v + ω × (p - c)."""
    x, y, z = (p - c for p, c in zip(point_m, centre_m, strict=True))
    wx, wy, wz = angular
    return linear[0] + wy * z - wz * y, linear[1] + wz * x - wx * z, linear[2] + wx * y - wy * x
