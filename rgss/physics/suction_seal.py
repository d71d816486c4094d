"""Seal of a suction cup on the workpiece: a bond that breaks when its load exceeds the vacuum's force.

The bond is a constraint of an engine. Its force in the last step is resolved into tension along the cup's axis,
tangential force, and the moment about the centre of the lip. With F the force of the vacuum, the lip presses on the
surface with F minus the tension; on the side of the greatest tension it lifts off when the moment exceeds (F - tension)
times the lip's radius. The load is averaged over 20 ms, like the compliance of a cup does.
"""

from __future__ import annotations

import math
from collections import deque
from typing import Protocol

from rgss.scenes import Gripper, Pose, Suction, SuctionPoint

Vector3 = tuple[float, float, float]
_WINDOW_S = 0.02


class SuctionBond(Protocol):
    """Rigid bond between a suction cup and the workpiece in an engine."""

    @property
    def is_attached(self) -> bool:
        """True while the bond holds cup and workpiece together."""

    def attach(self) -> None:
        """Bond the workpiece to the cup at their present poses; the two do not collide while they are bonded."""

    def detach(self) -> None:
        """Remove the bond."""

    def is_borne(self) -> bool:
        """True if anything but the robot pressed on the workpiece in the last step."""

    def reaction(self, about_m: Vector3) -> tuple[Vector3, Vector3]:
        """Force (N) of the workpiece on the cup and its moment (N·m) in the last step, in the world.

        Args:
            about_m: The point about which the moment is taken, in the world.
        """


class SuctionSeal:
    """Seal between a cup and the workpiece.

    Attributes:
        force_n: Present normal force of the vacuum; 0 if not sealed.
        fault: Reason why the cup does not hold the workpiece; empty if it does.
        margin: Factor by which the load could grow before the seal breaks, below 1 for the load that broke it; None if
        the load is unknown.
    """

    def __init__(
        self, bond: SuctionBond, *, point: SuctionPoint, gripper: Gripper, suction: Suction, step_s: float
    ) -> None:
        """Start without a vacuum.

        Args:
            bond: The engine's bond of cup and workpiece.
            point: Intended place of the cup on the workpiece.
            gripper: The gripper with its greatest normal force.
            suction: Sealing conditions and holding force of the cup.
            step_s: Length of a step.
        """
        self.force_n = 0.0
        self.fault = ""
        self.margin: float | None = None
        self._bond = bond
        self._point, self._gripper, self._suction, self._step_s = point, gripper, suction, step_s
        cup = gripper.geometry.cup
        self._radius_m = 0.0 if cup is None else cup.radius_m
        self._loads: deque[tuple[float, ...]] = deque(maxlen=max(1, round(_WINDOW_S / step_s)))
        self._on_s: float | None = None
        self._off_s = math.inf

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
        if not self._bond.is_attached:
            self.fault = self._misplaced(lip, workpiece)
            if self.fault:
                self._on_s, self.force_n = 0.0, 0.0
                return
        self._on_s += self._step_s
        share = min(1.0, self._on_s / self._suction.build_up_s)
        tight = share * (1.0 - self._suction.leak)
        self.force_n = tight * self._gripper.finger_force_n
        if self._bond.is_attached:
            self._check(lip, tight)
        elif share >= 1.0 - 1e-9:
            # While the vacuum builds up the object comes to rest on its support.
            self._bond.attach()

    def pull_n(self) -> Vector3 | None:
        """Force on the workpiece in the world, in the last step; None without a bond."""
        if not self._bond.is_attached:
            return None
        (fx, fy, fz), _ = self._bond.reaction((0.0, 0.0, 0.0))
        return -fx, -fy, -fz

    def _misplaced(self, lip: Pose, workpiece: Pose) -> str:
        """Reason why the cup cannot seal at its pose; empty if it can."""
        suction, point, workpiece_to_lip = self._suction, self._point, lip.inverse() @ workpiece
        x, y, z = (workpiece_to_lip @ Pose(position_m=point.position_m)).position_m
        _, _, along = workpiece_to_lip.rotate(point.normal)
        angle_rad = math.acos(max(-1.0, min(1.0, -along)))
        aside_m, room_m = math.hypot(x, y), point.room_m - self._radius_m
        if room_m < 0.0 or aside_m > room_m:
            room = (
                f"leaves it {room_m * 1e3:.2f} mm" if room_m >= 0.0 else f"is {-room_m * 1e3:.2f} mm too narrow for it"
            )
            return f"the cup is {aside_m * 1e3:.2f} mm off its place, and the face {room}"
        if abs(z) > suction.largest_gap_m:
            return f"the cup is {z * 1e3:.1f} mm above the object, it seals within {suction.largest_gap_m * 1e3:g} mm"
        if angle_rad > suction.largest_angle_rad:
            largest = math.degrees(suction.largest_angle_rad)
            return f"the cup is tilted by {math.degrees(angle_rad):.1f}° against the face, it seals within {largest:g}°"
        return ""

    def _check(self, lip: Pose, tight: float) -> None:
        """Break the bond if its load exceeds the holding force of the vacuum."""
        if self._bond.is_borne():
            # The support then shares the load, in a proportion that is arbitrary in the solver.
            self._loads.clear()
            self.margin = None
            return
        force, moment = self._bond.reaction(lip.position_m)
        about_x, about_y, _ = lip.inverse_rotate(moment)
        self._loads.append((*lip.inverse_rotate(force), about_x, about_y))
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

    def _release(self, fault: str) -> None:
        self.fault, self.force_n = fault, 0.0
        if not self._bond.is_attached:
            return
        self._bond.detach()
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
