"""Stored trials of confirmations, which differ from a study's trials only in the physics settings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rgss.documents import digest
from rgss.evidence import EvidenceStore
from rgss.studies import MOST_REPLICATES, Project, named_inputs, trial_specs

_SETTINGS, _PHYSICS = "settings", "physics"


def confirmation_trials(projects: Iterable[Project], store: EvidenceStore) -> frozenset[str]:
    """Keys of the trials whose inputs differ from those of a study's trial only in the physics settings.

    Trials of another state of the project or of the code are excluded.

    Raises:
        EvidenceError: The store is damaged.
        DefinitionError: A variant's parameters or components are incomplete.
    """
    expected = {
        (spec.variant, _without_physics(named_inputs(spec).values)): project.study.seed
        for project in projects
        for each in (project, project.nominal())
        for spec in trial_specs(each, seeds=each.study.seeds[:1])
    }
    digests: dict[str, str] = {}
    found = set()
    for trial in store.iterate():
        known_by = trial.provenance.inputs_digest
        if known_by and known_by not in digests:
            values = store.inputs(known_by)
            digests[known_by] = "" if values is None else _without_physics(values)
        first = expected.get((trial.record.variant, digests.get(known_by, "")))
        if first is not None and 0 <= trial.record.seed - first < MOST_REPLICATES:
            found.add(trial.key)
    return frozenset(found)


def _without_physics(inputs: Mapping[str, Any]) -> str:
    settings = {name: value for name, value in inputs[_SETTINGS].items() if name != _PHYSICS}
    # Trials do not depend on the name of the scene.
    scene = {name: value for name, value in inputs["scene"].items() if name != "id"}
    return digest({**inputs, _SETTINGS: settings, "scene": scene})
