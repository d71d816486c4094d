"""Measures of a file that differ from those of the project: an import does not read them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from rgss.exchange.content import Content
from rgss.exchange.files import problem
from rgss.findings import Severity, shown


def with_measures_compared(foreign: Content, definitions: Mapping[str, str]) -> Content:
    """Content of a file with a loss for each of its measures that the project defines otherwise, or not at all.

    A measure is an expression with units and an estimate, which a file of requirements does not have.
    """
    losses = []
    for name, text in foreign.measures:
        own = definitions.get(name)
        if own is None:
            message = f"measure {shown(name)} is none of the project's"
        elif text.strip() and text.split() != own.split():
            message = f"the definition of measure {shown(name)} is another one than the project's"
        else:
            continue
        hint = "an import reads no measures; change measures.yaml"
        losses.append(problem(foreign.file, "measure", message, hint=hint, severity=Severity.WARNING))
    return replace(foreign, losses=(*foreign.losses, *losses))
