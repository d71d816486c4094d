"""Numbers of the model that trials were simulated with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rgss.decision.what_if.numbers import ModelNumber, variant_with
from rgss.designs import DesignVariant
from rgss.studies import Project, trial_specs
from rgss.sweep import key_of


def simulated_numbers(
    project: Project, variants: Sequence[DesignVariant], numbers: Iterable[ModelNumber]
) -> frozenset[str]:
    """Ids of the numbers whose change needs other trials.

    Args:
        project: The project with its study.
        variants: Its variants.
        numbers: The numbers.
    """
    asked, pairs = [], []
    for number in numbers:
        before = next((one for one in variants if variant_with(one, number, number.value + 1.0) is not one), None)
        if before is not None:
            asked.append(number)
            # Any other value suffices, since the key of a trial is a digest of all its inputs.
            pairs += [before, variant_with(before, number, number.value * 1.5 + 1.0)]
    if not asked:
        return frozenset()
    keys = [key_of(spec) for spec in trial_specs(project, variants=pairs, seeds=project.study.seeds[:1])]
    return frozenset(number.id for place, number in enumerate(asked) if keys[2 * place] != keys[2 * place + 1])
