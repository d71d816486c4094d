"""From a project to the trials of its study."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rgss.designs import DesignVariant
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.physics import PhysicsSettings
from rgss.scenes import Gripper, at_object
from rgss.scenes.uncertainty import NOTHING_UNCERTAIN
from rgss.studies.design_settings import GRIPPER, MOUNTING, PLANNER, TIME_LIMIT, default_values
from rgss.studies.project import Project
from rgss.studies.trial_values import mounted, values_of, with_values
from rgss.trials import ControlMode, TrialSettings
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
        DefinitionError: A variant's parameters or components do not make a trial.
    """
    chosen = project.designs.expand() if variants is None else tuple(variants)
    settings = trial_settings(project)
    own_seeds = project.study.seeds if seeds is None else seeds
    specs = (_spec(project, variant, settings) for variant in chosen)
    return tuple(replace(spec, seed=seed) for spec in specs for seed in own_seeds)


def trial_settings(project: Project) -> TrialSettings:
    """Settings of the study's trials; searches are as long as the longest limit of any design."""
    study = project.study
    return TrialSettings(
        planning=replace(study.planning.settings, search_limit_s=_longest_limit(project)),
        physics=study.physics
        or PhysicsSettings(
            rate_hz=study.rate_hz,
            solver_iterations=study.solver_iterations,
            free_iterations=study.solver_iterations,
            pad_stiffness_n_m=study.pads.stiffness_n_m,
            pad_retardation_s=study.pads.retardation_s,
        ),
        timing=study.motion.timing,
        controller=study.motion.controller,
        control=study.motion.thresholds,
    )


def _longest_limit(project: Project) -> float:
    designs = project.designs
    defaults = default_values(project.scene.robot, project.study.planning)
    limits = [values_of(variant, defaults).get(TIME_LIMIT) for variant in designs.expand()]
    # A sample that grows must not make the searches longer, which would plan all anew.
    setting = {parameter.id for parameter in designs.parameters if parameter.sets == TIME_LIMIT}
    spans = (factor.span for factor in designs.factors if factor.span is not None)
    limits += [span.high for span in spans if span.parameter in setting]
    return max(limit for limit in limits if isinstance(limit, (int, float)))


def _spec(project: Project, variant: DesignVariant, settings: TrialSettings) -> TrialSpec:
    component = variant.components[GRIPPER]
    if not component.geometry:
        raise DefinitionError(
            f"component {component.id!r} names no geometry", hint="give it the file of its shape in the catalogue"
        )
    file, scene = project.grippers[component.geometry], project.scene_of(variant)
    values = values_of(variant, {**default_values(scene.robot, project.study.planning), **file.settings})
    spec = TrialSpec(
        variant=variant.id,
        seed=project.study.seed,
        fidelity=Fidelity(project.study.fidelity),
        # What of its uncertainty counts is in the trial's own.
        scene=replace(scene, uncertainty=NOTHING_UNCERTAIN),
        gripper=Gripper(
            geometry=at_object(mounted(file, values.get(MOUNTING), variant.id), scene),
            base_mass_kg=math.nan,
            finger_mass_kg=math.nan,
            finger_velocity_m_s=math.nan,
            finger_force_n=math.nan,
            friction=math.nan,
            drive=file.drive,
            suction=file.suction,
        ),
        planner="",
        planning_limit_s=math.nan,
        tool_speed_m_s=math.nan,
        settings=settings,
        uncertainty=project.uncertainty,
        workload=project.workload,
        task=project.study.task,
    )
    planner = values.get(PLANNER)
    if isinstance(planner, str):
        spec = replace(spec, planner_settings=project.study.planning.planner_settings(planner))
    return _with_calibration(with_values(spec, values))


def _with_calibration(spec: TrialSpec) -> TrialSpec:
    """The trial with the robot's calibration where its control needs it, and nowhere else, as it is an input."""
    controller = spec.settings.controller
    if controller.mode is not ControlMode.CALIBRATED:
        return spec
    controller = replace(controller, calibration=spec.scene.robot.calibration)
    return replace(spec, settings=replace(spec.settings, controller=controller))
