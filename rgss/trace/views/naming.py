"""Resolution of a name given by a user."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.errors import DefinitionError
from rgss.measures import MeasureSet
from rgss.requirements import nearest
from rgss.trace.evidence import TraceEvidence
from rgss.trace.model import TraceModel
from rgss.trace.views.neighbours import ThingKind, kinds_of

_SHORTEST_KEY = 6
_TRIAL = re.compile(r"(?P<variant>[0-9]{1,9})/[0-9]{1,10}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Named:
    """Resolved name.

    Attributes:
        id: Its id; for a trial, its whole key.
        kind: Its kind.
        used_by: For a trial, a symbol or a source: ids of the measures that use it.
    """

    id: str
    kind: ThingKind
    used_by: tuple[str, ...] = ()


def named(model: TraceModel, evidence: TraceEvidence, name: str, *, definitions: MeasureSet | None = None) -> Named:
    """Resolve a name.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: Evidence of the project.
        name: The name; see `chain_of`.
        definitions: The definitions of the measures.

    Raises:
        DefinitionError: The name is unknown; the hint has the nearest name.
    """
    kinds = kinds_of(model, evidence)
    if name in kinds:
        return Named(id=name, kind=kinds[name])
    symbols = {} if definitions is None else dict(_symbols(definitions))
    if name in symbols:
        return symbols[name]
    trial = _trial(evidence, name)
    if trial is not None:
        return trial
    if (asked := _TRIAL.fullmatch(name)) is not None:
        raise DefinitionError(
            f"trial {name} is not one of the trials shown", hint=_where(evidence, int(asked["variant"]))
        )
    raise DefinitionError(
        f"{name!r} is not an id of the requirements, the architecture, the measures, the tests or the trials shown",
        hint=nearest(name, [*kinds, *symbols]) or f"name one, such as {', '.join(_examples(kinds, evidence))}",
    )


def _where(evidence: TraceEvidence, variant: int) -> str:
    """The trials that are shown, and how to see those of a variant."""
    shown = evidence.shown
    if shown is None or shown.variant != variant:
        held = "no variant is shown" if shown is None else f"those of variant {shown.variant} are"
        return f"{held}; --variant {variant} shows those of variant {variant}"
    seeds = sorted(trial.seed for trial in shown.trials)
    if not seeds:
        return f"variant {variant} has no evidence of this fidelity; run '{evidence.sweep}' first"
    return f"variant {variant} has trials of seeds {seeds[0]} to {seeds[-1]}; --replicates shows others"


def _examples(kinds: Mapping[str, ThingKind], evidence: TraceEvidence) -> Iterator[str]:
    """An id of a requirement, a block and a measure, and a trial that is shown."""
    for kind in (ThingKind.REQUIREMENT, ThingKind.BLOCK, ThingKind.MEASURE):
        yield from [name for name, own in kinds.items() if own is kind][:1]
    if evidence.shown is not None:
        yield from [f"{trial.variant}/{trial.seed}" for trial in evidence.shown.trials[:1]]


def _symbols(definitions: MeasureSet) -> Iterator[tuple[str, Named]]:
    """Constants, inputs and their sources, equations and assumptions; the first of a name counts."""
    measures = definitions.measures

    def users(symbols: set[str]) -> tuple[str, ...]:
        return tuple(item.id for item in measures if symbols & {item.id, *definitions.used[item.id]})

    found: dict[str, Named] = {}
    for constant in definitions.constants:
        found[constant.id] = Named(id=constant.id, kind=ThingKind.CONSTANT, used_by=users({constant.id}))
    for symbol in definitions.inputs:
        found.setdefault(symbol.id, Named(id=symbol.id, kind=ThingKind.INPUT, used_by=users({symbol.id})))
    for source in dict.fromkeys(symbol.source for symbol in definitions.inputs):
        ids = {symbol.id for symbol in definitions.inputs if symbol.source == source}
        found.setdefault(source, Named(id=source, kind=ThingKind.SOURCE, used_by=users(ids)))
    for equation in definitions.equations:
        ids = {item.id for item in measures if item.equation == equation.id}
        found.setdefault(equation.id, Named(id=equation.id, kind=ThingKind.EQUATION, used_by=users(ids)))
    for assumption in definitions.assumptions:
        used_by = tuple(item.id for item in measures if assumption in definitions.assumptions_of(item.id))
        found.setdefault(assumption.id, Named(id=assumption.id, kind=ThingKind.ASSUMPTION, used_by=used_by))
    yield from found.items()


def _trial(evidence: TraceEvidence, name: str) -> Named | None:
    shown = evidence.shown
    if shown is None:
        return None
    for trial in shown.trials:
        by_key = len(name) >= _SHORTEST_KEY and trial.key.startswith(name)
        if by_key or name == f"{trial.variant}/{trial.seed}":
            used_by = tuple(measure for measure, keys in shown.deciding.items() if trial.key in keys)
            return Named(id=trial.key, kind=ThingKind.TRIAL, used_by=used_by)
    return None
