"""Running a stored trial again, to see whether it gives the same bits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, StoredTrial, TrialRecord, record_digest
from rgss.evidence.records import Numerics, numerics_difference
from rgss.evidence.store import trial_names
from rgss.studies import CODE, Project, named_inputs, trial_specs
from rgss.sweep.agreement import Agreement, beyond_tolerance
from rgss.sweep.engine_process import compute
from rgss.sweep.input_changes import ABSENT, Change, changes_between, input_changes
from rgss.sweep.trial_keys import key_of
from rgss.trials import mujoco_settings
from rgss.trials.code import are_of_this_kind, fixed_numerics, versions
from rgss.trials.pieces import TrialSpec, digests_of, run_trial, to_plain

_SHORTEST_PREFIX = 6
_MOST_DIGITS = 18
_BEYOND = 2**62


@dataclass(frozen=True, slots=True, kw_only=True)
class Replay:
    """Comparison of a stored trial with a new run.

    Attributes:
        stored: The stored trial.
        record: The record of the new run.
        versions: Versions of code and engines that differ.
        inputs: Pieces whose inputs differ beyond the versions, such as ``plan``.
        changes: The inputs that differ, by name, as far as stored.
        differences: Differences of the records, in order; empty if bitwise equal.
        numerics: Numerics of the process of the new run.
    """

    stored: StoredTrial
    record: TrialRecord
    versions: tuple[Change, ...]
    inputs: tuple[str, ...]
    changes: tuple[Change, ...]
    differences: tuple[Change, ...]
    numerics: Numerics

    @property
    def agreement(self) -> Agreement:
        """Agreement of the new record with the stored one.

        Numbers may deviate only if the stored trial was computed with other numerics, and at most by the observed
        deviation between kernels of different processors in contact.
        """
        if self.same:
            return Agreement.BIT_FOR_BIT
        elsewhere = bool(numerics_difference(self.stored.provenance.numerics, self.numerics))
        unchanged = not (self.versions or self.inputs or self.changes)
        close = elsewhere and unchanged and not beyond_tolerance(self.differences)
        return Agreement.WITHIN_TOLERANCE if close else Agreement.DIFFERENT

    @property
    def same(self) -> bool:
        """True if the new record is bit for bit the stored one."""
        return not self.differences


def find_trial(project: Project, store: EvidenceStore, name: str) -> StoredTrial:
    """Find a stored trial.

    Args:
        project: The project with its study.
        store: The evidence.
        name: The beginning of its key, or its variant and seed, such as ``28/1``.

    Raises:
        EvidenceError: No trial matches, or several do.
    """
    variant, slash, seed = name.partition("/")
    if slash:
        if not (variant.isdecimal() and seed.isdecimal()):
            raise EvidenceError(f"{name!r} names no trial", hint="write a variant and a seed, such as 28/1")
        fidelity = project.study.fidelity
        found = _of_study(project, store.trials_of(_number(variant), _number(seed), fidelity), name)
        current = [trial for trial in found if dict(trial.provenance.versions) == versions()]
        found = current or found
        if len(found) > 1:
            # A confirmation keeps trials of the same name under other physics; the study's own is meant.
            own = _own_key(project, found[0].record)
            found = [trial for trial in found if trial.key == own] or found
    else:
        if len(name) < _SHORTEST_PREFIX:
            raise EvidenceError(
                f"{name!r} names no trial", hint=f"give {_SHORTEST_PREFIX} digits of its key or more, or 28/1"
            )
        # Only these are read, so that a damaged row elsewhere in the store does not matter.
        alike = [one.key for one in trial_names(store.database) if one.key.startswith(name)]
        found = [trial for key in alike if (trial := store.get(key)) is not None]
    if not found:
        raise EvidenceError(f"there is no trial {name!r} in the evidence", hint="run 'rgss sweep' first")
    if len(found) > 1:
        keys = ", ".join(trial.key[:12] for trial in found[:4])
        raise EvidenceError(f"{len(found)} trials go by {name!r}", hint=f"name one by its key: {keys}")
    return found[0]


def _of_study(project: Project, found: Sequence[StoredTrial], name: str) -> list[StoredTrial]:
    """Trials that a study may mean by a variant and a seed: its own, else those that were run for it.

    Raises:
        EvidenceError: There are only trials of other studies.
    """
    own = _own_key(project, found[0].record) if found else ""
    mine = [trial for trial in found if trial.key == own or trial.provenance.study in ("", project.study.label)]
    if found and not mine:
        others = ", ".join(sorted({trial.provenance.study for trial in found}))
        raise EvidenceError(
            f"there is no trial {name!r} of {project.study.label} in the evidence, only of {others}",
            hint="run 'rgss sweep' first",
        )
    return mine


def replay(project: Project, stored: StoredTrial, *, inputs: Mapping[str, Any] | None = None) -> Replay:
    """Run a stored trial again with the present project, code and engines.

    A trial without draws is run nominally, regardless of the project's present uncertainty.

    Args:
        project: The project with its study.
        stored: The trial.
        inputs: Its stored named inputs; None if not stored.

    Raises:
        DefinitionError: The variant does not exist any more. SimulationError: The physics engine cannot build the
        world.
    """
    record = stored.record
    variant = project.designs.variant(record.variant)
    if not (record.draws or record.workload):
        project = project.nominal()
    (spec,) = trial_specs(project.with_fidelity(record.fidelity.value), variants=[variant], seeds=[record.seed])
    spec = _in_its_engine(spec, inputs)
    again = compute(run_trial, spec)
    then, now = dict(stored.provenance.versions), versions()
    changed = tuple(
        Change(name=name, then=then.get(name, ABSENT), now=now.get(name, ABSENT))
        for name in sorted({*then, *now})
        if then.get(name) != now.get(name)
    )
    return Replay(
        stored=stored,
        record=again,
        versions=changed,
        inputs=_changed_pieces(spec, stored),
        changes=()
        if inputs is None
        else input_changes(_without_code(inputs), _without_code(named_inputs(spec).values)),
        differences=()
        if record_digest(again) == stored.content_digest
        else changes_between(to_plain(record), to_plain(again)),
        numerics=fixed_numerics(),
    )


def _in_its_engine(spec: TrialSpec, inputs: Mapping[str, Any] | None) -> TrialSpec:
    """The trial in the second engine as it is installed, if it was made there.

    Raises:
        DefinitionError: That engine is not installed.
    """
    physics = {} if inputs is None else inputs["settings"]["physics"]
    if "engine" not in physics:
        return spec
    settings = replace(spec.settings, physics=mujoco_settings(rate_hz=physics["rate_hz"]))
    return replace(spec, settings=settings)


def _changed_pieces(spec: TrialSpec, stored: StoredTrial) -> tuple[str, ...]:
    """The first piece whose inputs differ apart from the versions, and those after it."""
    if not are_of_this_kind(stored.provenance.versions):
        return ()
    then = digests_of(spec, stored.provenance.versions).as_mapping()
    return tuple(name for name, digest in then.items() if stored.provenance.inputs.get(name) != digest)


def _without_code(inputs: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in inputs.items() if name != CODE}


def _own_key(project: Project, record: TrialRecord) -> str:
    """Present key of a trial of the study; empty if its variant does not exist any more."""
    variants = [variant for variant in project.designs.expand() if variant.id == record.variant]
    specs = trial_specs(project.with_fidelity(record.fidelity.value), variants=variants, seeds=[record.seed])
    return "".join(map(key_of, specs))


def _number(digits: str) -> int:
    """A number that the store can look for; one too great names nothing."""
    return int(digits) if len(digits) <= _MOST_DIGITS else _BEYOND
