"""Snapshot of object, tool and fingers; derived quantities are computed on demand."""

from __future__ import annotations

from typing import NamedTuple

from rgss.scenes import Pose

Triple = tuple[float, float, float]
Quadruple = tuple[float, float, float, float]


class HandView(NamedTuple):
    """Snapshot of object, flange and fingers at one instant.

    A carried object is sampled many times a second, and mostly only its position is needed.

    Attributes:
        workpiece_m: Position of the workpiece in the world.
        workpiece_xyzw: Its orientation.
        flange_m: Position of the flange in the world.
        flange_xyzw: Its orientation, and so that of the tool.
        grasp_centre_m: Position of the grasp centre in the flange's frame; both have the same orientation.
        travel_m: Travel of each finger from open.
    """

    workpiece_m: Triple
    workpiece_xyzw: Quadruple
    flange_m: Triple
    flange_xyzw: Quadruple
    grasp_centre_m: Triple
    travel_m: tuple[float, ...]

    @property
    def tool(self) -> Pose:
        """Transform of the grasp-centre frame to the world."""
        flange = Pose(position_m=self.flange_m, quaternion_xyzw=self.flange_xyzw)
        (x, y, z), (dx, dy, dz) = self.flange_m, flange.rotate(self.grasp_centre_m)
        return Pose(position_m=(x + dx, y + dy, z + dz), quaternion_xyzw=self.flange_xyzw)

    @property
    def held(self) -> Pose:
        """Transform of the workpiece to the grasp-centre frame."""
        return Pose(position_m=self.workpiece_m, quaternion_xyzw=self.workpiece_xyzw).relative_to(self.tool)

    @property
    def held_at_m(self) -> Triple:
        """Position of the workpiece in the grasp-centre frame, in m: that of `held`, bit for bit."""
        x, y, z, w = self.flange_xyzw
        cx, cy, cz = self.grasp_centre_m
        tx, ty, tz = 2 * (y * cz - z * cy), 2 * (z * cx - x * cz), 2 * (x * cy - y * cx)
        (ax, ay, az), (bx, by, bz) = self.workpiece_m, self.flange_m
        vx = ax - (bx + (cx + w * tx + y * tz - z * ty))
        vy = ay - (by + (cy + w * ty + z * tx - x * tz))
        vz = az - (bz + (cz + w * tz + x * ty - y * tx))
        tx, ty, tz = 2 * (z * vy - y * vz), 2 * (x * vz - z * vx), 2 * (y * vx - x * vy)
        return (
            vx + w * tx - y * tz + z * ty,
            vy + w * ty - z * tx + x * tz,
            vz + w * tz - x * ty + y * tx,
        )
