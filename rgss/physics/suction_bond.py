"""Bond of a suction cup and the workpiece in PyBullet: a fixed constraint.

With a rigid bond between a rigid hand and a rigid support the force between them would be undetermined, so the object's
contact with its support is compliant.
"""

from __future__ import annotations

from typing import Any

from rgss.physics.bodies import links_of
from rgss.physics.suction_seal import Vector3

_BOND_SHARE = 2.0
_SUPPORT_STIFFNESS_N_M = 1.0e5
_SUPPORT_DAMPING_N_S_M = 1.0e3


class PyBulletBond:
    """Implementation of `SuctionBond` in one physics client."""

    def __init__(
        self, engine: Any, client: int, *, robot: int, cup_link: int, bond_link: int, body: int, greatest_force_n: float
    ) -> None:
        """Start detached, with a compliant support of the workpiece.

        Args:
            engine: The engine's module.
            client: The physics client.
            robot: The robot's body.
            cup_link: Link of the cup.
            bond_link: Link that the constraint holds; the cup's, or one to which it is fixed.
            body: The workpiece's body.
            greatest_force_n: Greatest normal force of the cup.
        """
        self._engine, self._client = engine, client
        self._robot, self._cup_link, self._bond_link, self._body = robot, cup_link, bond_link, body
        self._greatest_force_n = greatest_force_n
        self._bond: int | None = None
        for number in links_of(engine, client, body):
            engine.changeDynamics(
                body,
                number,
                contactStiffness=_SUPPORT_STIFFNESS_N_M,
                contactDamping=_SUPPORT_DAMPING_N_S_M,
                physicsClientId=client,
            )

    @property
    def is_attached(self) -> bool:
        """True while the bond holds cup and workpiece together."""
        return self._bond is not None

    def attach(self) -> None:
        """Bond the workpiece to the cup at their present poses."""
        engine, client = self._engine, self._client
        state = engine.getLinkState(self._robot, self._bond_link, computeForwardKinematics=1, physicsClientId=client)
        at, turned = engine.getBasePositionAndOrientation(self._body, client)
        back = engine.invertTransform(state[0], state[1])
        position, orientation = engine.multiplyTransforms(*back, at, turned)
        self._bond = engine.createConstraint(
            self._robot,
            self._bond_link,
            self._body,
            -1,
            engine.JOINT_FIXED,
            [0, 0, 0],
            position,
            [0, 0, 0],
            orientation,
            [0, 0, 0, 1],
            physicsClientId=client,
        )
        engine.changeConstraint(self._bond, maxForce=_BOND_SHARE * self._greatest_force_n, physicsClientId=client)
        self._let_touch(touching=False)

    def detach(self) -> None:
        """Remove the bond."""
        self._engine.removeConstraint(self._bond, physicsClientId=self._client)
        self._let_touch(touching=True)
        self._bond = None

    def is_borne(self) -> bool:
        """True if anything but the robot pressed on the workpiece in the last step."""
        points = self._engine.getContactPoints(self._body, -1, -2, -2, self._client)
        return any(point[9] > 0.0 and self._robot not in (point[1], point[2]) for point in points)

    def reaction(self, about_m: Vector3) -> tuple[Vector3, Vector3]:
        """Force of the workpiece on the cup and its moment; see `SuctionBond.reaction`."""
        fx, fy, fz, mx, my, mz = self._engine.getConstraintState(self._bond, self._client)
        at, _ = self._engine.getBasePositionAndOrientation(self._body, self._client)
        # The engine reports them in the world, about the object's centre of mass.
        ax, ay, az = (one - other for one, other in zip(at, about_m, strict=True))
        return (fx, fy, fz), (mx + ay * fz - az * fy, my + az * fx - ax * fz, mz + ax * fy - ay * fx)

    def _let_touch(self, *, touching: bool) -> None:
        """Let cup and object collide, or not: a bond and a contact of the same two would oppose each other."""
        engine, client = self._engine, self._client
        for number in links_of(engine, client, self._body):
            engine.setCollisionFilterPair(
                self._robot, self._body, self._cup_link, number, int(touching), physicsClientId=client
            )
