"""How the object and the fingers move in the hand, from where they were a moment ago."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.physics import World
from rgss.scenes import Pose

_Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class HandMotion:
    """Object and fingers at the ends of a short time.

    Velocities are from places, not from the engine's velocities: of bodies that go round a bend
    together these differ by the acceleration times a step, which is no slip.

    Attributes:
        before: Transform of the object to the grasp centre at the start.
        held: The same at the end.
        closing_m_s: Speed at which each finger closes.
        span_s: The time between the two.
    """

    before: Pose
    held: Pose
    closing_m_s: tuple[float, ...]
    span_s: float

    def velocity_at(self, point_m: _Triple) -> _Triple:
        """Velocity (m/s) in the hand of a point of the object, which is given and answered in the object's frame."""
        now = (self.held @ Pose(position_m=point_m)).position_m
        then = (self.before @ Pose(position_m=point_m)).position_m
        x, y, z = (one - other for one, other in zip(now, then, strict=True))
        turn = Pose(quaternion_xyzw=self.held.inverse().quaternion_xyzw)
        return turn.rotate((x / self.span_s, y / self.span_s, z / self.span_s))

    def twist(self) -> tuple[_Triple, _Triple]:
        """Velocity (m/s) of the object's centre and angular velocity (rad/s) of the object, in the hand's frame."""
        now, then = self.held.position_m, self.before.position_m
        x, y, z = ((one - other) / self.span_s for one, other in zip(now, then, strict=True))
        # A rotation by so little that its vector is twice the quaternion's.
        turned = self.held @ self.before.inverse()
        qx, qy, qz, qw = turned.quaternion_xyzw
        scale = (2.0 if qw > 0.0 else -2.0) / self.span_s
        return (x, y, z), (qx * scale, qy * scale, qz * scale)


class HandWatch:
    """Looks into the hand now and then, and remembers what it saw last."""

    def __init__(self, world: World) -> None:
        """Take the first look.

        Args:
            world: The world that is stepped.
        """
        self._world = world
        self._at = 0
        self._held, self._travel_m = self._look()
        self._earlier = (0, self._held, self._travel_m)
        self._motion: HandMotion | None = None

    @property
    def held(self) -> Pose:
        """Transform of the object to the grasp centre at the last look."""
        return self._held

    @property
    def motion(self) -> HandMotion:
        """What happened between the last two looks; nothing, before the second."""
        if self._motion is None:
            then, before, travelled_m = self._earlier
            span_s = (self._at - then) * self._world.settings.step_s
            if span_s > 0.0:
                closing = tuple((now - old) / span_s for now, old in zip(self._travel_m, travelled_m, strict=True))
                self._motion = HandMotion(before, self._held, closing, span_s)
            else:
                still = (0.0,) * len(self._travel_m)
                self._motion = HandMotion(self._held, self._held, still, self._world.settings.step_s)
        return self._motion

    def look(self, steps: int) -> Pose:
        """Look again.

        Args:
            steps: Steps since the first look.

        Returns:
            Transform of the object to the grasp centre now.
        """
        if steps == self._at:
            return self._held
        # What follows from two looks is worked out only if it is asked for.
        self._earlier, self._motion = (self._at, self._held, self._travel_m), None
        self._at = steps
        self._held, self._travel_m = self._look()
        return self._held

    def _look(self) -> tuple[Pose, tuple[float, ...]]:
        world = self._world
        return world.workpiece_pose().seen_from(world.tool_pose()), world.finger_travel_m()
