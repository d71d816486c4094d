"""Settings under which the selected designs can be simulated."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rgss.confirmation.selection import Selection
from rgss.confirmation.settings import Aspect, ConfirmationSetting
from rgss.errors import DefinitionError
from rgss.studies import Project, trial_specs


def supported_settings(
    project: Project, selection: Selection, settings: Sequence[ConfirmationSetting], *, is_named: bool
) -> tuple[Selection, tuple[ConfirmationSetting, ...]]:
    """The selection and the settings, without MuJoCo if a selected design has a gripper that it does not simulate.

    Failures of other designs with such a gripper leave the sample instead.

    Args:
        project: The project with its study.
        selection: The designs and failures.
        settings: The settings, the study's own first.
        is_named: True if the engines were named, so that none may be omitted.

    Raises:
        DefinitionError: A named engine does not simulate a design.
    """
    if not any(one.aspect is Aspect.ENGINE for one in settings):
        return selection, tuple(settings)
    unsupported = {variant.id: _unsupported_part(project, variant.id) for variant in selection.variants}
    unsupported = {variant: part for variant, part in unsupported.items() if part}
    if not unsupported:
        sample = tuple(one for one in selection.sample if not _unsupported_part(project, one[0]))
        return replace(selection, sample=sample), tuple(settings)
    designs = "variant" if len(unsupported) == 1 else "variants"
    named = f"{designs} {', '.join(map(str, unsupported))}: {' and '.join(dict.fromkeys(unsupported.values()))}"
    if is_named:
        raise DefinitionError(
            f"MuJoCo does not simulate {named}",
            hint="name other designs with --variants, or confirm with --engine pybullet",
        )
    kept = tuple(one for one in settings if one.aspect is not Aspect.ENGINE)
    return replace(selection, without_engine=f"MuJoCo does not simulate {named}"), kept


def _unsupported_part(project: Project, variant: int) -> str:
    """Part of a design that MuJoCo does not simulate; empty if it simulates all."""
    (spec,) = trial_specs(project, variants=[project.designs.variant(variant)], seeds=[project.study.seed])
    if spec.gripper.suction is not None:
        return f"the suction cup of {spec.gripper.geometry.id}"
    return f"the linkage of {spec.gripper.geometry.id}" if spec.gripper.geometry.linkage is not None else ""
