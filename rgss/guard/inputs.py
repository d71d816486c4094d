"""Inputs of the watched trials: values, provenance, and numeric constants of the code."""

from __future__ import annotations

import ast
import importlib.util
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache
from pathlib import Path

from rgss.evidence import Provenance
from rgss.evidence.records import code_revision, file_digests, machine
from rgss.guard.runs import WatchedTrials
from rgss.regression import BaselineOrigin, Inputs
from rgss.studies import CODE, FOLDERS, Project, named_inputs
from rgss.sweep import values_by_name
from rgss.trials.code import code_of_trials, versions

BASELINE_SUFFIX = ".baseline.json"
"""Suffix of a baseline, which replaces that of the study's file."""

_CODE = "rgss-"
_COMPARED_ELSEWHERE = frozenset({"inputs", "versions", "inputs_digest", "files", "revision", "machine", "study"})


def inputs_of_trials(watched: Iterable[WatchedTrials]) -> Inputs:
    """Values of all inputs of the watched trials except code, by run, variant and dotted name."""
    return {
        trials.run.id: {
            spec.variant: values_by_name(
                {name: value for name, value in named_inputs(spec).values.items() if name != CODE}
            )
            for spec in trials.specs(1)
        }
        for trials in watched
    }


def shared_inputs(inputs: Inputs) -> dict[str, str]:
    """The inputs with the same value in all trials."""
    every = [values for variants in inputs.values() for values in variants.values()]
    if not every:
        return {}
    return {
        name: value
        for name, value in every[0].items()
        if all(name in values and values[name] == value for values in every[1:])
    }


def origin_of_trials(project: Project, provenances: Sequence[Provenance]) -> BaselineOrigin:
    """Origin of the watched trials: from their provenance, or from the installed versions where that has none.

    Every field of a provenance counts that is not compared in another way, so that later additions are
    guarded too.
    """
    installed = versions()
    engines = {name: version for name, version in installed.items() if not name.startswith(_CODE)}
    modules = code_of_trials()
    inputs = file_digests(project.folder, FOLDERS)
    return BaselineOrigin(
        revision=code_revision(),
        machine=_joined(one.machine for one in provenances) or machine(),
        engines={**engines, **_engines_of(provenances)},
        code={name.removeprefix(_CODE): version for name, version in installed.items() if name.startswith(_CODE)},
        # A baseline is not an input of the trials, and cannot contain its own digest.
        inputs={name: value for name, value in inputs.items() if not name.endswith(BASELINE_SUFFIX)},
        modules=modules,
        constants=constants_of(modules),
    )


def constants_of(modules: Iterable[str]) -> dict[str, str]:
    """Named numeric constants of modules and their classes, as text, by dotted name.

    The digest of a module shows that it changed; these show which gain or threshold in it.

    Args:
        modules: Names of modules; those without source are omitted.
    """
    found: dict[str, str] = {}
    for module in sorted(modules):
        spec = importlib.util.find_spec(module)
        if spec is None or spec.origin is None or not spec.origin.endswith(".py"):
            continue
        found |= {f"{module}.{name}": text for name, text in _constants_in(Path(spec.origin).read_bytes())}
    return found


@lru_cache(maxsize=512)
def _constants_in(source: bytes) -> tuple[tuple[str, str], ...]:
    """Named numeric constants of a module; cached, since a baseline and its comparison look at the same modules."""
    return tuple(_numbers(ast.parse(source).body, ""))


def _numbers(statements: Iterable[ast.stmt], prefix: str) -> Iterator[tuple[str, str]]:
    for node in statements:
        if isinstance(node, ast.ClassDef):
            yield from _numbers(node.body, f"{prefix}{node.name}.")
        elif isinstance(node, ast.Assign) and len(node.targets) == 1:
            yield from _named_number(node.targets[0], node.value, prefix)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            yield from _named_number(node.target, node.value, prefix)


def _named_number(target: ast.expr, value: ast.expr, prefix: str) -> Iterator[tuple[str, str]]:
    if isinstance(target, ast.Name) and any(isinstance(each, ast.Constant) for each in ast.walk(value)):
        leaves = (each for each in ast.walk(value) if not isinstance(each, _ARITHMETIC))
        if all(isinstance(each, ast.Constant) and isinstance(each.value, (int, float)) for each in leaves):
            yield f"{prefix}{target.id}", ast.unparse(value)


_ARITHMETIC = (ast.Tuple, ast.List, ast.BinOp, ast.UnaryOp, ast.operator, ast.unaryop, ast.expr_context)


def _engines_of(provenances: Sequence[Provenance]) -> dict[str, str]:
    """Versions and further fields of the provenances; several values of a field are joined."""
    said: dict[str, list[str]] = {}
    for provenance in provenances:
        named = {name: value for name, value in provenance.versions.items() if not name.startswith(_CODE)}
        for each in fields(provenance):
            if each.name not in _COMPARED_ELSEWHERE:
                named |= _flat(each.name, getattr(provenance, each.name))
        for name, value in named.items():
            said.setdefault(name, []).append(value)
    return {name: _joined(values) for name, values in said.items()}


def _flat(name: str, value: object) -> dict[str, str]:
    if isinstance(value, Mapping):
        return {f"{name}.{key}": str(item) for key, item in value.items()}
    return {name: str(value)} if value else {}


def _joined(texts: Iterable[str]) -> str:
    return " | ".join(sorted({text for text in texts if text}))
