"""Motion of object and fingers in the hand, by differences of poses."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.physics import ContactWorld, HandView
from rgss.scenes import Pose

_Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class HandMotion:
    """Motion of object and fingers in the hand over a short interval.

    Velocities are computed from poses, not from the engine's velocities: for bodies that move together along a curve
    these differ by the acceleration times a step, which is not slip.

    Attributes:
        before: Transform of the object to the grasp-centre frame at the start.
        held: Transform of the object to the grasp-centre frame at the end.
        closing_m_s: Closing speed of each finger.
        span_s: Length of the interval.
    """

    before: Pose
    held: Pose
    closing_m_s: tuple[float, ...]
    span_s: float

    def velocity_at(self, point_m: _Triple) -> _Triple:
        """Velocity (m/s) of a point of the object relative to the hand; point and result in the object's frame."""
        (ax, ay, az), (bx, by, bz) = self.held.rotate(point_m), self.before.rotate(point_m)
        (px, py, pz), (qx, qy, qz) = self.held.position_m, self.before.position_m
        span_s = self.span_s
        motion = ((px + ax) - (qx + bx)) / span_s, ((py + ay) - (qy + by)) / span_s, ((pz + az) - (qz + bz)) / span_s
        return self.held.inverse_rotate(motion)

    def twist(self) -> tuple[_Triple, _Triple]:
        """Velocity (m/s) of the object's centre and angular velocity (rad/s) of the object, in the hand's frame."""
        now, then = self.held.position_m, self.before.position_m
        x, y, z = ((one - other) / self.span_s for one, other in zip(now, then, strict=True))
        # For a small rotation the rotation vector is twice the quaternion's vector part.
        turned = self.held @ self.before.inverse()
        qx, qy, qz, qw = turned.quaternion_xyzw
        scale = (2.0 if qw > 0.0 else -2.0) / self.span_s
        return (x, y, z), (qx * scale, qy * scale, qz * scale)


class InHandMotionTracker:
    """Tracker of the motion in the hand."""

    def __init__(self, world: ContactWorld) -> None:
        """Take the first sample."""
        self._world = world
        self._at = 0
        self._view = world.hand_view()
        self._earlier = (0, self._view)
        self._motion: HandMotion | None = None

    @property
    def motion(self) -> HandMotion:
        """Motion between the last two samples; zero before the second."""
        # Derived values are computed only on demand.
        if self._motion is None:
            (then, before), now = self._earlier, self._view
            span_s = (self._at - then) * self._world.settings.step_s
            if span_s > 0.0:
                closing = tuple(
                    (end - start) / span_s for end, start in zip(now.travel_m, before.travel_m, strict=True)
                )
                self._motion = HandMotion(before.held, now.held, closing, span_s)
            else:
                still = (0.0,) * len(now.travel_m)
                self._motion = HandMotion(now.held, now.held, still, self._world.settings.step_s)
        return self._motion

    def look(self, steps: int) -> HandView:
        """Take a sample.

        Args:
            steps: Steps since the first sample.

        Returns:
            The present sample.
        """
        if steps != self._at:
            self._earlier, self._motion = (self._at, self._view), None
            self._at = steps
            self._view = self._world.hand_view()
        return self._view
