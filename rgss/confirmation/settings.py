"""Physics settings under which a decision is confirmed."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from enum import Enum

from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.physics import (
    LEAST_RATE_HZ,
    MOST_ITERATIONS,
    OtherEngineSettings,
    PhysicsSettings,
    least_iterations,
)
from rgss.studies import Project, trial_settings
from rgss.trials import mujoco_settings

FINER_RATE_HZ = 1000.0
"""Default rate of the finer step."""

_HIGHEST_RATE_HZ = 20_000.0
_MORE_ITERATIONS = 4
_MORE_THAN_GEARS = 2


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
        """A project with these settings in place of its study's."""
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
        iterations: The greater number of solver iterations; by default four times the study's, or twice those that the
            gears of its hands need, if that is more.

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
        geared = _iterations_of_gears(project)
        by_default = max(min(MOST_ITERATIONS, _MORE_ITERATIONS * own.solver_iterations), _MORE_THAN_GEARS * geared)
        more = own.with_iterations(by_default if iterations is None else iterations)
        _check(own, finer, more, geared=geared)
        found.append(ConfirmationSetting(aspect=Aspect.STEP, physics=finer))
        found.append(ConfirmationSetting(aspect=Aspect.ITERATIONS, physics=more))
    if Engine.MUJOCO in engines:
        found.append(ConfirmationSetting(aspect=Aspect.ENGINE, physics=mujoco_settings()))
    return tuple(found)


def _iterations_of_gears(project: Project) -> int:
    """Solver iterations that every contact trial with a linkage takes at least; 0 without one."""
    geometries = (one for file in project.grippers.values() for one in file.mountings.values())
    linkages = (geometry.linkage for geometry in geometries)
    return max((least_iterations(linkage) for linkage in linkages if linkage is not None), default=0)


def _check(own: PhysicsSettings, finer: PhysicsSettings, more: PhysicsSettings, *, geared: int) -> None:
    if not LEAST_RATE_HZ <= finer.rate_hz <= _HIGHEST_RATE_HZ:
        raise DefinitionError(
            f"the rate must be from {LEAST_RATE_HZ:g} to {_HIGHEST_RATE_HZ:g} Hz, got {finer.rate_hz:g} Hz",
            hint='write "1000 Hz"',
        )
    if finer.rate_hz <= own.rate_hz:
        raise DefinitionError(
            f"the finer rate must be above that of the study, {own.rate_hz:g} Hz, got {finer.rate_hz:g} Hz",
            hint="give a higher rate: a coarser step confirms nothing",
        )
    most = max(MOST_ITERATIONS, _MORE_THAN_GEARS * geared)
    if not 1 <= more.solver_iterations <= most:
        raise DefinitionError(f"the number of solver iterations must be from 1 to {most}, got {more.solver_iterations}")
    if more.solver_iterations <= own.solver_iterations:
        raise DefinitionError(
            f"the number of solver iterations must be above that of the study, {own.solver_iterations}, got "
            f"{more.solver_iterations}",
            hint="give a greater number",
        )
    if more.solver_iterations <= geared:
        raise DefinitionError(
            f"the number of solver iterations must be above {geared}, which the gears of a hand take anyway, got "
            f"{more.solver_iterations}"
        )
