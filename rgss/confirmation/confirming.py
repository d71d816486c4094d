"""Execution of the trials of a confirmation, and the decision under each setting."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from rgss.assessment import measure_variants
from rgss.confirmation.confirmation import Confirmation, ConfirmedTrial, SettingResult
from rgss.confirmation.selection import Selection
from rgss.confirmation.settings import ConfirmationSetting
from rgss.decision import choose
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore
from rgss.studies import Project, trial_specs
from rgss.sweep import keys_of
from rgss.trials.pieces import TrialSpec

RunTrials = Callable[[Sequence[TrialSpec]], int]
"""Function that runs missing trials, and returns their number."""


def confirm(
    project: Project,
    store: EvidenceStore,
    selection: Selection,
    settings: Sequence[ConfirmationSetting],
    run: RunTrials,
    *,
    seeds: int,
    evidence: str,
) -> Confirmation:
    """Run designs and failures under every setting, and decide among the designs by each.

    Plans and timings are shared by all settings, since they do not depend on physics. A trial under another setting
    has another key, so that the study's decision never uses it.

    Args:
        project: The project with its study.
        store: The evidence.
        selection: The designs, and the failures.
        settings: The settings, the study's own first.
        run: Function that runs trials.
        seeds: Number of seeds of each design, from the study's first.
        evidence: Name of the evidence in messages.

    Raises:
        EvidenceError: Trials could not be run, or the store is damaged.
        TradeoffError: The choice is ill posed.
        DefinitionError: A measure is not defined for a design.
    """
    study = replace(
        project.study,
        replicates=seeds,
        is_sequential=False,
        screening=None,
        # A few designs make no full table of levels.
        trade_off=replace(project.study.trade_off, choose_levels=False),
    )
    base = replace(project, study=study)
    projects = [setting.of(base) for setting in settings]
    wanted = [_specs(one, selection) for one in projects]
    made = run([spec for specs in wanted for spec in specs])
    trials = _confirmed(selection, wanted, store)
    return Confirmation(
        study=project.study.id,
        evidence=evidence,
        selection=selection,
        seeds=study.seeds,
        practical_margin=project.study.trade_off.practical_margin,
        results=tuple(
            _decided(one, store, selection, setting) for one, setting in zip(projects, settings, strict=True)
        ),
        trials=trials,
        made=made,
        designs=len(project.designs.expand()),
        arm_is_pybullet=study.motion.controller.in_contact,
    )


def _specs(project: Project, selection: Selection) -> tuple[TrialSpec, ...]:
    """The trials of the designs, followed by those of the sample."""
    sample = [
        spec
        for variant, seed in selection.sample
        for spec in trial_specs(project, variants=[project.designs.variant(variant)], seeds=[seed])
    ]
    return (*trial_specs(project, variants=selection.variants), *sample)


def _confirmed(
    selection: Selection, wanted: Sequence[Sequence[TrialSpec]], store: EvidenceStore
) -> tuple[ConfirmedTrial, ...]:
    keys = [keys_of(specs) for specs in wanted]
    found = store.records([key for row in keys for key in row])
    for row, specs in zip(keys, wanted, strict=True):
        for key, spec in zip(row, specs, strict=True):
            if key not in found:
                raise EvidenceError(
                    f"the trial of variant {spec.variant} with seed {spec.seed} could not be run",
                    hint="see what failed, then run it again",
                )
    designs = len(wanted[0]) - len(selection.sample)
    return tuple(
        ConfirmedTrial(
            variant=spec.variant,
            seed=spec.seed,
            is_sample=index >= designs,
            records=tuple(found[row[index]] for row in keys),
        )
        for index, spec in enumerate(wanted[0])
    )


def _decided(
    project: Project, store: EvidenceStore, selection: Selection, setting: ConfirmationSetting
) -> SettingResult:
    measured = measure_variants(project, store, among=selection.variants)
    decision = choose(project, measured)
    return SettingResult(
        setting=setting,
        status=decision.status,
        ranking=tuple((one.variant, one.value) for one in decision.ranking),
        ties=decision.ties,
        verdicts={entry.variant.id: dict(entry.verdicts) for entry in measured},
    )
