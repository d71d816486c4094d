"""Confirmation: results of the same trials under each setting, and their differences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.assessment import IN_COMMON
from rgss.confirmation.selection import Selection
from rgss.confirmation.settings import Aspect, ConfirmationSetting
from rgss.evidence import Metric, TrialRecord
from rgss.measures import Verdict
from rgss.tradeoff import DecisionStatus

COMPARED_METRICS = (
    "slip_m",
    "place_error_m",
    "sensed_finger_force_n",
    "peak_finger_force_n",
    "grip_margin_min",
    "peak_joint_torque_ratio",
    "tracking_error_m",
    "grasp_cycle_time_s",
    "motion_time_s",
    "task_time_s",
    "bench_payload_kg",
)
"""Metrics of a trial that depend on physics and that requirements use."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfirmedTrial:
    """One trial under every setting.

    Attributes:
        variant: The design.
        seed: The seed.
        is_sample: True if it is one of the sampled failures, which take no part in the decision.
        records: Its record under each setting, in the order of the settings.
    """

    variant: int
    seed: int
    is_sample: bool
    records: tuple[TrialRecord, ...]

    def outcome(self, setting: int) -> str:
        """Outcome: ``success``, or failure and phase, such as ``object_dropped at lift``."""
        record = self.records[setting]
        if record.failure is None:
            return "success" if record.success else "incomplete"
        phase = record.failed_phase
        return record.failure.value if phase is None else f"{record.failure.value} at {phase}"

    @property
    def differing(self) -> tuple[int, ...]:
        """Indices of the settings whose outcome is not the study's."""
        return tuple(index for index in range(1, len(self.records)) if self.outcome(index) != self.outcome(0))

    def metric(self, name: str, setting: int) -> float | None:
        """A metric of the trial; None if it was not observed."""
        value: Metric = self.records[setting].metrics.get(name)
        return float(value) if isinstance(value, (int, float)) else None


@dataclass(frozen=True, slots=True, kw_only=True)
class SettingResult:
    """Result of the confirmed designs under one setting.

    Attributes:
        setting: The setting.
        status: Status of the choice.
        ranking: The designs that are feasible by their estimates, best first, each with its value.
        ties: The designs that are equally good as the first.
        verdicts: The verdict on each requirement, by design.
    """

    setting: ConfirmationSetting
    status: DecisionStatus
    ranking: tuple[tuple[int, float | None], ...]
    ties: tuple[int, ...]
    verdicts: Mapping[int, Mapping[str, Verdict]] = field(hash=False)

    @property
    def first(self) -> int | None:
        """The design that comes first; None if none is feasible."""
        return self.ranking[0][0] if self.ranking else None


@dataclass(frozen=True, slots=True, kw_only=True)
class VerdictDifference:
    """Verdict that differs from that under the study's setting.

    Attributes:
        variant: The design.
        requirement: The requirement.
        setting: Index of the setting.
        study: The verdict under the study's setting.
        other: The verdict under the other.
    """

    variant: int
    requirement: str
    setting: int
    study: Verdict
    other: Verdict


@dataclass(frozen=True, slots=True, kw_only=True)
class Confirmation:
    """A decision under several physics settings.

    Attributes:
        study: The study's id.
        evidence: Name of the evidence in messages.
        selection: The confirmed designs and trials.
        seeds: The seeds of the confirmed designs.
        practical_margin: Differences in value below this are of no practical meaning.
        results: One for each setting, the study's own first.
        trials: Every trial under every setting.
        made: Number of trials that were run now; the others came from evidence.
        designs: Number of designs of the study.
        arm_is_pybullet: Whether the arm moves by its dynamics in PyBullet under every setting (``control.in_contact``).
    """

    study: str
    evidence: str
    selection: Selection
    seeds: tuple[int, ...]
    practical_margin: float
    results: tuple[SettingResult, ...]
    trials: tuple[ConfirmedTrial, ...]
    made: int
    designs: int
    arm_is_pybullet: bool = False

    @property
    def differing_trials(self) -> tuple[ConfirmedTrial, ...]:
        """The trials whose outcome depends on the setting."""
        return tuple(trial for trial in self.trials if trial.differing)

    @property
    def before_physics(self) -> int:
        """Number of trials of the confirmed designs that end before physics, which are the same under every setting."""
        return sum(trial.records[0].failure in IN_COMMON for trial in self.trials if not trial.is_sample)

    @property
    def reference(self) -> int | None:
        """The design whose place is compared: the study's choice, if no other is better by these seeds.

        The study may decide by more seeds than are confirmed, so that another design may come first by these. None if
        no design is feasible under the study's setting.
        """
        chosen, own = self.selection.chosen, self.results[0]
        return chosen if chosen is not None and self.is_as_good(chosen, own) else own.first

    @property
    def differing_decisions(self) -> tuple[int, ...]:
        """Indices of the settings under which the reference is not as good as any other design.

        It is as good if it is the first there, tied with that, or worse than it by no more than the practical margin. A
        design that ties with it in the study alone replaces it under the setting only if it is no better there: the
        study's first may even be infeasible under it.
        """
        return tuple(index for index, result in enumerate(self.results) if not self.is_as_good(self.reference, result))

    def is_as_good(self, first: int | None, result: SettingResult) -> bool:
        """True if a design loses no more than the practical margin under a setting.

        Args:
            first: The design; None if there is none, which is as good where none is feasible.
            result: The result under the setting.
        """
        values = dict(result.ranking)
        if first == result.first or (first in values and first in result.ties):
            return True
        best = None if result.first is None else values[result.first]
        own = None if first is None else values.get(first)
        return best is not None and own is not None and best - own <= self.practical_margin

    @property
    def differing_verdicts(self) -> tuple[VerdictDifference, ...]:
        """The verdicts that depend on the setting."""
        study = self.results[0].verdicts
        return tuple(
            VerdictDifference(
                variant=variant,
                requirement=requirement,
                setting=index,
                study=study[variant][requirement],
                other=verdict,
            )
            for index, result in enumerate(self.results)
            for variant, verdicts in result.verdicts.items()
            for requirement, verdict in verdicts.items()
            if verdict is not study[variant][requirement]
        )

    @property
    def holds(self) -> bool:
        """True if the decision and every verdict are the same under all settings."""
        return not self.differing_decisions and not self.differing_verdicts

    @property
    def aspects(self) -> tuple[Aspect, ...]:
        """Aspects that were varied."""
        return tuple(result.setting.aspect for result in self.results[1:])

    def largest_difference(self, metric: str, setting: int) -> float | None:
        """Greatest difference of a metric from the study's setting, over trials whose outcome is the same.

        Returns:
            The difference in magnitude; None if no trial has the metric under both.
        """
        pairs = [(trial.metric(metric, 0), trial.metric(metric, setting)) for trial in self._alike(setting)]
        found = [abs(one - other) for one, other in pairs if one is not None and other is not None]
        return max(found, default=None)

    def extreme(self, metric: str, setting: int) -> tuple[float, float] | None:
        """Least and greatest value of a metric under a setting; None if no trial has it."""
        found = [value for trial in self.trials if (value := trial.metric(metric, setting)) is not None]
        return (min(found), max(found)) if found else None

    def _alike(self, setting: int) -> tuple[ConfirmedTrial, ...]:
        return tuple(trial for trial in self.trials if setting not in trial.differing)
