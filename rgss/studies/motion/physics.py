"""Section of a study on the physics of contact: rate, solver iterations, and softness of the fingers' pads."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from rgss.documents import Document, DocumentModel, Hertz, NewtonSecondsPerMetre, NewtonsPerMetre
from rgss.findings import Finding
from rgss.physics import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ, PhysicsSettings

_DEFAULT = PhysicsSettings()


class PhysicsEntry(DocumentModel):
    """Steps of the physics, and the compliance of the pads."""

    rate: Hertz
    solver_iterations: Annotated[int, Field(ge=1, le=10_000)]
    pad_stiffness: NewtonsPerMetre = _DEFAULT.pad_stiffness_n_m
    pad_damping: NewtonSecondsPerMetre | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class PadCompliance:
    """Compliance of the pad of one finger, a Kelvin-Voigt layer.

    Attributes:
        stiffness_n_m: Its normal stiffness.
        retardation_s: Its damping over its stiffness.
    """

    stiffness_n_m: float = _DEFAULT.pad_stiffness_n_m
    retardation_s: float = _DEFAULT.pad_retardation_s


def pads_of(entry: PhysicsEntry) -> PadCompliance:
    """The compliance of the pads; without a damping they have the default retardation.

    Args:
        entry: The section ``physics``.
    """
    if entry.pad_damping is None or entry.pad_stiffness <= 0.0:
        return PadCompliance(stiffness_n_m=entry.pad_stiffness)
    return PadCompliance(stiffness_n_m=entry.pad_stiffness, retardation_s=entry.pad_damping / entry.pad_stiffness)


def physics_findings(entry: PhysicsEntry, document: Document, *, fidelities: Sequence[str]) -> Iterator[Finding]:
    """Findings on quantities that must be positive, and on steps too coarse for a grasp.

    docs/validation.md shows from where results converge.

    Args:
        entry: The section ``physics``.
        document: The file, for positions.
        fidelities: Names of the fidelities of the study's trials.
    """
    for key, value in (("rate", entry.rate), ("pad_stiffness", entry.pad_stiffness)):
        if value <= 0.0:
            yield document.finding("study.not-positive", f"{key} must be greater than zero", ("physics", key))
    if entry.pad_damping is not None and entry.pad_damping < 0.0:
        message = "pad_damping must be at least zero"
        yield document.finding("study.not-positive", message, ("physics", "pad_damping"))
    if entry.rate <= 0.0 or "contact" not in fidelities:
        return
    if entry.rate < LEAST_RATE_HZ:
        message = f"contact physics needs at least {LEAST_RATE_HZ:g} Hz, got {entry.rate:g} Hz"
        yield document.finding("study.coarse-physics", message, ("physics", "rate"), hint="240 Hz is validated")
    elif entry.rate * entry.solver_iterations < LEAST_ITERATIONS_HZ:
        least = math.ceil(LEAST_ITERATIONS_HZ / entry.rate)
        message = (
            f"contact physics at {entry.rate:g} Hz needs at least {least} solver iterations, "
            f"got {entry.solver_iterations}"
        )
        hint = "20 are validated" if least <= 20 else f"give {least} or more"
        yield document.finding("study.coarse-physics", message, ("physics", "solver_iterations"), hint=hint)
