"""Rigid transforms, SE(3), between named frames."""

from __future__ import annotations

import math
from dataclasses import dataclass

_GIMBAL_LOCK = 1.0e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Pose:
    """Rigid transform of a frame to an outer frame, as position in m and unit quaternion.

    Names state both frames: ``transform_b_to_a`` maps coordinates in frame b to frame a.

    Attributes:
        position_m: Origin of the frame in the outer frame.
        quaternion_xyzw: Orientation of the frame in the outer frame, scalar last.
    """

    position_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    quaternion_xyzw: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)

    @staticmethod
    def from_roll_pitch_yaw(
        position_m: tuple[float, float, float], roll_pitch_yaw_rad: tuple[float, float, float]
    ) -> Pose:
        """Pose from fixed-axis rotations about x, then y, then z, as in URDF."""
        roll, pitch, yaw = (angle / 2 for angle in roll_pitch_yaw_rad)
        cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
        quaternion = (
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        )
        return Pose(position_m=position_m, quaternion_xyzw=quaternion)

    def roll_pitch_yaw_rad(self) -> tuple[float, float, float]:
        """Fixed-axis rotations about x, then y, then z, as in URDF; at a pitch of 90 deg the yaw is 0."""
        from scipy.spatial.transform import Rotation

        rotation = Rotation.from_quat(self.quaternion_xyzw)
        (xx, _, _), (yx, yy, yz), (zx, _, _) = rotation.as_matrix().tolist()
        if math.hypot(xx, yx) < _GIMBAL_LOCK:
            return math.atan2(-yz, yy), math.copysign(math.pi / 2, -zx), 0.0
        roll, pitch, yaw = rotation.as_euler("xyz").tolist()
        return roll, pitch, yaw

    def rotate(self, vector: tuple[float, float, float]) -> tuple[float, float, float]:
        """Rotate a vector from this frame to the outer frame, without translation."""
        x, y, z, w = self.quaternion_xyzw
        return _turned(x, y, z, w, vector)

    def inverse_rotate(self, vector: tuple[float, float, float]) -> tuple[float, float, float]:
        """Rotate a vector from the outer frame to this frame, without translation."""
        x, y, z, w = self.quaternion_xyzw
        return _turned(-x, -y, -z, w, vector)

    def __matmul__(self, inner: Pose) -> Pose:
        """Composition: ``transform_b_to_a @ transform_c_to_b`` is ``transform_c_to_a``."""
        ox, oy, oz = self.rotate(inner.position_m)
        px, py, pz = self.position_m
        ax, ay, az, aw = self.quaternion_xyzw
        bx, by, bz, bw = inner.quaternion_xyzw
        return Pose(
            position_m=(px + ox, py + oy, pz + oz),
            quaternion_xyzw=(
                aw * bx + ax * bw + ay * bz - az * by,
                aw * by - ax * bz + ay * bw + az * bx,
                aw * bz + ax * by - ay * bx + az * bw,
                aw * bw - ax * bx - ay * by - az * bz,
            ),
        )

    def inverse(self) -> Pose:
        """Inverse transform."""
        x, y, z, w = self.quaternion_xyzw
        px, py, pz = self.inverse_rotate(self.position_m)
        return Pose(position_m=(-px, -py, -pz), quaternion_xyzw=(-x, -y, -z, w))

    def relative_to(self, frame: Pose) -> Pose:
        """This pose relative to a frame with the same outer frame: ``frame.inverse() @ self`` in one step."""
        x, y, z, w = frame.quaternion_xyzw
        (ax, ay, az), (bx, by, bz) = self.position_m, frame.position_m
        vx, vy, vz = ax - bx, ay - by, az - bz
        tx, ty, tz = 2 * (z * vy - y * vz), 2 * (x * vz - z * vx), 2 * (y * vx - x * vy)
        qx, qy, qz, qw = self.quaternion_xyzw
        return Pose(
            position_m=(
                vx + w * tx - y * tz + z * ty,
                vy + w * ty - z * tx + x * tz,
                vz + w * tz - x * ty + y * tx,
            ),
            quaternion_xyzw=(
                w * qx - x * qw - y * qz + z * qy,
                w * qy + x * qz - y * qw - z * qx,
                w * qz - x * qy + y * qx - z * qw,
                w * qw + x * qx + y * qy + z * qz,
            ),
        )

    def raised(self, height_m: float) -> Pose:
        """Pose translated along the outer frame's z."""
        x, y, z = self.position_m
        return Pose(position_m=(x, y, z + height_m), quaternion_xyzw=self.quaternion_xyzw)

    @property
    def tilt_rad(self) -> float:
        """Angle in rad between this frame's z axis and the outer frame's z axis."""
        return math.acos(max(-1.0, min(1.0, self.rotate((0.0, 0.0, 1.0))[2])))


def _turned(x: float, y: float, z: float, w: float, vector: tuple[float, float, float]) -> tuple[float, float, float]:
    """Vector rotated by a unit quaternion."""
    vx, vy, vz = vector
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )
