"""Monitor of the grasp while the object is carried: sampled at a fixed rate, with the worst values."""

from __future__ import annotations

import math

from rgss.evidence import Metric
from rgss.grasping import GraspGeometryCache
from rgss.physics import ContactWorld
from rgss.scenes import Pose
from rgss.trials.monitors.grasp_record import grasp_metrics, worst_of
from rgss.trials.monitors.in_hand_motion import InHandMotionTracker
from rgss.trials.plants import ControlSettings


class GraspMonitor:
    """Monitor of the object in the hand, with periodic analyses of the grasp.

    It also counts the samples in force closure.

    Attributes:
        slip_m: Greatest displacement of the object in the hand since the grasp.
    """

    def __init__(
        self, world: ContactWorld, control: ControlSettings, held_at: Pose, memory: GraspGeometryCache
    ) -> None:
        """Take the first sample.

        Args:
            world: The world.
            control: Rates of pose samples and of grasp analyses.
            held_at: Transform of the object to the grasp-centre frame at the grasp.
            memory: Cache of the grasp analysis between samples.
        """
        self.slip_m = 0.0
        self._world = world
        self._held_at = held_at
        self._memory = memory
        self._hand = InHandMotionTracker(world)
        rate_hz = world.settings.rate_hz
        self._look_every = max(1, round(rate_hz / control.observation_rate_hz))
        looks = max(1, round(control.observation_rate_hz / control.grasp_rate_hz))
        self._sample_every = looks * self._look_every
        self._steps = self._sampled_at = 0
        self._samples: list[dict[str, Metric]] = []

    def after_step(self) -> float | None:
        """Take a sample, if due.

        Returns:
            Displacement of the object in the hand since the grasp (m); None without a sample.
        """
        self._steps += 1
        if self._steps % self._look_every:
            return None
        slip = self._look()
        if self._steps % self._sample_every == 0:
            self._sample(strength=False)
        return slip

    def finish(self) -> float:
        """Take a sample and analyse the grasp at the end of the phase.

        Returns:
            Displacement of the object in the hand since the grasp (m).
        """
        slip = self._look()
        if self._sampled_at == self._steps and self._samples:
            self._samples.pop()
        self._sample(strength=True)
        return slip

    def metrics(self) -> dict[str, Metric]:
        """Worst value of each metric over the phase, and the number of analysed samples."""
        analysed = [sample for sample in self._samples if "grasp_force_closure" in sample]
        return {
            **worst_of(self._samples),
            "grasp_samples": len(analysed),
            "grasp_samples_closed": sum(1 for sample in analysed if sample["grasp_force_closure"]),
        }

    def _look(self) -> float:
        slip = math.dist(self._hand.look(self._steps).held_at_m, self._held_at.position_m)
        self.slip_m = max(self.slip_m, slip)
        return slip

    def _sample(self, *, strength: bool) -> None:
        self._sampled_at = self._steps
        self._samples.append(
            grasp_metrics(self._world, self._hand.motion, self._held_at, self._memory, strength=strength)
        )
