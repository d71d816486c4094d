"""Seal of a suction cup on the workpiece: a bond that breaks when its load exceeds the vacuum's force.

The bond is a constraint of the engine. Its force in the last step is resolved into tension along the cup's axis,
tangential force, and the moment about the centre of the lip. With F the force of the vacuum, the lip presses on the
surface with F minus the tension; on the side of the greatest tension it lifts off when the moment exceeds (F - tension)
times the lip's radius. The load is averaged over 20 ms, like the compliance of a cup does.

With a rigid bond between a rigid hand and a rigid support the force between them would be undetermined, so the object's
contact with its support is compliant.
"""

from __future__ import annotations

import math
from collections import deque
from typing import Any

from rgss.physics.bodies import links_of
from rgss.scenes import Gripper, Pose, Suction, SuctionPoint

_BOND_SHARE = 2.0
_WINDOW_S = 0.02
_SUPPORT_STIFFNESS_N_M = 1.0e5
_SUPPORT_DAMPING_N_S_M = 1.0e3


class SuctionSeal:
    """Seal between the cup and the workpiece in one physics client.

    Attributes:
        force_n: Present normal force of the vacuum; 0 if not sealed.
        fault: Reason why the cup does not hold the workpiece; empty if it does.
        margin: Factor by which the load could grow before the seal breaks, below 1 for the load that broke it; None if
        the load is unknown.
    """

    def __init__(
        self,
        engine: Any,
        client: int,
        *,
        robot: int,
        cup_link: int,
        body: int,
        point: SuctionPoint,
        gripper: Gripper,
        suction: Suction,
        step_s: float,
    ) -> None:
        """Start without a vacuum.

        Args:
            engine: The engine's module.
            client: The physics client.
            robot: The robot's body.
            cup_link: Link of the cup.
            body: The workpiece's body.
            point: Intended place of the cup on the workpiece.
            gripper: The gripper with its greatest normal force.
            suction: Sealing conditions and holding force of the cup.
            step_s: Length of a step.
        """
        self.force_n = 0.0
        self.fault = ""
        self.margin: float | None = None
        self._engine, self._client = engine, client
        self._robot, self._link, self._body = robot, cup_link, body
        self._point, self._gripper, self._suction, self._step_s = point, gripper, suction, step_s
        cup = gripper.geometry.cup
        self._radius_m = 0.0 if cup is None else cup.radius_m
        self._loads: deque[tuple[float, ...]] = deque(maxlen=max(1, round(_WINDOW_S / step_s)))
        self._bond: int | None = None
        self._on_s: float | None = None
        self._off_s = math.inf
        for number in links_of(engine, client, body):
            engine.changeDynamics(
                body,
                number,
                contactStiffness=_SUPPORT_STIFFNESS_N_M,
                contactDamping=_SUPPORT_DAMPING_N_S_M,
                physicsClientId=client,
            )

    @property
    def is_sealed(self) -> bool:
        """True while the vacuum acts on the workpiece."""
        return self.force_n > 0.0

    def switch(self, *, on: bool) -> None:
        """Switch the vacuum on or off; switched off, it holds until it is vented."""
        if on:
            self._on_s = 0.0 if self._on_s is None else self._on_s
            self._off_s = math.inf
        elif self._on_s is not None and math.isinf(self._off_s):
            self._off_s = 0.0

    def after_step(self, flange: Pose, workpiece: Pose) -> None:
        """Update the vacuum, seal if the surface is within the largest gap, and break an overloaded bond.

        Args:
            flange: Transform of the flange to the world.
            workpiece: Transform of the workpiece's shape to the world.
        """
        if self._on_s is None:
            return
        lip = flange @ self._gripper.geometry.lip
        if not math.isinf(self._off_s):
            self._off_s += self._step_s
            if self._off_s >= self._suction.release_s - 1e-9:
                self._release("the vacuum is off")
                self._on_s, self.margin = None, None
            return
        if self._bond is None:
            self.fault = self._misplaced(lip, workpiece)
            if self.fault:
                self._on_s, self.force_n = 0.0, 0.0
                return
        self._on_s += self._step_s
        share = min(1.0, self._on_s / self._suction.build_up_s)
        tight = share * (1.0 - self._suction.leak)
        self.force_n = tight * self._gripper.finger_force_n
        if self._bond is not None:
            self._check(lip, tight)
        elif share >= 1.0 - 1e-9:
            # While the vacuum builds up the object comes to rest on its support.
            self._seal()

    def pull_n(self) -> tuple[float, float, float] | None:
        """Force on the workpiece in the world, in the last step; None without a bond."""
        if self._bond is None:
            return None
        fx, fy, fz, *_ = self._engine.getConstraintState(self._bond, self._client)
        return -fx, -fy, -fz

    def _misplaced(self, lip: Pose, workpiece: Pose) -> str:
        """Reason why the cup cannot seal at its pose; empty if it can."""
        suction, point, workpiece_to_lip = self._suction, self._point, lip.inverse() @ workpiece
        x, y, z = (workpiece_to_lip @ Pose(position_m=point.position_m)).position_m
        _, _, along = workpiece_to_lip.rotate(point.normal)
        angle_rad = math.acos(max(-1.0, min(1.0, -along)))
        aside_m, room_m = math.hypot(x, y), point.room_m - self._radius_m
        if room_m < 0.0 or aside_m > room_m:
            return f"the cup is {aside_m * 1e3:.1f} mm off its place on a face that leaves it {room_m * 1e3:.1f} mm"
        if abs(z) > suction.largest_gap_m:
            return f"the cup is {z * 1e3:.1f} mm above the object, it seals within {suction.largest_gap_m * 1e3:g} mm"
        if angle_rad > suction.largest_angle_rad:
            largest = math.degrees(suction.largest_angle_rad)
            return f"the cup is tilted by {math.degrees(angle_rad):.1f}° against the face, it seals within {largest:g}°"
        return ""

    def _seal(self) -> None:
        engine, client = self._engine, self._client
        state = engine.getLinkState(self._robot, self._link, computeForwardKinematics=1, physicsClientId=client)
        at, turned = engine.getBasePositionAndOrientation(self._body, client)
        back = engine.invertTransform(state[0], state[1])
        position, orientation = engine.multiplyTransforms(*back, at, turned)
        self._bond = engine.createConstraint(
            self._robot,
            self._link,
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
        engine.changeConstraint(self._bond, maxForce=_BOND_SHARE * self._gripper.finger_force_n, physicsClientId=client)
        self._let_touch(touching=False)

    def _let_touch(self, *, touching: bool) -> None:
        """Let cup and object collide, or not: a bond and a contact of the same two would oppose each other."""
        engine, client = self._engine, self._client
        for number in links_of(engine, client, self._body):
            engine.setCollisionFilterPair(
                self._robot, self._body, self._link, number, int(touching), physicsClientId=client
            )

    def _check(self, lip: Pose, tight: float) -> None:
        """Break the bond if its load exceeds the holding force of the vacuum."""
        if self._is_standing():
            # The support then shares the load, in a proportion that is arbitrary in the solver.
            self._loads.clear()
            self.margin = None
            return
        self._loads.append(self._load(lip))
        if len(self._loads) < (self._loads.maxlen or 1):
            return
        along_x, along_y, tension_n, about_x, about_y = (
            math.fsum(values) / len(self._loads) for values in zip(*self._loads, strict=True)
        )
        tangential_n, bending_n_m = math.hypot(along_x, along_y), math.hypot(about_x, about_y)
        greatest_n = tight * self._suction.tangential_force_n
        self.margin = seal_margin(
            self.force_n,
            greatest_n,
            lifting_n=tension_n + bending_n_m / self._radius_m,
            tangential_n=tangential_n,
        )
        if tension_n > self.force_n:
            self._release(f"the cup holds {self.force_n:.2f} N along its axis, the object pulls with {tension_n:.2f} N")
        elif tangential_n > greatest_n:
            self._release(
                f"the cup holds {greatest_n:.2f} N across its axis, the object pulls with {tangential_n:.2f} N"
            )
        elif bending_n_m > (self.force_n - tension_n) * self._radius_m:
            self._release(f"a moment of {bending_n_m:.3f} N·m lifts the lip of the cup off the object")

    def _is_standing(self) -> bool:
        """True if anything but the robot is in contact with the object."""
        points = self._engine.getContactPoints(self._body, -1, -2, -2, self._client)
        return any(point[9] > 0.0 and self._robot not in (point[1], point[2]) for point in points)

    def _load(self, lip: Pose) -> tuple[float, float, float, float, float]:
        """Force (N) on the cup along x, y, z of the lip and moment (N·m) about x and y of its centre, last step."""
        fx, fy, fz, mx, my, mz = self._engine.getConstraintState(self._bond, self._client)
        at, _ = self._engine.getBasePositionAndOrientation(self._body, self._client)
        # The engine reports them in the world, about the object's centre of mass.
        ax, ay, az = (one - other for one, other in zip(at, lip.position_m, strict=True))
        moment = lip.inverse_rotate((mx + ay * fz - az * fy, my + az * fx - ax * fz, mz + ax * fy - ay * fx))
        along_x, along_y, tension_n = lip.inverse_rotate((fx, fy, fz))
        return along_x, along_y, tension_n, moment[0], moment[1]

    def _release(self, fault: str) -> None:
        self.fault, self.force_n = fault, 0.0
        if self._bond is None:
            return
        self._engine.removeConstraint(self._bond, physicsClientId=self._client)
        self._let_touch(touching=True)
        self._bond = None
        self._loads.clear()
        if math.isinf(self._off_s):
            # A cup that was torn off does not seal again.
            self._on_s = None


def seal_margin(normal_n: float, across_n: float, *, lifting_n: float, tangential_n: float) -> float | None:
    """Factor by which a load could grow before it breaks a seal; None if it never would.

    Args:
        normal_n: Force of the vacuum.
        across_n: Greatest force along the surface.
        lifting_n: Tension, plus the moment divided by the radius of the lip.
        tangential_n: Force along the surface.
    """
    limits = [limit / load for limit, load in ((normal_n, lifting_n), (across_n, tangential_n)) if load > 0.0]
    return min(limits, default=None)
