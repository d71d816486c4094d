"""Replicates that the assessment of a study uses: its own, and those added by replication until decided."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.designs import DesignVariant
from rgss.evidence import EvidenceStore
from rgss.evidence.store import trial_names
from rgss.studies import Project, trial_specs
from rgss.sweep import keys_of
from rgss.trials.pieces import TrialSpec


def read_specs(
    project: Project, store: EvidenceStore | None, variants: Sequence[DesignVariant]
) -> Mapping[int, Mapping[str, TrialSpec]]:
    """Trials of the assessment of a study: for each variant the study's seeds, and those stored after them.

    Seeds beyond the study's replicates are read only if the study states ``until_decided``: as many as are
    stored without a gap, at most the cap of its rule. A trial counts as stored only under the key of the present
    project, code and engines. So the trials depend on the inputs and on the evidence alone, not on the
    order in which it was made.

    Args:
        project: The project with its study.
        store: The evidence; None if there is none yet.
        variants: The variants.

    Returns:
        The trials by key, in the order of their seeds, by variant.

    Raises:
        EvidenceError: The store cannot be read.
        DefinitionError: A variant's parameters or components are incomplete.
    """
    found: dict[int, dict[str, TrialSpec]] = {variant.id: {} for variant in variants}
    own = trial_specs(project, variants=variants)
    for key, spec in zip(keys_of(own), own, strict=True):
        found[spec.variant][key] = spec
    if store is None or not project.study.is_sequential:
        return found
    possible = _possible_specs(project, store, variants)
    there = store.has([key for keys in (*found.values(), *possible.values()) for key in keys])
    for variant, keys in possible.items():
        if not there.issuperset(found[variant]):
            continue
        for key, spec in keys.items():
            if key not in there:
                break
            found[variant][key] = spec
    return found


def _possible_specs(
    project: Project, store: EvidenceStore, variants: Sequence[DesignVariant]
) -> Mapping[int, Mapping[str, TrialSpec]]:
    """Trials after the study's own that are stored in any version, without a gap, by variant."""
    study = project.study
    stored: dict[int, set[int]] = {}
    for name in trial_names(store.database):
        if name.fidelity == study.fidelity.value:
            stored.setdefault(name.variant, set()).add(name.seed)
    alike: dict[int, list[DesignVariant]] = {}
    for variant in variants:
        seeds, count = stored.get(variant.id, set()), study.replicates
        while count < study.until_decided.cap and study.seed + count in seeds:
            count += 1
        alike.setdefault(count, []).append(variant)
    found: dict[int, dict[str, TrialSpec]] = {}
    for count, group in sorted(alike.items()):
        more = range(study.seed + study.replicates, study.seed + count)
        specs = trial_specs(project, variants=group, seeds=more)
        for key, spec in zip(keys_of(specs), specs, strict=True):
            found.setdefault(spec.variant, {})[key] = spec
    return found
