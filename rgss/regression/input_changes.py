"""Differences between the inputs of a baseline's trials and the present ones, by name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

from rgss.regression.baseline import Baseline, BaselineOrigin

_DIGEST = re.compile(r"[0-9a-f]{8,64}")

ABSENT = "–"
"""The value of an input that is not there."""

_NOTHING = frozenset({ABSENT, "None", "''", "[]", "{}"})


class InputKind(str, Enum):
    """Kinds of input, by where their values come from."""

    VALUE = "input"
    ENGINE = "engine"
    CONSTANT = "constant"
    CODE = "code"
    FILE = "file"
    MACHINE = "machine"


@dataclass(frozen=True, slots=True, kw_only=True)
class InputChange:
    """An input that differs.

    Attributes:
        kind: Where its value comes from.
        name: Its name, such as ``settings.control.firm_grasp_s``.
        then: Its value in the baseline, as text; a dash if there was none. Empty where only digests are known.
        now: Its present value.
        where: The trials that it is an input of; empty for all of them.
    """

    kind: InputKind
    name: str
    then: str = ""
    now: str = ""
    where: str = ""

    def __str__(self) -> str:
        values = f" {self.then} → {self.now}" if self.then or self.now else ""
        return f"{self.kind.value} changed: {self.name}{values}{f' ({self.where})' if self.where else ''}"


Inputs = Mapping[str, Mapping[int, Mapping[str, str]]]
"""By run and variant, the values of all inputs by name."""


def value_changes(baseline: Baseline, now: Inputs) -> Iterator[InputChange]:
    """The values that differ between trials of the same run and variant, each once.

    Args:
        baseline: The baseline; nothing is found if it has no values.
        now: The present inputs.
    """
    trials = [(run, variant) for run, variants in now.items() for variant in variants]
    known = [each for each in trials if baseline.inputs_of(*each)]
    found: dict[tuple[str, str, str], list[tuple[str, int]]] = {}
    for run, variant in known:
        then, present = baseline.inputs_of(run, variant), now[run][variant]
        for name in sorted(then.keys() | present.keys()):
            was, is_now = then.get(name, ABSENT), present.get(name, ABSENT)
            # A later release may have more inputs, which are not used where they are None or empty.
            if was != is_now and not (ABSENT in (was, is_now) and {was, is_now} <= _NOTHING):
                found.setdefault((name, was, is_now), []).append((run, variant))
    for (name, was, is_now), places in found.items():
        where = "" if len(places) == len(known) else _where(places)
        yield InputChange(kind=InputKind.VALUE, name=name, then=was, now=is_now, where=where)


def origin_changes(then: BaselineOrigin, now: BaselineOrigin, *, with_values: bool) -> Iterator[InputChange]:
    """Differences between the origins of two sets of trials.

    Args:
        then: The origin of the baseline.
        now: The origin of the present trials.
        with_values: Whether the baseline has the values of inputs and the digests of modules; otherwise the
            code is compared piece by piece.
    """
    engines = now.engines
    if not with_values:
        # What an earlier rgss did not record cannot have changed.
        engines = {name: version for name, version in engines.items() if name in then.engines}
    yield from (
        one for one in _differing(InputKind.ENGINE, then.engines, engines) if _compared(one.then) != _compared(one.now)
    )
    if with_values:
        yield from _differing(InputKind.CONSTANT, then.constants, now.constants)
        code = sorted(
            name for name in then.modules.keys() | now.modules.keys() if then.modules.get(name) != now.modules.get(name)
        )
    else:
        code = [f"what makes {name}" for name in sorted(now.code) if then.code.get(name) != now.code[name]]
    yield from (InputChange(kind=InputKind.CODE, name=name) for name in code)
    files = sorted(
        name for name in then.inputs.keys() | now.inputs.keys() if then.inputs.get(name) != now.inputs.get(name)
    )
    yield from (InputChange(kind=InputKind.FILE, name=name) for name in files)
    if then.machine != now.machine:
        yield InputChange(
            kind=InputKind.MACHINE, name="machine", then=then.machine or ABSENT, now=now.machine or ABSENT
        )


def _compared(text: str) -> tuple[str, ...]:
    """Compared part of a version: only the digest of results if it ends with one."""
    found = set()
    for part in text.split(" | "):
        names, _, last = part.rpartition(" ")
        found.add(last if names and _DIGEST.fullmatch(last) else part)
    return tuple(sorted(found))


def _differing(kind: InputKind, then: Mapping[str, str], now: Mapping[str, str]) -> Iterator[InputChange]:
    for name in sorted(then.keys() | now.keys()):
        was, is_now = then.get(name, ABSENT), now.get(name, ABSENT)
        if was != is_now:
            yield InputChange(kind=kind, name=name, then=was, now=is_now)


def _where(places: list[tuple[str, int]]) -> str:
    by_run: dict[str, list[int]] = {}
    for run, variant in places:
        by_run.setdefault(run, []).append(variant)
    return "; ".join(f"{run} {', '.join(map(str, sorted(variants)))}" for run, variants in by_run.items())
