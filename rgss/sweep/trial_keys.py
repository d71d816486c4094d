"""Keys of trials in the store, and the digests of their pieces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rgss.evidence import trial_key
from rgss.sweep.task_queue import Trial
from rgss.trials.code import versions
from rgss.trials.pieces import TrialSpec, digests_of, require_search


def key_of(spec: TrialSpec) -> str:
    """Key of a trial in the store: the digest of its inputs, the versions, and its variant."""
    return _trial(spec, versions()).key


def keys_of(specs: Sequence[TrialSpec]) -> tuple[str, ...]:
    """Keys of trials in the store; the versions, which take longer to find than a key, are found once."""
    found = versions() if specs else {}
    return tuple(_trial(spec, found).key for spec in specs)


def trials_of(specs: Sequence[TrialSpec]) -> tuple[Trial, ...]:
    """The trials with their keys and digests, each once.

    Raises:
        DefinitionError: A planning limit is longer than the search.
    """
    found = versions()
    for spec in specs:
        require_search(spec)
    return tuple({trial.key: trial for trial in (_trial(spec, found) for spec in specs)}.values())


def _trial(spec: TrialSpec, found: Mapping[str, str]) -> Trial:
    digests = digests_of(spec, found)
    key = trial_key({"trial": digests.trial, "variant": spec.variant})
    return Trial(key=key, spec=spec, digests=digests)
