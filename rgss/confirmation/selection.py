"""Selection of the designs and trials of a decided study for confirmation."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from rgss.assessment import IN_COMMON, VariantMeasures
from rgss.designs import DesignVariant
from rgss.errors import DefinitionError
from rgss.studies import Project
from rgss.tradeoff import Decision

MOST_RIVALS = 5
"""Most rivals of the chosen design that are confirmed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Selection:
    """Designs and trials that are confirmed.

    Attributes:
        variants: The designs, the chosen one first if there is one.
        chosen: The chosen design; None if designs were named or nothing is chosen.
        left_out: Rivals beyond `MOST_RIVALS`.
        sample: Variant and seed of each failure that is run again.
        physical_failures: Number of trials of the study that failed in physics, from which the sample is taken.
        planned_failures: Number that failed before physics; they are the same in every engine.
    """

    variants: tuple[DesignVariant, ...]
    chosen: int | None = None
    left_out: tuple[int, ...] = ()
    sample: tuple[tuple[int, int], ...] = ()
    physical_failures: int = 0
    planned_failures: int = 0


def select(project: Project, decision: Decision, measured: Sequence[VariantMeasures], *, failures: int) -> Selection:
    """The chosen design, its rivals, and a sample of the failures of all designs.

    Rivals are the designs tied with the chosen one, those within the practical margin of it, and the runner-up, in
    the order of the ranking.

    Args:
        project: The project with its study.
        decision: The decision.
        measured: Every variant with the records of the decision.
        failures: Size of the sample.

    Raises:
        DefinitionError: Nothing is chosen, so that there is nothing to confirm.
    """
    if decision.chosen is None:
        raise DefinitionError(
            "no variant meets every requirement by its estimates, so that there is no choice to confirm",
            hint="name designs with --variants",
        )
    close = {*decision.ties, *decision.near_ties, *([] if decision.runner_up is None else [decision.runner_up])}
    rivals = [one.variant for one in decision.ranking if one.variant in close - {decision.chosen}]
    chosen, left_out = (decision.chosen, *rivals[:MOST_RIVALS]), tuple(rivals[MOST_RIVALS:])
    found = _with_sample(measured, set(chosen), failures)
    return Selection(
        variants=tuple(project.designs.variant(number) for number in chosen),
        chosen=decision.chosen,
        left_out=left_out,
        sample=found.sample,
        physical_failures=found.physical_failures,
        planned_failures=found.planned_failures,
    )


def selected_by_id(
    project: Project, variants: Sequence[int], measured: Sequence[VariantMeasures] = (), *, failures: int = 0
) -> Selection:
    """The named designs, and a sample of the failures of the others.

    Args:
        project: The project with its study.
        variants: Their ids.
        measured: Every variant with its records; empty without a sample.
        failures: Size of the sample.

    Raises:
        DefinitionError: There is no such design.
    """
    found = _with_sample(measured, set(variants), failures)
    return Selection(
        variants=tuple(project.designs.variant(number) for number in dict.fromkeys(variants)),
        sample=found.sample,
        physical_failures=found.physical_failures,
        planned_failures=found.planned_failures,
    )


def _with_sample(measured: Sequence[VariantMeasures], confirmed: Collection[int], size: int) -> Selection:
    """Sample of the failures of designs that are not confirmed, evenly over kinds and phases of failure."""
    kinds: dict[tuple[int, str], list[tuple[int, int]]] = {}
    planned = physical = 0
    for entry in measured:
        for record in entry.records:
            if record.failure is None:
                continue
            if record.failure in IN_COMMON:
                planned += 1
                continue
            physical += 1
            if record.variant not in confirmed:
                phases = [one.phase for one in record.phases]
                place = phases.index(record.failed_phase) if record.failed_phase is not None else 0
                kinds.setdefault((place, record.failure.value), []).append((record.seed, record.variant))
    queues = [_spread(sorted(trials)) for _, trials in sorted(kinds.items())]
    sample: list[tuple[int, int]] = []
    while len(sample) < size and any(queues):
        for queue in queues:
            if queue and len(sample) < size:
                seed, variant = queue.pop(0)
                sample.append((variant, seed))
    return Selection(variants=(), sample=tuple(sorted(sample)), physical_failures=physical, planned_failures=planned)


def _spread(trials: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """Trials in an order whose prefixes are spread over all: the first, the middle, the quarters, and so on."""
    count = len(trials)
    bits = max(1, (count - 1).bit_length())
    order = (int(f"{index:0{bits}b}"[::-1], 2) for index in range(2**bits))
    return [trials[place] for place in order if place < count]
