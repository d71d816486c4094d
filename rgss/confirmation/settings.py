"""Physics settings under which a decision is confirmed."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from enum import Enum

from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.physics import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ, MOST_ITERATIONS, OtherEngineSettings, PhysicsSettings
from rgss.studies import Project, trial_settings
from rgss.trials import mujoco_settings

FINER_RATE_HZ = 1000.0
"""Default rate of the finer step."""

_HIGHEST_RATE_HZ = 20_000.0
_MORE_ITERATIONS = 4


class Engine(str, Enum):
    """An engine of contact physics that can confirm."""

    PYBULLET = "pybullet"
    MUJOCO = "mujoco"


class Aspect(str, Enum):
    """Aspect in which a setting differs from the study's."""

    STUDY = "study"
    STEP = "step"
    ITERATIONS = "iterations"
    ENGINE = "engine"


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfirmationSetting:
    """Physics setting of a trial.

    Attributes:
        aspect: Aspect in which it differs from the study's own setting.
        physics: The settings.
    """

    aspect: Aspect
    physics: PhysicsSettings

    @property
    def label(self) -> str:
        """Engine, rate and iterations, such as ``PyBullet 240 Hz, 20 iterations``."""
        physics = self.physics
        if isinstance(physics, OtherEngineSettings):
            return f"MuJoCo {physics.version}, {physics.rate_hz:g} Hz"
        return f"PyBullet {physics.rate_hz:g} Hz, {physics.solver_iterations} iterations"

    def of(self, project: Project) -> Project:
        """A project with these settings in place of its study's.

        Args:
            project: The project.
        """
        return replace(project, study=replace(project.study, physics=self.physics))


def confirmation_settings(
    project: Project,
    *,
    engines: Collection[Engine] = tuple(Engine),
    rate_hz: float | None = None,
    iterations: int | None = None,
) -> tuple[ConfirmationSetting, ...]:
    """The study's own setting, and those that confirm it; each differs from the study's in one aspect.

    Args:
        project: The project with its study.
        engines: The engines that confirm.
        rate_hz: Rate of the finer step; `FINER_RATE_HZ` by default.
        iterations: The greater number of solver iterations; four times the study's by default.

    Raises:
        DefinitionError: The study's fidelity is not contact, a number is impossible or equal to that of the study, or
            MuJoCo is requested and not installed.
    """
    if project.study.fidelity is not Fidelity.CONTACT:
        raise DefinitionError(
            f"a decision by {project.study.fidelity.value} trials has no contact physics to confirm",
            hint="choose a study with 'fidelity: contact'",
        )
    own = trial_settings(project).physics
    found = [ConfirmationSetting(aspect=Aspect.STUDY, physics=own)]
    if Engine.PYBULLET in engines:
        finer = replace(own, rate_hz=max(FINER_RATE_HZ, 2 * own.rate_hz) if rate_hz is None else rate_hz)
        more = own.with_iterations(
            min(MOST_ITERATIONS, _MORE_ITERATIONS * own.solver_iterations) if iterations is None else iterations
        )
        _check(own, finer, more)
        found.append(ConfirmationSetting(aspect=Aspect.STEP, physics=finer))
        found.append(ConfirmationSetting(aspect=Aspect.ITERATIONS, physics=more))
    if Engine.MUJOCO in engines:
        found.append(ConfirmationSetting(aspect=Aspect.ENGINE, physics=mujoco_settings()))
    return tuple(found)


def _check(own: PhysicsSettings, finer: PhysicsSettings, more: PhysicsSettings) -> None:
    if finer.rate_hz == own.rate_hz:
        raise DefinitionError(
            f"the finer rate must differ from that of the study, {own.rate_hz:g} Hz", hint="give another rate"
        )
    if not LEAST_RATE_HZ <= finer.rate_hz <= _HIGHEST_RATE_HZ:
        raise DefinitionError(
            f"the rate must be from {LEAST_RATE_HZ:g} to {_HIGHEST_RATE_HZ:g} Hz, got {finer.rate_hz:g} Hz",
            hint='write "1000 Hz"',
        )
    if more.solver_iterations == own.solver_iterations:
        raise DefinitionError(
            f"the number of solver iterations must differ from that of the study, {own.solver_iterations}",
            hint="give another number",
        )
    if not 1 <= more.solver_iterations <= MOST_ITERATIONS:
        raise DefinitionError(
            f"the number of solver iterations must be from 1 to {MOST_ITERATIONS}, got {more.solver_iterations}"
        )
    for one in (finer, more):
        if one.rate_hz * one.solver_iterations < LEAST_ITERATIONS_HZ:
            raise DefinitionError(
                f"{one.solver_iterations} iterations at {one.rate_hz:g} Hz are too few to hold an object",
                hint=f"rate times iterations must be {LEAST_ITERATIONS_HZ:g} Hz or more",
            )
