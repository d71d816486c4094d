"""From a project to the trials of its study."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rgss.designs import Component, DesignVariant
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.motion import ClockKind, PlanningClock
from rgss.physics import PhysicsSettings
from rgss.scenes import Gripper, GripperGeometry
from rgss.studies.project import Project
from rgss.studies.task_parameters import (
    BASE_MASS,
    FINGER_ACTUATOR,
    FINGER_FORCE,
    FINGER_MASS,
    FINGER_VELOCITY,
    FINGERS,
    FRICTION,
    GRIPPER,
    PLANNER,
    PLANNING_LIMIT,
    TOOL_SPEED,
)
from rgss.trials import PlanningSettings, TrialSettings
from rgss.trials.pieces import TrialSpec


def trial_specs(
    project: Project, *, variants: Iterable[DesignVariant] | None = None, seeds: Sequence[int] | None = None
) -> tuple[TrialSpec, ...]:
    """The trials of a study: every variant with every seed, variants outermost.

    Args:
        project: The project with its study.
        variants: Those to try; all by default.
        seeds: The seeds; the study's by default.

    Raises:
        DefinitionError: A variant's parameters or components do not make a gripper.
    """
    chosen = project.designs.expand() if variants is None else tuple(variants)
    settings = trial_settings(project)
    return tuple(
        _spec(project, variant, seed, settings)
        for variant in chosen
        for seed in (project.study.seeds if seeds is None else seeds)
    )


def trial_settings(project: Project) -> TrialSettings:
    """How the study plans and simulates; searches are as long as the longest limit of any design."""
    study = project.study
    limits = [_number(variant, PLANNING_LIMIT) for variant in project.designs.expand()]
    # A sample that grows must not make the searches longer, which would plan all anew.
    spans = [factor.span for factor in project.designs.factors if factor.span is not None]
    limits += [span.high for span in spans if span.parameter == PLANNING_LIMIT]
    return TrialSettings(
        planning=PlanningSettings(
            clock=PlanningClock(
                kind=ClockKind.COUNTED if study.planning.counted else ClockKind.WALL,
                charge_s=study.planning.charge_per_check_s,
            ),
            search_limit_s=max(limits),
            resolution_rad=study.planning.resolution_rad,
            simplification_checks=study.planning.simplification_checks,
            simplification_limit_s=study.planning.simplification_limit_s,
            clearance_m=study.planning.clearance_m,
        ),
        physics=PhysicsSettings(rate_hz=study.rate_hz, solver_iterations=study.solver_iterations),
    )


def _spec(project: Project, variant: DesignVariant, seed: int, settings: TrialSettings) -> TrialSpec:
    return TrialSpec(
        variant=variant.id,
        seed=seed,
        fidelity=Fidelity(project.study.fidelity),
        scene=project.scene,
        gripper=_gripper(project, variant),
        planner=str(variant.parameters[PLANNER]),
        planning_limit_s=_number(variant, PLANNING_LIMIT),
        tool_speed_m_s=_number(variant, TOOL_SPEED),
        settings=settings,
    )


def _gripper(project: Project, variant: DesignVariant) -> Gripper:
    component = variant.components[GRIPPER]
    geometry = _geometry(project, component)
    fingers = _number(variant, FINGERS)
    if geometry.fingers != fingers:
        raise DefinitionError(
            f"component {component.id!r} is for {fingers:g} fingers but {component.geometry} has {geometry.fingers}",
            hint="match the component to the number of azimuths in its file",
        )
    actuator = variant.components[FINGER_ACTUATOR].mass_kg or 0.0
    return Gripper(
        geometry=geometry,
        base_mass_kg=_number(variant, BASE_MASS) + geometry.fingers * actuator,
        finger_mass_kg=_number(variant, FINGER_MASS),
        finger_velocity_m_s=_number(variant, FINGER_VELOCITY),
        finger_force_n=_number(variant, FINGER_FORCE),
        friction=_number(variant, FRICTION),
    )


def _geometry(project: Project, component: Component) -> GripperGeometry:
    if not component.geometry:
        raise DefinitionError(
            f"component {component.id!r} names no geometry", hint="give it the file of its shape in the catalogue"
        )
    return project.grippers[component.geometry]


def _number(variant: DesignVariant, parameter: str) -> float:
    value = variant.parameters.get(parameter)
    if value is None or isinstance(value, str):
        raise DefinitionError(
            f"variant {variant.id} has no number for design parameter {parameter!r}",
            hint="the task needs d1 to d9 as the reference design space has them",
        )
    return value
