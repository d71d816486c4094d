"""Running a stored trial again, to see whether it gives the same bits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, StoredTrial, TrialRecord, record_digest
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project
from rgss.trials.run import run_trial
from rgss.trials.spec import TrialSpec, digests_of, plain
from rgss.trials.versions import versions

_SHORTEST_PREFIX = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Something that differs between then and now.

    Attributes:
        name: What it is.
        then: What it was, as text.
        now: What it is.
    """

    name: str
    then: str
    now: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Replay:
    """A stored trial and what came of running it again.

    Attributes:
        stored: The trial as it is stored.
        record: The record of the new run.
        versions: Versions of code and engines that differ.
        inputs: Pieces whose inputs differ beyond the versions, such as ``plan``.
        differences: Where the records differ, in their order; empty if every bit is the same.
    """

    stored: StoredTrial
    record: TrialRecord
    versions: tuple[Change, ...]
    inputs: tuple[str, ...]
    differences: tuple[Change, ...]

    @property
    def same(self) -> bool:
        """Whether the new record is bit for bit the stored one."""
        return not self.differences


def find_trial(project: Project, store: EvidenceStore, name: str) -> StoredTrial:
    """The stored trial with a name.

    Args:
        project: The project with its study.
        store: The evidence.
        name: The beginning of its key, or its variant and seed, such as ``28/1``.

    Raises:
        EvidenceError: There is none, or there are several.
    """
    variant, slash, seed = name.partition("/")
    if slash:
        if not (variant.isdecimal() and seed.isdecimal()):
            raise EvidenceError(f"{name!r} names no trial", hint="write a variant and a seed, such as 28/1")
        fidelity = project.study.fidelity
        found = [
            trial
            for trial in store.all()
            if (trial.record.variant, trial.record.seed, trial.record.fidelity) == (int(variant), int(seed), fidelity)
        ]
        current = [trial for trial in found if dict(trial.provenance.versions) == versions()]
        found = current or found
    else:
        if len(name) < _SHORTEST_PREFIX:
            raise EvidenceError(
                f"{name!r} names no trial", hint=f"give {_SHORTEST_PREFIX} digits of its key or more, or 28/1"
            )
        found = [trial for trial in store.all() if trial.key.startswith(name)]
    if not found:
        raise EvidenceError(f"there is no trial {name!r} in the evidence", hint="run 'rgss sweep' first")
    if len(found) > 1:
        keys = ", ".join(trial.key[:12] for trial in found[:4])
        raise EvidenceError(f"{len(found)} trials go by {name!r}", hint=f"name one by its key: {keys}")
    return found[0]


def replay(project: Project, stored: StoredTrial) -> Replay:
    """Run a stored trial again with the project, the code and the engines as they are now.

    Args:
        project: The project with its study.
        stored: The trial.

    Raises:
        DefinitionError: The variant is no longer there.
        SimulationError: The physics engine cannot build the world.
    """
    record = stored.record
    variant = project.designs.variant(record.variant)
    (spec,) = trial_specs(project.with_fidelity(record.fidelity.value), variants=[variant], seeds=[record.seed])
    again = run_trial(spec)
    then, now = dict(stored.provenance.versions), versions()
    changed = tuple(
        Change(name=name, then=then.get(name, "–"), now=now.get(name, "–"))
        for name in sorted({*then, *now})
        if then.get(name) != now.get(name)
    )
    return Replay(
        stored=stored,
        record=again,
        versions=changed,
        inputs=_changed_inputs(spec, stored),
        differences=() if record_digest(again) == stored.content_digest else _differences(record, again),
    )


def _changed_inputs(spec: TrialSpec, stored: StoredTrial) -> tuple[str, ...]:
    """The first piece whose inputs differ apart from the versions, and those after it."""
    then = digests_of(spec, stored.provenance.versions).as_mapping()
    return tuple(name for name, digest in then.items() if stored.provenance.inputs.get(name) != digest)


def _differences(then: TrialRecord, now: TrialRecord) -> tuple[Change, ...]:
    before, after = dict(_leaves(plain(then), "")), dict(_leaves(plain(now), ""))
    return tuple(
        Change(name=name, then=before.get(name, "–"), now=after.get(name, "–"))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    )


def _leaves(value: Any, name: str) -> list[tuple[str, str]]:
    """Every value within, by where it is; what is empty is a value too, so that no difference is lost."""
    if value and isinstance(value, dict):
        return [leaf for key, item in value.items() for leaf in _leaves(item, f"{name}.{key}" if name else key)]
    if value and isinstance(value, (list, tuple)):
        return [leaf for index, item in enumerate(value) for leaf in _leaves(item, f"{name}[{_title(item, index)}]")]
    return [(name, repr(value))]


def _title(item: Any, index: int) -> str:
    """A phase or a planned move goes by its name, anything else by its position."""
    if isinstance(item, dict):
        return str(item.get("phase", item.get("subtask", index)))
    return str(index)
