"""Followers of an arm in a contact world: each is held on its driven joint by a motor, which loads that joint.

Two properties of the engine's solver are behind this design. Gears, as a linkage has them, converge too slowly for an
arm, and so do motors where two joints turn against each other about a light link, as where a parallelogram keeps a
wrist level: with 1000 iterations a joint lags by 8 mrad. So the efforts that the motors found in a step act as torques
in the next one, which leaves the solver the difference alone; it converges over some steps, as with a warm start. The
effort of a follower acts on its driven joint in the same way, so that the driven joint's motor carries it within its
own limit: one step later than in a rigid coupling. A follower that needs more than its own effort slips.

That converges if no link beside a follower is too light (`steady_light_links`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rgss.physics.light_links import steady_light_links
from rgss.physics.slipping import slipped
from rgss.scenes import Robot

_FOLLOWER_EFFORT = 1.0e5
_MOST_CARRIED = 0.98


class FollowerMotors:
    """Motors of an arm with followers in a physics client; no effect for an arm without."""

    def __init__(
        self,
        engine: Any,
        client: int,
        body: int,
        robot: Robot,
        joints: Mapping[str, int],
        *,
        gain: float,
        step_s: float,
    ) -> None:
        """Look up the joints.

        Args:
            engine: The engine's module.
            client: The physics client.
            body: The robot's body.
            robot: The arm.
            joints: The engine's joint ids by name.
            gain: Share of a joint's position error that its motor removes in a step.
            step_s: Length of a step.
        """
        self._engine, self._client, self._body, self._robot = engine, client, body, robot
        self._followers = [joints[one.name] for one in robot.followers]
        self._driven = [joints[joint.name] for joint in robot.joints]
        self._gain, self._step_s = gain, step_s
        self._limits = [joint.torque_n_m for joint in robot.joints]
        self._limits += [min(one.effort, _FOLLOWER_EFFORT) for one in robot.followers]
        self._carried = [0.0] * len(self._limits)
        if self._followers:
            steady_light_links(engine, client, body, robot, joints)

    def reset(self, driven: Sequence[float]) -> None:
        """Put the followers at rest where the driven joints put them.

        Args:
            driven: Positions of the driven joints in rad or m, shape (n,).
        """
        for joint, position in zip(self._followers, self._robot.follower_positions(driven), strict=True):
            self._engine.resetJointState(self._body, joint, position, 0.0, physicsClientId=self._client)
        self._carried = [0.0] * len(self._limits)

    def command(self, positions: Sequence[float], velocities: Sequence[float]) -> None:
        """Move driven joints and followers in the next step.

        Args:
            positions: Target positions of the driven joints, shape (n,).
            velocities: Their target velocities, shape (n,).
        """
        engine, followers = self._engine, self._robot.followers
        joints = (*self._driven, *self._followers)
        states = engine.getJointStates(self._body, joints, self._client)
        driven = [state[0] for state in states[: len(self._driven)]]
        found = self._efforts(states)
        self._carried = [
            max(-_MOST_CARRIED * limit, min(_MOST_CARRIED * limit, effort))
            for effort, limit in zip(found, self._limits, strict=True)
        ]
        # The velocity with which the motor of a driven joint moves it.
        moved = [
            velocity + self._gain * (target - position) / self._step_s
            for velocity, target, position in zip(velocities, positions, driven, strict=True)
        ]
        engine.setJointMotorControlArray(
            self._body,
            joints,
            engine.POSITION_CONTROL,
            (*positions, *self._robot.follower_positions(driven)),
            (*velocities, *(one.multiplier * moved[one.driver] for one in followers)),
            [limit - abs(carried) for limit, carried in zip(self._limits, self._carried, strict=True)],
            [self._gain] * len(joints),
            [1.0] * len(joints),
            self._client,
        )
        loads = list(self._carried)
        for one, effort in zip(followers, found[len(driven) :], strict=True):
            loads[one.driver] -= one.multiplier * effort
        engine.setJointMotorControlArray(
            self._body, joints, engine.TORQUE_CONTROL, forces=loads, physicsClientId=self._client
        )

    def driven_efforts(self, motors: Sequence[float]) -> tuple[float, ...]:
        """Efforts of the driven joints in N·m or N in the last step, with what they transmit to followers.

        Args:
            motors: What the engine reports of their motors, shape (n,).
        """
        return tuple(own + motor for own, motor in zip(self._carried, motors, strict=False))

    @property
    def slipped(self) -> str:
        """Name of a follower whose coupling has given way; empty if none has."""
        states = self._engine.getJointStates(self._body, (*self._driven, *self._followers), self._client)
        positions, count = [state[0] for state in states], len(self._driven)
        return slipped(self._robot, positions[:count], positions[count:])

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a follower from where its driven joint puts it, in rad or m; 0 without followers."""
        if not self._followers:
            return 0.0
        driven = [state[0] for state in self._engine.getJointStates(self._body, self._driven, self._client)]
        states = self._engine.getJointStates(self._body, self._followers, self._client)
        wanted = self._robot.follower_positions(driven)
        return max(abs(float(state[0]) - at) for state, at in zip(states, wanted, strict=True))

    def _efforts(self, states: Sequence[Sequence[float]]) -> list[float]:
        """Efforts of driven joints and followers in the last step."""
        return [carried + state[3] for carried, state in zip(self._carried, states, strict=True)]
